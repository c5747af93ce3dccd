// Main: human skin in 15 passes after d'Eon and Luebke 2007, as seed 000 Table 4 orders them. Setting by TEGUMENT_SETTING (hlsl/settings.fxh).
// Techniques, all drawing into the caller's targets: DEonLuebke, the 15 passes; DEonLuebkeCulled, the same picture without the texels that it does not
// need; Lambert, the same scene without diffusion, to set beside it.
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
#include "passes/surface.fxh"
#include "passes/irradiance.fxh"
#include "passes/stretch.fxh"
#include "passes/profile.fxh"
#include "passes/convolution.fxh"
#include "passes/cull.fxh"
#include "passes/reach.fxh"
#include "passes/final.fxh"

float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "object";
    string ScriptOrder = "standard";
    string ScriptOutput = "color";
    string Script = "Technique=DEonLuebke;";
> = 0.8;

#ifdef FX_TECHNIQUES
technique DEonLuebke < string Script =
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;"
    "ClearSetColor=gClearFarAway; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
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
    pass TSM < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL TsmVS();
        PixelShader = compile PS_MODEL TsmPS();
        STATE_TWOSIDED;
    }
    pass PrePass1 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL PrePass1VS();
        PixelShader = compile PS_MODEL PrePass1PS();
        STATE_PREPASS;
    }
    pass PrePass2 < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL PrePass2VS();
        PixelShader = compile PS_MODEL PrePass2PS();
        STATE_PREPASS;
    }
    pass Irradiance < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL IrradianceVS();
        PixelShader = compile PS_MODEL IrradiancePS();
        STATE_EQUAL;
    }
    pass ConvolutionU1 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU1PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV1 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV1PS();
        STATE_EQUAL;
    }
    pass ConvolutionU2 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU2PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV2 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV2PS();
        STATE_EQUAL;
    }
    pass ConvolutionU3 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU3PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV3 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV3PS();
        STATE_EQUAL;
    }
    pass ConvolutionU4 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU4PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV4 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV4PS();
        STATE_EQUAL;
    }
    pass ConvolutionU5 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU5PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV5 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV5PS();
        STATE_EQUAL;
    }
    pass Final < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL FinalVS();
        PixelShader = compile PS_MODEL FinalPS();
        STATE_SOLID;
    }
}

technique DEonLuebkeCulled < string Script =
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;"
    "ClearSetColor=gClearFarAway; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
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
    pass TSM < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL TsmVS();
        PixelShader = compile PS_MODEL TsmPS();
        STATE_TWOSIDED;
    }
    pass CullNeed < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL CullNeedVS();
        PixelShader = compile PS_MODEL CullNeedPS();
        STATE_BUFFER;
    }
    pass CullTiles < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL CullTilesPS();
        STATE_BUFFER;
    }
    pass CullReachU < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL CullReachUPS();
        STATE_BUFFER;
    }
    pass CullReachV < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL CullReachVPS();
        STATE_BUFFER;
    }
    pass PrePass1 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL PrePass1VS();
        PixelShader = compile PS_MODEL PrePass1ReachPS();
        STATE_PREPASS;
    }
    pass PrePass2 < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL PrePass2ReachVS();
        PixelShader = compile PS_MODEL PrePass2ReachPS();
        STATE_PREPASS;
    }
    pass Irradiance < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL IrradianceVS();
        PixelShader = compile PS_MODEL IrradiancePS();
        STATE_EQUAL;
    }
    pass ConvolutionU1 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU1PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV1 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV1PS();
        STATE_EQUAL;
    }
    pass ConvolutionU2 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU2PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV2 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV2PS();
        STATE_EQUAL;
    }
    pass ConvolutionU3 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU3PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV3 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV3PS();
        STATE_EQUAL;
    }
    pass ConvolutionU4 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU4PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV4 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV4PS();
        STATE_EQUAL;
    }
    pass ConvolutionU5 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionU5PS();
        STATE_EQUAL;
    }
    pass ConvolutionUV5 < string Script = "Draw=Buffer;"; >
    {
        VertexShader = compile VS_MODEL QuadVS();
        PixelShader = compile PS_MODEL ConvolutionUV5PS();
        STATE_EQUAL;
    }
    pass Final < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL FinalVS();
        PixelShader = compile PS_MODEL FinalPS();
        STATE_SOLID;
    }
}

technique Lambert < string Script =
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;"
    "ClearSetColor=gClearFarAway; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Final;"; >
{
    pass TSM < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL TsmVS();
        PixelShader = compile PS_MODEL TsmPS();
        STATE_TWOSIDED;
    }
    pass Final < string Script = "Draw=Geometry;"; >
    {
        VertexShader = compile VS_MODEL FinalVS();
        PixelShader = compile PS_MODEL LambertPS();
        STATE_SOLID;
    }
}
#endif
