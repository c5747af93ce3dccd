// Ladder: what each level of a pyramid weighs in the diffusion profile, over the density of texels (x). Rows: the pixel's own Gaussian and
// levels 0 to 6 for the whole profile, then for its first four Gaussians, whose pyramid may end early (gCoarseLevels). Shown on a grey
// ground.
#include "../hlsl/platform.fxh"
#include "../hlsl/settings.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/scatter/ladder.fxh"
#include "passes/annotations.fxh"
#include "passes/quad.fxh"
#include "passes/coarse_levels.fxh"
#include "passes/profile.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Ladder") > = 0.8;

Texture2D gLadderMap : RENDERCOLORTARGET < int Width = 160; int Height = 16; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
TG_SAMPLER2D(gLadder, POINT, CLAMP);

// The first Gaussian is the pixel's own.
float3 profileOn(float step, float density, float count, float top)
{
    float3 sum = step < 0.5 ? gGaussianWeight[0].rgb : float3(0.0, 0.0, 0.0);
    [unroll] for (int i = 1; i < 6; i++)
    {
        float weight = tgLadderWeight(gGaussianWeight[i].w, step, gGaussianWeight[0].w, density, top);
        sum += i < count ? gGaussianWeight[i].rgb * weight : float3(0.0, 0.0, 0.0);
    }
    return sum;
}

float4 LadderPS(QuadVarying input) : SV_Target0
{
    float row = floor(input.uv.y * 2.0 * kTgLadderSteps);
    bool linked = row > kTgLadderSteps - 0.5;
    float step = linked ? row - kTgLadderSteps : row;
    return float4(profileOn(step, tgLadderDensity(input.uv.x), linked ? 4.0 : 6.0, linked ? linkedTop() : kTgLadderTop), 1.0);
}

float4 ShowPS(QuadVarying input) : SV_Target0
{
    return float4(0.5 + 0.5 * tex2Dlod(gLadder, float4(input.uv, 0.0, 0.0)).rgb, 1.0);
}

#ifdef FX_TECHNIQUES
technique Ladder < string Script =
    "RenderColorTarget0=gLadderMap; RenderDepthStencilTarget=; Pass=Precompute;"
    "RenderColorTarget0=; Pass=Show;"; >
{
    TG_QUAD_PASS(Precompute, QuadVS, LadderPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, QuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
