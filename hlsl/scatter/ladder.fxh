// The diffusion profile on a ladder: what each level of a pyramid, and one Gaussian evaluated at each pixel, must weigh for their sum to be
// the profile. Each of its Gaussians is interpolated between the four steps around it, in the logarithm of the variance (Lagrange), so that
// the weights sum to 1 exactly, change continuously with the density of texels, and follow any profile (docs/design/modules/Ladder.md).
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
// A level that is hardly wider than the pixel's own Gaussian is left out. Where the first level is wider than so many of it, nothing lies
// between: what is narrower still is left to the pixel, for to sharpen the map instead would take weights below 0.
static const float kTgLadderApart = 1.3;
static const float kTgLadderGap = 10.0;

// Texels^2 of the base.
float tgLadderVariance(float level)
{
    return 0.5 * (exp2(2.0 * level) - 1.0) + kTgLadderPresent;
}

// The level of that variance (texels^2), not whole.
float tgLadderLevel(float variance)
{
    return 0.5 * log2(max(2.0 * (variance - kTgLadderPresent) + 1.0, 1e-6));
}

// First level on the ladder. Four steps at least remain.
float tgLadderStart(float narrow, float density, float top)
{
    float wanted = kTgLadderApart * narrow * density;
    return clamp(ceil(tgLadderLevel(max(wanted, kTgLadderPresent))), 0.0, top - 2.0);
}

// Logarithm of the variance of the step at this place of the ladder: 0 the pixel's own, then levels from `start` on.
float tgLadderRung(float place, float start, float narrow, float density)
{
    return log2(place < 0.5 ? narrow : tgLadderVariance(start + place - 1.0) / density);
}

// What a step weighs for a Gaussian. pixel: the pixel's own variance; top: the last level that there is, 2 at least.
float tgLadderWeight(float variance, float step, float pixel, float density, float top)
{
    float start = tgLadderStart(pixel, density, top);
    float narrow = max(pixel, tgLadderVariance(start) / (kTgLadderGap * density));
    float last = top - start + 1.0;
    float place = step < 0.5 ? 0.0 : step - start;
    float y = clamp(log2(variance), log2(narrow), tgLadderRung(last, start, narrow, density));
    float level = tgLadderLevel(exp2(y) * density);
    float first = level < start ? 0.0 : clamp(floor(level) - start, 0.0, last - 3.0);
    float own = tgLadderRung(place, start, narrow, density);
    float weight = (step > 0.5 && place < 0.5) || abs(place - first - 1.5) > 2.0 ? 0.0 : 1.0;
    [unroll] for (int i = 0; i < 4; i++)
    {
        float rung = tgLadderRung(first + i, start, narrow, density);
        float apart = own - rung; // 0 of the step itself
        weight *= abs(apart) > 1e-6 ? (y - rung) / apart : 1.0;
    }
    return weight;
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
