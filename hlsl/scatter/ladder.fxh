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
// steps, for the whole profile, for its first four Gaussians, for what links bring of the fourth, and for the fifth; a power of two of
// them, so that the middle of each is a number without rounding.
static const float kTgLadderColumns = 160.0;
static const float kTgLadderFirst = -6.0;
static const float kTgLadderFineness = 8.0;
static const float kTgLadderSteps = 8.0;
static const float kTgLadderRows = 32.0;
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

// What a step weighs. profile: weights (RGB) and variance. For mixtures of centred Gaussians the integral of the squared difference of two
// responses to a half-plane is the quadratic form -sum_ij c_i c_j sqrt((v_i + v_j) / (2 pi)), so that weight moves from one step to another
// by an amount in closed form. All of it starts at the pixel.
float3 tgLadderWeight(float4 profile[6], float step, float density, float top)
{
    float variance[8];
    float3 weight[8];
    float3 slope[8];
    [unroll] for (int i = 0; i < 8; i++)
    {
        variance[i] = tgLadderStep(i, density, top);
        weight[i] = 0.0;
        slope[i] = 0.0;
        [unroll] for (int j = 0; j < 6; j++)
        {
            weight[i] += i == 0 ? profile[j].rgb : float3(0.0, 0.0, 0.0);
            slope[i] += profile[j].rgb * (sqrt(variance[i] + profile[j].w) - sqrt(variance[i] + kTgLadderPixel));
        }
    }
    [loop] for (float turn = 0.0; turn < kTgLadderRounds; turn++)
        [loop] for (float a = 1.0; a < kTgLadderSteps; a++)
            [loop] for (float b = 0.0; b < a; b++)
            {
                float2 pair = 0.0; // variances
                float3 most = 0.0;
                float3 least = 0.0;
                float3 gain = 0.0;
                [unroll] for (int k = 0; k < 8; k++)
                {
                    pair += variance[k] * float2(k == a ? 1.0 : 0.0, k == b ? 1.0 : 0.0);
                    most += k == b ? weight[k] : float3(0.0, 0.0, 0.0);
                    least -= k == a ? weight[k] : float3(0.0, 0.0, 0.0);
                    gain += slope[k] * (k == b ? 1.0 : k == a ? -1.0 : 0.0);
                }
                float curve = 2.0 * sqrt(pair.x + pair.y) - sqrt(2.0 * pair.x) - sqrt(2.0 * pair.y);
                float3 moved = min(pair.x, pair.y) > 0.0 ? clamp(gain / curve, least, most) : float3(0.0, 0.0, 0.0);
                [unroll] for (int s = 0; s < 8; s++)
                {
                    weight[s] += moved * (s == a ? 1.0 : s == b ? -1.0 : 0.0);
                    slope[s] += moved * (sqrt(variance[s] + pair.y) - sqrt(variance[s] + pair.x));
                }
            }
    float3 own = 0.0;
    [unroll] for (int s = 0; s < 8; s++)
        own += s == step ? weight[s] : float3(0.0, 0.0, 0.0);
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
