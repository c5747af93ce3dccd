// Irradiance: diffuse light with shadow, drawn into texture space, shown as it is stored. Techniques: Irradiance, as d'Eon and Luebke's
// passes take it (colour, energy, thickness in alpha); IrradianceGosselin, as Gosselin's do (white, kernel size in alpha).
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
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
#include "passes/irradiance.fxh"
#include "passes/irradiance_gosselin.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Irradiance") > = 0.8;

float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    return float4(tex2Dlod(gIrradiance, float4(input.uv, 0.0, 0.0)).rgb, 1.0);
}

#ifdef FX_TECHNIQUES
technique Irradiance < string Script =
    LAMPS_SCRIPT OWN_SHADOW_SCRIPT TSM_SCRIPT
    IRRADIANCE_SCRIPT("Irradiance")
    "RenderColorTarget0=; Pass=Show;"; >
{
    LAMPS_PASSES
    OWN_SHADOW_PASS
    TSM_PASS
    TG_MESH_PASS(Irradiance, IrradianceVS, IrradiancePS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}

technique IrradianceGosselin < string Script =
    LAMPS_SCRIPT SHADOW_MAP_SCRIPT
    IRRADIANCE_SCRIPT("Irradiance")
    "RenderColorTarget0=; Pass=Show;"; >
{
    LAMPS_PASSES
    SHADOW_MAP_PASS
    TG_MESH_PASS(Irradiance, IrradianceVS, GosselinIrradiancePS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
// SPDX-License-Identifier: MIT
