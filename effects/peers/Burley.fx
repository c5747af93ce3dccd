// Burley: normalised diffusion gathered over a disc of the picture with importance sampling, after Golubev 2018, as a peer of Main.fx (docs/peers.md).
// Techniques Burley20, 40 and 80, by the number of samples. TEGUMENT_PEERS_AS_PRINTED chooses between the published weights on a disc that faces the eye and
// weights over area on one that lies in the surface.
#include "../../hlsl/platform.fxh"
#include "../../hlsl/settings.fxh"
#include "../../hlsl/workspace.fxh"
#include "../../hlsl/surface/normal.fxh"
#include "../../hlsl/surface/halves.fxh"
#include "../../hlsl/specular/fresnel.fxh"
#include "../../hlsl/specular/beckmann.fxh"
#include "../../hlsl/specular/kelemen.fxh"
#include "../../hlsl/specular/energy.fxh"
#include "../../hlsl/shadow/map.fxh"
#include "../../hlsl/scatter/irradiance.fxh"
#include "../../hlsl/peers/screen.fxh"
#include "../../hlsl/peers/burley.fxh"
#include "../passes/quad.fxh"
#include "../passes/materials.fxh"
#include "../passes/skin_parameters.fxh"
#include "../passes/shadow_map.fxh"
#include "../passes/surface.fxh"
#include "../passes/specular.fxh"
#include "passes/energy_map.fxh"
#include "../passes/energy_share.fxh"
#include "passes/point.fxh"
#include "passes/screen.fxh"
#include "passes/burley.fxh"

float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "object";
    string ScriptOrder = "standard";
    string ScriptOutput = "color";
    string WithoutUvs = "*";
    string Script = "Technique=Burley40;";
> = 0.8;

#ifdef FX_TECHNIQUES
technique Burley20 < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gLightMap; RenderColorTarget1=gDepthMap; RenderColorTarget2=gShadeMap; RenderDepthStencilTarget=gLightDepthMap;"
    "Clear=Color; Clear=Depth; Pass=Light;"
    "RenderColorTarget0=gScatterMap; RenderColorTarget1=; RenderColorTarget2=; RenderDepthStencilTarget=; Pass=Gather;"
    "RenderColorTarget0=; Pass=Final;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(Light, PeerVS, LightPS, STATE_SOLID)
    QUAD_PASS(Gather, QuadVS, Gather20PS, STATE_BUFFER)
    MESH_PASS(Final, PeerVS, ScreenFinalPS, STATE_SOLID)
}

technique Burley40 < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gLightMap; RenderColorTarget1=gDepthMap; RenderColorTarget2=gShadeMap; RenderDepthStencilTarget=gLightDepthMap;"
    "Clear=Color; Clear=Depth; Pass=Light;"
    "RenderColorTarget0=gScatterMap; RenderColorTarget1=; RenderColorTarget2=; RenderDepthStencilTarget=; Pass=Gather;"
    "RenderColorTarget0=; Pass=Final;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(Light, PeerVS, LightPS, STATE_SOLID)
    QUAD_PASS(Gather, QuadVS, Gather40PS, STATE_BUFFER)
    MESH_PASS(Final, PeerVS, ScreenFinalPS, STATE_SOLID)
}

technique Burley80 < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gLightMap; RenderColorTarget1=gDepthMap; RenderColorTarget2=gShadeMap; RenderDepthStencilTarget=gLightDepthMap;"
    "Clear=Color; Clear=Depth; Pass=Light;"
    "RenderColorTarget0=gScatterMap; RenderColorTarget1=; RenderColorTarget2=; RenderDepthStencilTarget=; Pass=Gather;"
    "RenderColorTarget0=; Pass=Final;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(Light, PeerVS, LightPS, STATE_SOLID)
    QUAD_PASS(Gather, QuadVS, Gather80PS, STATE_BUFFER)
    MESH_PASS(Final, PeerVS, ScreenFinalPS, STATE_SOLID)
}
#endif
