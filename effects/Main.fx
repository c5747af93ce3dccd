// Main: human skin, in 15 passes after d'Eon and Luebke 2007 and in 8 after Gosselin, Sander and Mitchell 2004, as seed 000 Tables 3 and 4
// order them. Setting by TEGUMENT_SETTING (hlsl/settings.fxh). Techniques, all drawing into the caller's targets: DEonLuebke and Gosselin;
// Lambert, the same scene without diffusion, to set beside them.
#define TEGUMENT_LIGHTS_IN_ONE_PASS (1 - TEGUMENT_LOBES)
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
#include "../hlsl/cull.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"
#include "passes/materials.fxh"
#include "passes/skin_parameters.fxh"
#include "passes/tsm.fxh"
#include "passes/shadow_map.fxh"
#include "passes/lamp_light.fxh"
#include "passes/lamps.fxh"
#include "passes/more_light.fxh"
#include "passes/surface.fxh"
#include "passes/specular.fxh"
#include "passes/skin_point.fxh"
#include "passes/diffuse_share.fxh"
#include "passes/more_light_sum.fxh"
#include "passes/energy_share.fxh"
#include "passes/light_by_light.fxh"
#include "passes/irradiance.fxh"
#include "passes/irradiance_gosselin.fxh"
#include "passes/stretch.fxh"
#include "passes/profile.fxh"
#include "passes/flesh.fxh"
#include "passes/convolution.fxh"
#include "passes/blur_parameters.fxh"
#include "passes/poisson.fxh"
#include "passes/cull.fxh"
#include "passes/final.fxh"
#include "passes/final_gosselin.fxh"

float Script : STANDARDSGLOBAL <
    STARTS_WITH("DEonLuebke") string WithoutUvs = "Lambert, peers/Separable.fx, peers/Burley.fx, Specular.fx";
> = 0.8;

#ifdef FX_TECHNIQUES
technique DEonLuebke < string Formerly = "DEonLuebkeCulled"; string Script =
    LAMPS_SCRIPT OWN_SHADOW_SCRIPT TSM_SCRIPT
    UNWRAP_SCRIPT("gIrradianceMap", "gClearInvalid")
    "LoopByCount=gUsePrePass; Pass=PrePass1; Pass=PrePass2; LoopEnd; Pass=Irradiance;"
    CASCADE_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Final;" LIGHTS_SCRIPT("Skin"); >
{
    LAMPS_PASSES
    OWN_SHADOW_PASS
    TSM_PASS
    TG_QUAD_PASS(PrePass1, PrePass1VS, PrePass1PS, TG_STATE_PREPASS)
    TG_MESH_PASS(PrePass2, PrePass2VS, PrePass2PS, TG_STATE_PREPASS)
    TG_MESH_PASS(Irradiance, IrradianceVS, IrradiancePS, TG_STATE_EQUAL)
    CASCADE_PASSES(TG_STATE_EQUAL)
    TG_MESH_PASS(Final, SurfaceVS, FinalPS, TG_STATE_SOLID)
    LIGHTS_PASSES(Skin, SurfaceVS)
}

technique Gosselin < string Formerly = "GosselinCulled"; string Script =
    LAMPS_SCRIPT SHADOW_MAP_SCRIPT
    UNWRAP_SCRIPT("gIrradianceMap", "gClearInvalid")
    "LoopByCount=gUsePrePass; Pass=PrePass1; Pass=PrePass2; LoopEnd; Pass=Irradiance;"
    BLURS_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=;" BLURRED_SCRIPT("Final", "FinalEven")
    LIGHTS_BLURRED_SCRIPT("Gosselin", "GosselinEven"); >
{
    LAMPS_PASSES
    SHADOW_MAP_PASS
    TG_QUAD_PASS(PrePass1, PrePass1VS, PrePass1PS, TG_STATE_PREPASS)
    TG_MESH_PASS(PrePass2, PrePass2VS, PrePass2PS, TG_STATE_PREPASS)
    TG_MESH_PASS(Irradiance, IrradianceVS, GosselinIrradiancePS, TG_STATE_EQUAL)
    BLUR_PASSES_1_TO_3(TG_STATE_EQUAL)
    TG_MESH_PASS(Final, SurfaceVS, GosselinFinalPS, TG_STATE_SOLID)
    BLUR_PASSES_4_TO_6(TG_STATE_EQUAL)
    TG_MESH_PASS(FinalEven, SurfaceVS, GosselinFinalEvenPS, TG_STATE_SOLID)
    LIGHTS_PASSES(Gosselin, SurfaceVS)
    LIGHTS_PASSES(GosselinEven, SurfaceVS)
}

technique Lambert < string Script =
    LAMPS_SCRIPT OWN_SHADOW_SCRIPT TSM_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Final;" LIGHTS_SCRIPT("Lambert"); >
{
    LAMPS_PASSES
    OWN_SHADOW_PASS
    TSM_PASS
    TG_MESH_PASS(Final, SurfaceVS, LambertPS, TG_STATE_SOLID)
    LIGHTS_PASSES(Lambert, SurfaceVS)
}
#endif
// SPDX-License-Identifier: MIT
