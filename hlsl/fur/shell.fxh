// Shells: the mesh drawn once more for each of n layers, moved out along its normals (seed 004, "extrusao da malha"):
//   P' = P + N * K * meshRadius * l / n,  l = 1 .. n; layer 0 is the mesh itself. K and n may change from frame to frame.
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_FUR_SHELL_FXH
#define TEGUMENT_FUR_SHELL_FXH

// Height of a layer in the coat, 0 the skin, 1 the tips. index counts from 0; outerFirst 1 draws the outermost shell first.
float tgFurLayerHeight(float index, float layers, float outerFirst)
{
    float count = max(layers, 1.0);
    return saturate(lerp(index + 1.0, count - index, outerFirst) / count);
}

// Layers that stand denser at the tips (exponent below 1) or at the roots (above 1): heights (l / n)^exponent.
float tgFurSpread(float height, float exponent)
{
    return height < 1.0 ? pow(max(height, 1e-6), exponent) : 1.0;
}

// furLength: K, the coat's thickness as a share of the mesh's radius; the distance has the radius's unit.
float tgFurDistance(float furLength, float meshRadius, float height)
{
    return furLength * meshRadius * height;
}

// From the root to the point at this height, in units of the distance along the normal. lean: where tips hang and how far: 0 upright, of
// length 1 as far as out.
float3 tgFurStrand(float3 normal, float3 lean, float height)
{
    return normal + lean * height;
}

// Unit direction of the strand there: derivative of height * tgFurStrand.
float3 tgFurTangent(float3 normal, float3 lean, float height)
{
    return tgSafeNormalize(normal + 2.0 * height * lean);
}

// Depth z of a clip position whose planes were fitted to the mesh: what the coat has before the nearer one is not cut off but drawn close
// behind it, in order. From kTgNearMargin of w on, z / w falls to 0 as an exponential that goes on from it without a bend.
static const float kTgNearMargin = 0.01;
float tgFurNearDepth(float z, float w)
{
    float margin = kTgNearMargin * max(w, 1e-20);
    return z < margin && w > 0.0 ? margin * exp(max(z / margin - 1.0, -80.0)) : z;
}

// How much of a texel is covered at this height. alpha: of a fur map, the height at which its strands end; taper 0 takes it as coverage,
// whatever the height (the seed's maps hold 0 and 1), 1 compares it with the height, across `softness` of it.
float tgFurCoverage(float alpha, float height, float taper, float softness)
{
    float standing = saturate((alpha - height) / max(softness, 1e-4) + 0.5);
    return lerp(alpha, min(standing, saturate(alpha * 1e4)), taper);
}

// What is covered in part counts once in each layer, so that more layers would cover more of what is behind: as many layers as now shall
// cover what kTgFurLayers do with this coverage in each of them. 0 and 1 stay what they are.
static const float kTgFurLayers = 32.0;
float tgFurLayerCoverage(float coverage, float layers)
{
    return coverage < 1.0 ? 1.0 - pow(max(1.0 - coverage, 1e-7), kTgFurLayers / max(layers, 1.0)) : 1.0;
}

#endif
// SPDX-License-Identifier: MIT
