// Group light: surroundings.
#include "../hlsl/platform.fxh"
#include "../hlsl/settings.fxh"
#include "../hlsl/surface/normal.fxh"
#include "../hlsl/light/surroundings.fxh"
