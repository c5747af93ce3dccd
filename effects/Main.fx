// Main: human skin, in 15 passes after d'Eon and Luebke 2007 and in 8 after Gosselin, Sander and Mitchell 2004, as seed 000 Tables 3 and 4 order them.
// Setting by TEGUMENT_SETTING (hlsl/settings.fxh). Techniques, all drawing into the caller's targets: DEonLuebke and Gosselin; DEonLuebkeCulled and
// GosselinCulled, the same pictures without the texels that they do not need; Lambert, the same scene without diffusion, to set beside them.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
#include "../hlsl/cull.fxh"
#include "passes/quad.fxh"
#include "passes/materials.fxh"
#include "passes/skin_parameters.fxh"
#include "passes/tsm.fxh"
#include "passes/shadow_map.fxh"
#include "passes/surface.fxh"
#include "passes/specular.fxh"
#include "passes/skin_point.fxh"
#include "passes/energy_share.fxh"
#include "passes/irradiance.fxh"
#include "passes/irradiance_gosselin.fxh"
#include "passes/stretch.fxh"
#include "passes/profile.fxh"
#include "passes/convolution.fxh"
#include "passes/blur_parameters.fxh"
#include "passes/poisson.fxh"
#include "passes/cull.fxh"
#include "passes/reach.fxh"
#include "passes/final.fxh"
#include "passes/final_gosselin.fxh"

float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "object";
    string ScriptOrder = "standard";
    string ScriptOutput = "color";
    string WithoutUvs = "Lambert, peers/Separable.fx, peers/Burley.fx, Specular.fx";
    string Script = "Technique=DEonLuebke;";
> = 0.8;

#ifdef FX_TECHNIQUES
technique DEonLuebke < string Script = OWN_SHADOW_SCRIPT
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
    "RenderColorTarget0=gIrradianceMap; RenderDepthStencilTarget=gUnwrapDepthMap;"
    "ClearSetColor=gClearInvalid; ClearSetDepth=gClearNear; Clear=Color; Clear=Depth;"
    "LoopByCount=gUsePrePass; Pass=PrePass1; Pass=PrePass2; LoopEnd;"
    "Pass=Irradiance;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU1;"
    "RenderColorTarget0=gIrradiance2Map; Clear=Color; Pass=ConvolutionUV1;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU2;"
    "RenderColorTarget0=gIrradiance3Map; Clear=Color; Pass=ConvolutionUV2;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU3;"
    "RenderColorTarget0=gIrradiance4Map; Clear=Color; Pass=ConvolutionUV3;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU4;"
    "RenderColorTarget0=gIrradiance5Map; Clear=Color; Pass=ConvolutionUV4;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU5;"
    "RenderColorTarget0=gIrradiance6Map; Clear=Color; Pass=ConvolutionUV5;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Final;"; >
{
    OWN_SHADOW_PASS
    MESH_PASS(TSM, TsmVS, TsmPS, STATE_TWOSIDED)
    QUAD_PASS(PrePass1, PrePass1VS, PrePass1PS, STATE_PREPASS)
    MESH_PASS(PrePass2, PrePass2VS, PrePass2PS, STATE_PREPASS)
    MESH_PASS(Irradiance, IrradianceVS, IrradiancePS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU1, QuadVS, ConvolutionU1PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV1, QuadVS, ConvolutionUV1PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU2, QuadVS, ConvolutionU2PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV2, QuadVS, ConvolutionUV2PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU3, QuadVS, ConvolutionU3PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV3, QuadVS, ConvolutionUV3PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU4, QuadVS, ConvolutionU4PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV4, QuadVS, ConvolutionUV4PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU5, QuadVS, ConvolutionU5PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV5, QuadVS, ConvolutionUV5PS, STATE_EQUAL)
    MESH_PASS(Final, FinalVS, FinalPS, STATE_SOLID)
}

