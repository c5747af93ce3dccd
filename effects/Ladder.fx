// Ladder: what each level of a pyramid weighs in the diffusion profile, over the density of texels (x). Rows: the pixel's own Gaussian and
// levels 0 to 6 for the whole profile, then for its first four Gaussians, whose pyramid may end early (gCoarseLevels), then for what
// links bring of the fourth, in the colour of the fifth, then for the fifth, where texels are too wide for its links; then the profile's
// Gaussians themselves. Shown on a grey ground.
#include "../hlsl/platform.fxh"
#include "../hlsl/settings.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/scatter/ladder.fxh"
#include "passes/annotations.fxh"
#include "passes/quad.fxh"
#include "passes/coarse_levels.fxh"
#include "passes/profile.fxh"
#include "passes/tone.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Ladder") > = 0.8;

Texture2D gLadderMap : RENDERCOLORTARGET < int Width = 160; int Height = 64; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
TG_SAMPLER2D(gLadder, POINT, CLAMP);

// In links the fourth Gaussian comes along with the fifth, with as much red as it has itself (meshprep/skin/skin_links.h).
static const float kFourthInFifth = 0.113 / 0.358;

// Colours of a Gaussian in a profile: 0 the whole, 1 what is on the ladder beside links, 2 what links bring of the fourth, 3 the fifth.
float3 colourIn(float profile, int gaussian, float3 colour, float3 fifth)
{
    float3 own = gaussian < 4 || profile < 0.5 ? colour : float3(0.0, 0.0, 0.0);
    float3 brought = gaussian == 3 ? kFourthInFifth * fifth : float3(0.0, 0.0, 0.0);
    float3 alone = gaussian == 4 ? fifth : float3(0.0, 0.0, 0.0);
    return profile > 2.5 ? alone : profile > 1.5 ? brought : own;
}

float4 ladderRow(float row, float density)
{
    float profile = floor((row + 0.5) / kTgLadderSteps);
    float step = row - profile * kTgLadderSteps;
    float top = profile > 0.5 ? linkedTop() : kTgLadderTop;
    float3 fifth = profileGaussian(4).rgb;
    float4 chosen[6];
    [unroll] for (int i = 0; i < 6; i++)
    {
        float4 gaussian = profileGaussian(i);
        chosen[i] = float4(colourIn(profile, i, gaussian.rgb, fifth), gaussian.w);
    }
    return float4(tgLadderWeight(chosen, step, density, top), 1.0);
}

float4 gaussianRow(float row)
{
    float4 chosen = 0.0;
    [unroll] for (int i = 0; i < 6; i++)
        chosen = row == kTgLadderGaussians + i ? profileGaussian(i) : chosen;
    return chosen;
}

float4 LadderPS(TgQuadVarying input) : SV_Target0
{
    float row = floor(input.uv.y * kTgLadderRows);
    float4 value;
    [branch] if (row < kTgLadderGaussians)
        value = ladderRow(row, tgLadderDensity(input.uv.x));
    else
        value = gaussianRow(row);
    return value;
}

float4 ShowPS(TgQuadVarying input) : SV_Target0
{
    return float4(0.5 + 0.5 * tex2Dlod(gLadder, float4(input.uv, 0.0, 0.0)).rgb, 1.0);
}

#ifdef FX_TECHNIQUES
technique Ladder < string Script =
    "RenderColorTarget0=gLadderMap; RenderDepthStencilTarget=; Pass=Precompute;"
    "RenderColorTarget0=; Pass=Show;"; >
{
    TG_QUAD_PASS(Precompute, TgQuadVS, LadderPS, TG_STATE_BUFFER)
    TG_QUAD_PASS(Show, TgQuadVS, ShowPS, TG_STATE_BUFFER)
}
#endif
// SPDX-License-Identifier: MIT
