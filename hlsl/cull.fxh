// Group cull: which texels the picture needs. About the paths see surface.fxh.
#include "../hlsl/cull/visibility.fxh"
#include "../hlsl/cull/outside.fxh"
#include "../hlsl/printed/outside.fxh"
// SPDX-License-Identifier: MIT