technique DEonLuebkeCulled < string Script = OWN_SHADOW_SCRIPT
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
    "RenderColorTarget0=gCullNeedMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=CullNeed;"
    "RenderColorTarget0=gCullTilesMap; Pass=CullTiles; RenderColorTarget0=gCullReachUMap; Pass=CullReachU;"
    "RenderColorTarget0=gCullReachMap; Pass=CullReachV;"
    "RenderColorTarget0=gIrradianceMap; RenderDepthStencilTarget=gUnwrapDepthMap;"
    "ClearSetColor=gClearInvalid; ClearSetDepth=gClearNear; Clear=Color; Clear=Depth;"
    "Pass=PrePass1; Pass=PrePass2;"
    "Pass=Irradiance;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU1;"
    "RenderColorTarget0=gIrradiance2Map; Clear=Color; Pass=ConvolutionUV1;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU2;"
    "RenderColorTarget0=gIrradiance3Map; Clear=Color; Pass=ConvolutionUV2;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU3;"
    "RenderColorTarget0=gIrradiance4Map; Clear=Color; Pass=ConvolutionUV3;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU4;"
    "RenderColorTarget0=gIrradiance5Map; Clear=Color; Pass=ConvolutionUV4;"
    "RenderColorTarget0=gIrradianceUMap; Clear=Color; Pass=ConvolutionU5;"
    "RenderColorTarget0=gIrradiance6Map; Clear=Color; Pass=ConvolutionUV5;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Final;"; >
{
    OWN_SHADOW_PASS
    MESH_PASS(TSM, TsmVS, TsmPS, STATE_TWOSIDED)
    MESH_PASS(CullNeed, CullNeedVS, CullNeedPS, STATE_BUFFER)
    QUAD_PASS(CullTiles, QuadVS, CullTilesPS, STATE_BUFFER)
    QUAD_PASS(CullReachU, QuadVS, CullReachUPS, STATE_BUFFER)
    QUAD_PASS(CullReachV, QuadVS, CullReachVPS, STATE_BUFFER)
    QUAD_PASS(PrePass1, PrePass1VS, PrePass1ReachPS, STATE_PREPASS)
    MESH_PASS(PrePass2, PrePass2ReachVS, PrePass2ReachPS, STATE_PREPASS)
    MESH_PASS(Irradiance, IrradianceVS, IrradiancePS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU1, QuadVS, ConvolutionU1PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV1, QuadVS, ConvolutionUV1PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU2, QuadVS, ConvolutionU2PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV2, QuadVS, ConvolutionUV2PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU3, QuadVS, ConvolutionU3PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV3, QuadVS, ConvolutionUV3PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU4, QuadVS, ConvolutionU4PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV4, QuadVS, ConvolutionUV4PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionU5, QuadVS, ConvolutionU5PS, STATE_EQUAL)
    QUAD_PASS(ConvolutionUV5, QuadVS, ConvolutionUV5PS, STATE_EQUAL)
    MESH_PASS(Final, FinalVS, FinalPS, STATE_SOLID)
}

technique Gosselin < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gIrradianceMap; RenderDepthStencilTarget=gUnwrapDepthMap;"
    "ClearSetColor=gClearInvalid; ClearSetDepth=gClearNear; Clear=Color; Clear=Depth;"
    "LoopByCount=gUsePrePass; Pass=PrePass1; Pass=PrePass2; LoopEnd;"
    "Pass=Irradiance;"
    "LoopByCount=gBlurCount; LoopGetIndex=gBlurIndex;"
    "RenderColorTarget0=gBlurIndex?gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap; Clear=Color;"
    "Pass=gBlurIndex?Blur1:Blur2:Blur3:Blur4:Blur5:Blur6; LoopEnd;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=gBlurIndex?Final:FinalEven:Final:FinalEven:Final:FinalEven;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    QUAD_PASS(PrePass1, PrePass1VS, PrePass1PS, STATE_PREPASS)
    MESH_PASS(PrePass2, PrePass2VS, PrePass2PS, STATE_PREPASS)
    MESH_PASS(Irradiance, IrradianceVS, GosselinIrradiancePS, STATE_EQUAL)
    QUAD_PASS(Blur1, QuadVS, Blur1PS, STATE_EQUAL)
    QUAD_PASS(Blur2, QuadVS, Blur2PS, STATE_EQUAL)
    QUAD_PASS(Blur3, QuadVS, Blur3PS, STATE_EQUAL)
    MESH_PASS(Final, FinalVS, GosselinFinalPS, STATE_SOLID)
    QUAD_PASS(Blur4, QuadVS, Blur4PS, STATE_EQUAL)
    QUAD_PASS(Blur5, QuadVS, Blur5PS, STATE_EQUAL)
    QUAD_PASS(Blur6, QuadVS, Blur6PS, STATE_EQUAL)
    MESH_PASS(FinalEven, FinalVS, GosselinFinalEvenPS, STATE_SOLID)
}

