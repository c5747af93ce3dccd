// SkinPost: diffusion as a step over an engine's own buffers: light that enters the skin, depth, colour, and the picture so far. Passes
// Profiles, Kernels, Prepare and Diffuse are what an engine takes over; pass Frame is an engine's in short (docs/your-engine.md).
#define TEGUMENT_LIGHTS_IN_ONE_PASS 0
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
#include "../hlsl/peers/screen.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"
#include "passes/materials.fxh"
#include "passes/skin_parameters.fxh"
#include "passes/shadow_map.fxh"
#include "passes/lamp_light.fxh"
#include "passes/lamps.fxh"
#include "passes/more_light.fxh"
#include "passes/surface.fxh"
#include "passes/specular.fxh"

Texture2D gEnergyAttenuationMap < string Producer = "EnergyAttenuation.fx/gEnergyAttenuationMap";
    string ResourceName = "energy_attenuation.dds"; >;
TG_SAMPLER2D(gEnergyAttenuation, LINEAR, CLAMP);

#include "passes/diffuse_share.fxh"
#include "passes/more_light_sum.fxh"
#include "passes/energy_share.fxh"
#include "passes/profile.fxh"
#include "passes/flesh.fxh"
#include "passes/tone.fxh"
#include "passes/planar_shadow.fxh"
#include "passes/post_frame.fxh"
#include "passes/post.fxh"
#include "passes/post_compute.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("SkinPost") string WithoutUvs = "*"; > = 0.8;

#ifdef FX_TECHNIQUES
technique SkinPost < string Script = POST_FRAME_SCRIPT POST_SCRIPT; >
{
    POST_FRAME_PASSES
    POST_PASSES
}
#endif
#ifdef TEGUMENT_COMPUTE_TECHNIQUES
technique SkinPostCompute < string Script = POST_FRAME_SCRIPT POST_COMPUTE_SCRIPT; >
{
    POST_FRAME_PASSES
    POST_COMPUTE_PASSES
}
#endif
// SPDX-License-Identifier: MIT
