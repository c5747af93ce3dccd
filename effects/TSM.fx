// TSM: depth and texture coordinates of the surface nearest to the light, shown as (depth between the light's planes, u, v).
#include "../hlsl/platform.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/workspace.fxh"
#include "passes/quad.fxh"
#include "passes/tsm.fxh"

float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "object";
    string ScriptOrder = "standard";
    string ScriptOutput = "color";
    string Script = "Technique=TSM;";
> = 0.8;

float4 ShowPS(QuadVarying input) : SV_Target0
{
    float4 texel = tex2Dlod(gTsm, float4(input.uv, 0.0, 0.0));
    float depth = kTgDepthInMillimetres
        ? (texel.x - tgMillimetres(gLightNear)) / max(tgMillimetres(gLightFar - gLightNear), 1e-6) : texel.x;
    return float4(float3(saturate(depth), texel.yz) * texel.w, 1.0);
}

#ifdef FX_TECHNIQUES
technique TSM < string Script =
    "RenderColorTarget0=gTsmMap; RenderDepthStencilTarget=gTsmDepthMap;"
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=TSM;"
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Show;"; >
{
    TG_MESH_PASS(TSM, TsmVS, TsmPS, TG_STATE_TWOSIDED)
    TG_QUAD_PASS(Show, QuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
