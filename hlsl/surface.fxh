// Group surface: texture space, stretch, normals, numbers in two halves.
// Paths of groups start with ../hlsl so that they hold both relative to this file and relative to effects/: Microsoft's standard include
// handler takes nested paths relative to the outermost file. Every other file includes what it needs itself, by paths relative to its own
// folder, unless that has been read: so it compiles alone, and behind a group, or behind includes in the order of their needs, its own
// paths are never asked for.
#include "../hlsl/platform.fxh"
#include "../hlsl/settings.fxh"
#include "../hlsl/constants.fxh"
#include "../hlsl/printed/seed.fxh"
#include "../hlsl/printed/deon2007.fxh"
#include "../hlsl/surface/normal.fxh"
#include "../hlsl/surface/halves.fxh"
#include "../hlsl/surface/unwrap.fxh"
#include "../hlsl/surface/stretch.fxh"
#include "../hlsl/surface/metric.fxh"
// SPDX-License-Identifier: MIT
