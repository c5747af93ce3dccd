// Separable: separable screen-space subsurface scattering after Jimenez et al. 2015, as a peer of Main.fx (docs/peers.md). Techniques Separable7, 11, 17 and
// 25, by the number of samples along each axis. TEGUMENT_PEERS_AS_PRINTED chooses between the authors' kernel and one of the six Gaussians.
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
#include "../../hlsl/peers/separable.fxh"
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
#include "passes/separable.fxh"

float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "object";
    string ScriptOrder = "standard";
    string ScriptOutput = "color";
    string WithoutUvs = "*";
    string Script = "Technique=Separable25;";
> = 0.8;

#ifdef FX_TECHNIQUES
technique Separable7 < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gLightMap; RenderColorTarget1=gDepthMap; RenderColorTarget2=gShadeMap; RenderDepthStencilTarget=gLightDepthMap;"
    "Clear=Color; Clear=Depth; Pass=Light;"
    "RenderColorTarget0=gScatterXMap; RenderColorTarget1=; RenderColorTarget2=; RenderDepthStencilTarget=; Pass=AlongX;"
    "RenderColorTarget0=gScatterMap; Pass=AlongY;"
    "RenderColorTarget0=; Pass=Final;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(Light, PeerVS, LightPS, STATE_SOLID)
    QUAD_PASS(AlongX, QuadVS, AlongX7PS, STATE_BUFFER)
    QUAD_PASS(AlongY, QuadVS, AlongY7PS, STATE_BUFFER)
    MESH_PASS(Final, PeerVS, ScreenFinalPS, STATE_SOLID)
}

technique Separable11 < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gLightMap; RenderColorTarget1=gDepthMap; RenderColorTarget2=gShadeMap; RenderDepthStencilTarget=gLightDepthMap;"
    "Clear=Color; Clear=Depth; Pass=Light;"
    "RenderColorTarget0=gScatterXMap; RenderColorTarget1=; RenderColorTarget2=; RenderDepthStencilTarget=; Pass=AlongX;"
    "RenderColorTarget0=gScatterMap; Pass=AlongY;"
    "RenderColorTarget0=; Pass=Final;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(Light, PeerVS, LightPS, STATE_SOLID)
    QUAD_PASS(AlongX, QuadVS, AlongX11PS, STATE_BUFFER)
    QUAD_PASS(AlongY, QuadVS, AlongY11PS, STATE_BUFFER)
    MESH_PASS(Final, PeerVS, ScreenFinalPS, STATE_SOLID)
}

technique Separable17 < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gLightMap; RenderColorTarget1=gDepthMap; RenderColorTarget2=gShadeMap; RenderDepthStencilTarget=gLightDepthMap;"
    "Clear=Color; Clear=Depth; Pass=Light;"
    "RenderColorTarget0=gScatterXMap; RenderColorTarget1=; RenderColorTarget2=; RenderDepthStencilTarget=; Pass=AlongX;"
    "RenderColorTarget0=gScatterMap; Pass=AlongY;"
    "RenderColorTarget0=; Pass=Final;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(Light, PeerVS, LightPS, STATE_SOLID)
    QUAD_PASS(AlongX, QuadVS, AlongX17PS, STATE_BUFFER)
    QUAD_PASS(AlongY, QuadVS, AlongY17PS, STATE_BUFFER)
    MESH_PASS(Final, PeerVS, ScreenFinalPS, STATE_SOLID)
}

technique Separable25 < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gLightMap; RenderColorTarget1=gDepthMap; RenderColorTarget2=gShadeMap; RenderDepthStencilTarget=gLightDepthMap;"
    "Clear=Color; Clear=Depth; Pass=Light;"
    "RenderColorTarget0=gScatterXMap; RenderColorTarget1=; RenderColorTarget2=; RenderDepthStencilTarget=; Pass=AlongX;"
    "RenderColorTarget0=gScatterMap; Pass=AlongY;"
    "RenderColorTarget0=; Pass=Final;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(Light, PeerVS, LightPS, STATE_SOLID)
    QUAD_PASS(AlongX, QuadVS, AlongX25PS, STATE_BUFFER)
    QUAD_PASS(AlongY, QuadVS, AlongY25PS, STATE_BUFFER)
    MESH_PASS(Final, PeerVS, ScreenFinalPS, STATE_SOLID)
}
#endif
