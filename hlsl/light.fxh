// Group light: surroundings, and lamps beside the light of the workspace.
#include "../hlsl/platform.fxh"
#include "../hlsl/settings.fxh"
#include "../hlsl/surface/normal.fxh"
#include "../hlsl/light/surroundings.fxh"
#include "../hlsl/light/lamps.fxh"
// SPDX-License-Identifier: MIT
