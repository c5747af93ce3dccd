// Group surface: texture space, stretch, normals, numbers in two halves.
// Paths start with ../hlsl so that they hold both relative to this file and relative to effects/: Microsoft's standard include handler takes
// nested paths relative to the outermost file. For the same reason the files of a group include nothing themselves.
#include "../hlsl/settings.fxh"
#include "../hlsl/surface/normal.fxh"
#include "../hlsl/surface/halves.fxh"
#include "../hlsl/surface/unwrap.fxh"
#include "../hlsl/surface/stretch.fxh"
