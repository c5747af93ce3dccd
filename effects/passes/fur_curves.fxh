// With TEGUMENT_FUR_CURVES=1: strands that are curves (docs/design/grooms.md). The texture of roots holds their points: of each strand as
// many, a texel each, from the root on: how far from the root, mm along the mesh's axes; radius, mm. A row of a ribbon stands at each.
#ifndef TEGUMENT_PASSES_FUR_CURVES_FXH
#define TEGUMENT_PASSES_FUR_CURVES_FXH

#if TEGUMENT_FUR_CURVES
static const float kCurveRootsOfRow = 1365.0; // of the texture
static const float kCurveRootTexels = 3.0;
static const float kCurveAside = 0.9; // of the way to the strand, how much of its part along the strand is no part of the coat's normal

// Number of the first texel of a root's curve.
float curveFirst(float address)
{
    float first = furRootsHeader(6.0).x;
    float row = floor(address / kTgRibbonColumns);
    float column = address - kTgRibbonColumns * row;
    float number = (row - floor(first / kTgRibbonColumns)) * kCurveRootsOfRow + floor(column / kCurveRootTexels + 0.1);
    float4 curves = furRootsHeader(8.0);
    return curves.x + number * curves.y;
}

float4 curveTexel(float first, float number)
{
    float texel = first + clamp(number, 0.0, furRootsHeader(8.0).y - 1.0);
    return tex2Dlod(gFurRoots, float4(tgFurTexel(texel, furRootsHeader(2.0).x), 0.0, 0.0));
}

float curvePoint(float along)
{
    return floor(along * (furRootsHeader(8.0).y - 1.0) + 0.5);
}

// perMm: world units in a mm of the roots' mesh.
RibbonPlace curvePlace(float first, float along, float perMm)
{
    float row = curvePoint(along);
    RibbonPlace place;
    place.offset = curveTexel(first, row).xyz * perMm;
    place.tangent = tgFurAlong(curveTexel(first, row + 1.0).xyz - curveTexel(first, row - 1.0).xyz);
    return place;
}

float curveRadius(float first, float along, float perMm)
{
    return curveTexel(first, curvePoint(along)).w * perMm;
}

// Of the coat where a strand runs there: from a point a thickness below its root to it, as far as that leads across the strand.
float3 curveNormal(float3 normal, float3 offset, float3 tangent, float thickness)
{
    float3 outwards = thickness * normal + offset;
    return tgFurAlong(outwards - (kCurveAside * dot(outwards, tangent)) * tangent);
}
#endif

#endif
// SPDX-License-Identifier: MIT
