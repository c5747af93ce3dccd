// Group shadow: shadow map, translucent shadow map. About the paths see surface.fxh.
#include "../hlsl/surface.fxh"
#include "../hlsl/shadow/map.fxh"
#include "../hlsl/shadow/filter.fxh"
#include "../hlsl/printed/filter.fxh"
#include "../hlsl/shadow/tsm.fxh"
#include "../hlsl/shadow/planar.fxh"
#include "../hlsl/shadow/blocks.fxh"
#include "../hlsl/shadow/soft.fxh"
// SPDX-License-Identifier: MIT
