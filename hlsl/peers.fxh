// Group peers: other people's diffusion, to compare with. About the paths see surface.fxh. Effects in effects/peers include the files one
// by one.
#include "../hlsl/surface.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/peers/screen.fxh"
#include "../hlsl/peers/separable_kernel.fxh"
#include "../hlsl/printed/separable.fxh"
#include "../hlsl/peers/separable.fxh"
#include "../hlsl/peers/burley_profile.fxh"
#include "../hlsl/peers/burley_weight.fxh"
#include "../hlsl/printed/burley.fxh"
#include "../hlsl/peers/burley.fxh"
#include "../hlsl/peers/ring.fxh"
#include "../hlsl/peers/ring_light.fxh"
#include "../hlsl/printed/preintegrated.fxh"
#include "../hlsl/peers/preintegrated.fxh"
#include "../hlsl/peers/penumbra.fxh"
// SPDX-License-Identifier: MIT
