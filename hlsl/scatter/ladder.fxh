// The diffusion profile on a ladder: what each level of a pyramid, and one Gaussian evaluated at each pixel, must weigh for their sum to be
// the profile. Of all weights that are not below 0 and whose sum is the profile's, those whose edge comes nearest to the profile's
// (docs/design/modules/Ladder.md).
// Level l of a pyramid of quadratic B-splines is a Gaussian of (4^l - 1) / 2 texels^2 of the base, besides what is present before it and
// after it. Units: variance in mm^2, density in texels^2 of the base per mm^2. Step 0: the pixel's own Gaussian; step s: level s - 1.
#ifndef TEGUMENT_SCATTER_LADDER_FXH
#define TEGUMENT_SCATTER_LADDER_FXH

// Levels above the base.
static const float kTgLadderTop = 6.0;
// Columns of a table over the binary logarithm of the density, from kTgLadderFirst in steps of 1 / kTgLadderFineness; its rows are the
// steps, for the whole profile, for its first four Gaussians, for what links bring of the fourth, and for the fifth; then the six
// Gaussians themselves, weights and variance; a power of two of them, so that the middle of each is a number without rounding.
static const float kTgLadderColumns = 160.0;
static const float kTgLadderFirst = -6.0;
static const float kTgLadderFineness = 8.0;
static const float kTgLadderSteps = 8.0;
static const float kTgLadderGaussians = 32.0; // the first of their rows
static const float kTgLadderRows = 64.0;
// Present in every level: a texel's own square (1/12) and the bilinear look-up (1/6), texels^2 of the base.
static const float kTgLadderPresent = 1.0 / 12.0 + 1.0 / 6.0;
// Variance of the pixel's own Gaussian, mm^2: its shadow is filtered as widely (shadow/planar.fxh). A level that is hardly wider is left
// out, for it is as coarse as the map.
static const float kTgLadderPixel = 0.0064;
static const float kTgLadderApart = 1.3;
// Rounds over all pairs of steps: of which the edge is within 0.001 of the limit.
static const float kTgLadderRounds = 32.0;

// Texels^2 of the base.
float tgLadderVariance(float level)
{
    return 0.5 * (exp2(2.0 * level) - 1.0) + kTgLadderPresent;
}

// Variance of a step, mm^2; 0 of one that is not on the ladder. top: the last level that there is.
float tgLadderStep(float step, float density, float top)
{
    float level = tgLadderVariance(step - 1.0) / density;
    bool on = step < top + 1.5 && level > kTgLadderApart * kTgLadderPixel;
    return step < 0.5 ? kTgLadderPixel : on ? level : 0.0;
}

// 1 where the number of a step, counted from the first of four, is `step`.
float4 tgLadderAt(float first, float step)
{
    return saturate(1.0 - abs(float4(0.0, 1.0, 2.0, 3.0) + first - step));
}

// What a step weighs. profile: weights (RGB) and variance. For mixtures of centred Gaussians the integral of the squared difference of two
// responses to a half-plane is the quadratic form -sum_ij c_i c_j sqrt((v_i + v_j) / (2 pi)), so that weight moves from one step to another
// by an amount in closed form. All of it starts at the pixel. Steps stand side by side, channels one after the other: registers are few.
float3 tgLadderWeight(float4 profile[6], float step, float density, float top)
{
    float4 v0 = float4(tgLadderStep(0.0, density, top), tgLadderStep(1.0, density, top),
                       tgLadderStep(2.0, density, top), tgLadderStep(3.0, density, top));
    float4 v1 = float4(tgLadderStep(4.0, density, top), tgLadderStep(5.0, density, top),
                       tgLadderStep(6.0, density, top), tgLadderStep(7.0, density, top));
    float3 own = 0.0;
    [loop] for (float c = 0.0; c < 3.0; c += 1.0)
    {
        float3 channel = tgLadderAt(0.0, c).xyz;
        float4 weight0 = 0.0;
        float4 weight1 = 0.0;
        [unroll] for (int i = 0; i < 6; i++)
            weight0.x += dot(profile[i].rgb, channel);
        [loop] for (float turn = 0.0; turn < kTgLadderRounds; turn += 1.0)
            [loop] for (float pair = 8.0; pair < 64.0; pair += 1.0)
            {
                float a = floor(pair / 8.0);
                float b = pair - 8.0 * a;
                float4 a0 = tgLadderAt(0.0, a);
                float4 a1 = tgLadderAt(4.0, a);
                float4 b0 = tgLadderAt(0.0, b);
                float4 b1 = tgLadderAt(4.0, b);
                float va = dot(v0, a0) + dot(v1, a1);
                float vb = dot(v0, b0) + dot(v1, b1);
                [branch] if (b < a && min(va, vb) > 0.0)
                {
                    float gain = dot(weight0, sqrt(v0 + va) - sqrt(v0 + vb)) + dot(weight1, sqrt(v1 + va) - sqrt(v1 + vb));
                    [unroll] for (int j = 0; j < 6; j++)
                        gain += dot(profile[j].rgb, channel) * (sqrt(vb + profile[j].w) - sqrt(va + profile[j].w));
                    float curve = 2.0 * sqrt(va + vb) - sqrt(2.0 * va) - sqrt(2.0 * vb);
                    float most = dot(weight0, b0) + dot(weight1, b1);
                    float least = -dot(weight0, a0) - dot(weight1, a1);
                    float moved = clamp(gain / curve, least, most);
                    weight0 += moved * (a0 - b0);
                    weight1 += moved * (a1 - b1);
                }
            }
        own += channel * (dot(weight0, tgLadderAt(0.0, step)) + dot(weight1, tgLadderAt(4.0, step)));
    }
    return max(own, 0.0);
}

// Where a table of weights has a step: `row` counted over all profiles.
float2 tgLadderCoordinate(float row, float density)
{
    float column = (log2(max(density, 1e-6)) - kTgLadderFirst) * kTgLadderFineness;
    return float2(column / kTgLadderColumns, (row + 0.5) / kTgLadderRows);
}

// The density that a table's column stands for.
float tgLadderDensity(float u)
{
    return exp2(u * kTgLadderColumns / kTgLadderFineness + kTgLadderFirst);
}

#endif
// SPDX-License-Identifier: MIT
