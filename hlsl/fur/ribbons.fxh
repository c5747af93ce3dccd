// Strands as ribbons: flat bands along a strand's axis that face the eye (`tegument fur strands` writes them, docs/design/fur.md). A
// vertex stands on its root; the vertex shader takes it to its place on the strand, and the pixel shader needs only its distance from the
// axis.
#ifndef TEGUMENT_FUR_RIBBONS_FXH
#define TEGUMENT_FUR_RIBBONS_FXH

static const float kTgRibbonRow = 32.0;    // parts of 1 that a place along the strand is stored in: 31 of them are its tip
static const float kTgRibbonShort = 16.0;  // steps of a shortness
static const float kTgRibbonColor = 32.0;  // and of the root of each channel of a colour
static const float kTgRibbonColumns = 4096.0; // of the texture of roots
static const float kTgRibbonFirst = 4096.0;   // least address of a root: what has less as its v is skin

// What a vertex says of its strand.
struct TgRibbon
{
    float along;     // 0 root, 1 tip
    float shortness; // 0 a body's long fur, 1 that of ears, paws, noses
    float3 color;    // linear
};

// Whole numbers below 2^19 and parts of 32: a float holds both exactly.
TgRibbon tgRibbon(float stored)
{
    TgRibbon ribbon;
    float code = floor(stored);
    ribbon.along = (stored - code) * (kTgRibbonRow / (kTgRibbonRow - 1.0));
    float3 digits = float3(floor(code / kTgRibbonShort), 0.0, 0.0);
    ribbon.shortness = (code - kTgRibbonShort * digits.x) / (kTgRibbonShort - 1.0);
    digits.y = floor(digits.x / kTgRibbonColor);
    digits.z = floor(digits.y / kTgRibbonColor);
    float3 root = (digits - kTgRibbonColor * float3(digits.yz, 0.0)) / (kTgRibbonColor - 1.0);
    ribbon.color = root * root;
    return ribbon;
}

// In [0, 1), evenly: which strands are drawn where only a share of them is. address: of the root's texels, below 2^24.
float tgRibbonRank(float address)
{
    float row = floor(address / kTgRibbonColumns);
    float column = address - kTgRibbonColumns * row;
    return frac(column * 0.6180340 + row * 0.7548777);
}

// Half of what is drawn of a strand's width, and how much of it the strand covers: what is narrower than a pixel is drawn a pixel wide, as
// much fainter, as tgFurSection draws it. radius, pixel: in one unit.
float2 tgRibbonWidth(float radius, float pixel)
{
    return float2(max(radius, 0.5 * pixel), saturate(2.0 * radius / pixel));
}

// Share of a pixel that is covered. edge: distance from the axis, half of the width, both in pixels; tgRibbonWidth's faintness.
float tgRibbonCoverage(float3 edge)
{
    return saturate(edge.y - abs(edge.x) + 0.5) * edge.z;
}

// What light has passed of strands before it comes to this depth behind the coat's front. sums: opacity from the front to each of four
// depths; depths: rising. Between them it grows evenly; behind the last it is what it was there.
float tgFurOpacity(float4 sums, float4 depths, float depth)
{
    float4 before = float4(0.0, depths.xyz);
    float4 parts = saturate((depth - before) / (depths - before));
    return dot(sums - float4(0.0, sums.xyz), parts);
}

// Two highlights of a strand (S. Marschner et al., Light Scattering from Human Hair Fibers, 2003, in the form of T. Scheuermann, Practical
// Real-Time Hair Rendering and Shading, 2004): R, mirrored by the surface, moved to the root; TRT, mirrored inside, to the tip.
// shift: of R and TRT along the normal; exponents: of the sine between strand and half vector.
float2 tgFurHighlights(float3 strand, float3 normal, float3 toLight, float3 toEye, float2 shift, float2 exponents)
{
    float3 sum = toLight + toEye;
    float3 halfway = sum * rsqrt(max(dot(sum, sum), 1e-8));
    float3 first = strand + shift.x * normal;
    float3 second = strand + shift.y * normal;
    float2 along = float2(dot(first, halfway), dot(second, halfway));
    float2 squares = float2(dot(first, first), dot(second, second));
    float2 sines = saturate(1.0 - along * along / max(squares, 1e-8)); // squared
    return float2(pow(max(sines.x, 1e-6), 0.5 * exponents.x), pow(max(sines.y, 1e-6), 0.5 * exponents.y));
}

#endif
// SPDX-License-Identifier: MIT
