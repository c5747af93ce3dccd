// Convolution: the cascade of Gaussians over the irradiance; shows the six maps weighted by the profile. Technique Poisson: Gosselin's
// blurs, gBlurCount of them; shows the last. Techniques White and WhitePoisson feed them the constant gConstantIrradiance instead, over the
// charts of the mesh: what comes out is the sum of the weights.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
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

float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "object";
    string ScriptOrder = "standard";
    string ScriptOutput = "color";
    string Script = "Technique=Convolution;";
> = 0.8;

float4 gConstantIrradiance < string UIName = "Light of technique White"; string UIWidget = "Color"; > = { 1.0, 1.0, 1.0, 0.5 };

struct ConstantVarying
{
    float4 position : SV_Position;
};

ConstantVarying ConstantVS(TgMeshInput input)
{
    ConstantVarying output;
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(input.uv, 0.0), gViewportSize);
    return output;
}

float4 ConstantPS(ConstantVarying input) : SV_Target0
{
    return gConstantIrradiance;
}

// Alpha: 1 inside the charts of the irradiance, 0 outside.
float4 ShowPS(QuadVarying input) : SV_Target0
{
    float4 uv = float4(input.uv, 0.0, 0.0);
    float4 first = tex2Dlod(gIrradiance, uv);
    float3 sum = first.rgb * gGaussianWeight[0].rgb + tex2Dlod(gIrradiance2, uv).rgb * gGaussianWeight[1].rgb +
                 tex2Dlod(gIrradiance3, uv).rgb * gGaussianWeight[2].rgb + tex2Dlod(gIrradiance4, uv).rgb * gGaussianWeight[3].rgb +
                 tex2Dlod(gIrradiance5, uv).rgb * gGaussianWeight[4].rgb + tex2Dlod(gIrradiance6, uv).rgb * gGaussianWeight[5].rgb;
    return float4(sum, 1.0) * tgSeamValidity(first);
}

float4 ShowOddPS(QuadVarying input) : SV_Target0
{
    float4 texel = tex2Dlod(gBlurOdd, float4(input.uv, 0.0, 0.0));
    return float4(texel.rgb, 1.0) * tgSeamValidity(tex2Dlod(gIrradiance, float4(input.uv, 0.0, 0.0)));
}

float4 ShowEvenPS(QuadVarying input) : SV_Target0
{
    float4 texel = tex2Dlod(gBlurEven, float4(input.uv, 0.0, 0.0));
    return float4(texel.rgb, 1.0) * tgSeamValidity(tex2Dlod(gIrradiance, float4(input.uv, 0.0, 0.0)));
}

#ifdef FX_TECHNIQUES
technique Convolution < string Script = OWN_SHADOW_SCRIPT
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
    "RenderColorTarget0=gIrradianceMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=Irradiance;"
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
    "RenderColorTarget0=; Pass=Show;"; >
{
    OWN_SHADOW_PASS
    TG_MESH_PASS(TSM, TsmVS, TsmPS, TG_STATE_TWOSIDED)
    TG_MESH_PASS(Irradiance, IrradianceVS, IrradiancePS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU1, QuadVS, ConvolutionU1PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV1, QuadVS, ConvolutionUV1PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU2, QuadVS, ConvolutionU2PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV2, QuadVS, ConvolutionUV2PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU3, QuadVS, ConvolutionU3PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV3, QuadVS, ConvolutionUV3PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU4, QuadVS, ConvolutionU4PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV4, QuadVS, ConvolutionUV4PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU5, QuadVS, ConvolutionU5PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV5, QuadVS, ConvolutionUV5PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, QuadVS, ShowPS, TG_STATE_BUFFER)
}

technique White < string Script =
    "RenderColorTarget0=gIrradianceMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=Constant;"
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
    "RenderColorTarget0=; Pass=Show;"; >
{
    TG_MESH_PASS(Constant, ConstantVS, ConstantPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU1, QuadVS, ConvolutionU1PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV1, QuadVS, ConvolutionUV1PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU2, QuadVS, ConvolutionU2PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV2, QuadVS, ConvolutionUV2PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU3, QuadVS, ConvolutionU3PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV3, QuadVS, ConvolutionUV3PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU4, QuadVS, ConvolutionU4PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV4, QuadVS, ConvolutionUV4PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionU5, QuadVS, ConvolutionU5PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ConvolutionUV5, QuadVS, ConvolutionUV5PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, QuadVS, ShowPS, TG_STATE_BUFFER)
}

technique Poisson < string Script =
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;"
    "RenderColorTarget0=gIrradianceMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=Irradiance;"
    "LoopByCount=gBlurCount; LoopGetIndex=gBlurIndex;"
    "RenderColorTarget0=gBlurIndex?gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap; Clear=Color;"
    "Pass=gBlurIndex?Blur1:Blur2:Blur3:Blur4:Blur5:Blur6; LoopEnd;"
    "RenderColorTarget0=; Pass=gBlurIndex?ShowOdd:ShowEven:ShowOdd:ShowEven:ShowOdd:ShowEven;"; >
{
    TG_MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, TG_STATE_TWOSIDED)
    TG_MESH_PASS(Irradiance, IrradianceVS, GosselinIrradiancePS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur1, QuadVS, Blur1PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur2, QuadVS, Blur2PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur3, QuadVS, Blur3PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur4, QuadVS, Blur4PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur5, QuadVS, Blur5PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur6, QuadVS, Blur6PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ShowOdd, QuadVS, ShowOddPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ShowEven, QuadVS, ShowEvenPS, TG_STATE_BUFFER)
}

technique WhitePoisson < string Script =
    "RenderColorTarget0=gIrradianceMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=Constant;"
    "LoopByCount=gBlurCount; LoopGetIndex=gBlurIndex;"
    "RenderColorTarget0=gBlurIndex?gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap:gBlurOddMap:gBlurEvenMap; Clear=Color;"
    "Pass=gBlurIndex?Blur1:Blur2:Blur3:Blur4:Blur5:Blur6; LoopEnd;"
    "RenderColorTarget0=; Pass=gBlurIndex?ShowOdd:ShowEven:ShowOdd:ShowEven:ShowOdd:ShowEven;"; >
{
    TG_MESH_PASS(Constant, ConstantVS, ConstantPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur1, QuadVS, Blur1PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur2, QuadVS, Blur2PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur3, QuadVS, Blur3PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur4, QuadVS, Blur4PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur5, QuadVS, Blur5PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Blur6, QuadVS, Blur6PS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ShowOdd, QuadVS, ShowOddPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(ShowEven, QuadVS, ShowEvenPS, TG_STATE_BUFFER)
}
#endif