technique GosselinCulled < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gCullNeedMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=CullNeed;"
    "RenderColorTarget0=gCullTilesMap; Pass=CullTiles; RenderColorTarget0=gCullReachUMap; Pass=CullReachU;"
    "RenderColorTarget0=gCullReachMap; Pass=CullReachV;"
    "RenderColorTarget0=gIrradianceMap; RenderDepthStencilTarget=gUnwrapDepthMap;"
    "ClearSetColor=gClearInvalid; ClearSetDepth=gClearNear; Clear=Color; Clear=Depth;"
    "Pass=PrePass1; Pass=PrePass2;"
    "Pass=Irradiance;"
    "LoopByCount=gBlurCount; LoopGetIndex=gBlurIndex;"
    "RenderColorTarget0=gBlurIndex?gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap; Clear=Color;"
    "Pass=gBlurIndex?Blur1:Blur2:Blur3:Blur4:Blur5:Blur6; LoopEnd;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=gBlurIndex?Final:FinalEven:Final:FinalEven:Final:FinalEven;"; >
{
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED)
    MESH_PASS(CullNeed, BlurNeedVS, BlurNeedPS, STATE_BUFFER)
    QUAD_PASS(CullTiles, QuadVS, CullTilesPS, STATE_BUFFER)
    QUAD_PASS(CullReachU, QuadVS, BlurReachUPS, STATE_BUFFER)
    QUAD_PASS(CullReachV, QuadVS, BlurReachVPS, STATE_BUFFER)
    QUAD_PASS(PrePass1, PrePass1VS, PrePass1ReachPS, STATE_PREPASS)
    MESH_PASS(PrePass2, PrePass2ReachVS, PrePass2ReachPS, STATE_PREPASS)
    MESH_PASS(Irradiance, IrradianceVS, GosselinIrradiancePS, STATE_EQUAL)
    QUAD_PASS(Blur1, QuadVS, Blur1PS, STATE_EQUAL)
    QUAD_PASS(Blur2, QuadVS, Blur2PS, STATE_EQUAL)
    QUAD_PASS(Blur3, QuadVS, Blur3PS, STATE_EQUAL)
    MESH_PASS(Final, FinalVS, GosselinFinalPS, STATE_SOLID)
    QUAD_PASS(Blur4, QuadVS, Blur4PS, STATE_EQUAL)
    QUAD_PASS(Blur5, QuadVS, Blur5PS, STATE_EQUAL)
    QUAD_PASS(Blur6, QuadVS, Blur6PS, STATE_EQUAL)
    MESH_PASS(FinalEven, FinalVS, GosselinFinalEvenPS, STATE_SOLID)
}

technique Lambert < string Script = OWN_SHADOW_SCRIPT
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Final;"; >
{
    OWN_SHADOW_PASS
    MESH_PASS(TSM, TsmVS, TsmPS, STATE_TWOSIDED)
    MESH_PASS(Final, FinalVS, LambertPS, STATE_SOLID)
}
#endif
