// The way of a ray through the coat. From layer to layer its place over the skin (where the strands that it passes have their roots) moves by the tangential part of
// the view while its height falls: a straight line in (place, height), for the skin is taken as flat between two layers.
#ifndef TEGUMENT_FUR_SWEEP_FXH
#define TEGUMENT_FUR_SWEEP_FXH

// Where the place goes while the height falls by 1: mm, tangential. view: unit, towards the skin. strand: how the coat's point moves while the height
// rises by 1, mm. Rays that rise along the skin, which interpolated normals bring about at silhouettes, are taken as falling with this cosine.
static const float kFurLeastCosine = 0.02;
float3 furTravel(float3 view, float3 normal, float3 strand)
{
    float cosine = max(-dot(view, normal), kFurLeastCosine);
    float rise = dot(strand, normal);
    float3 along = view + normal * -dot(view, normal);
    return along * (rise / cosine) + (strand - normal * rise);
}

// Every how many layers one is drawn, 1, 2, 4 ..: as rarely as keeps a segment within `most` spacings, and `fewest` layers in all; and how many its sweep spans. Where the
// normal turns from one layer to the next, they may disagree by one doubling: near that the sweep already spans twice as many, so that no layer is left out by both.
// In that zone what a strand covers in part counts twice, so it is narrow. It begins above whole numbers, where `fewest` puts most of a picture.
// travel: of the place from tips to skin, spacings.
static const float2 kFurZone = float2(0.02, 0.1); // doublings
float2 furStride(float layers, float travel, float most, float fewest)
{
    float spare = log2(layers / max(travel / most, fewest));
    return exp2(floor(max(spare + kFurZone, 0.0)));
}

// Mean radius, share of the base radius, of strands at these heights, if their lengths lie evenly between `shortest` and 1: the mean of max(1 - h / L, 0).
float3 furMeanRadius(float3 heights, float shortest)
{
    float3 least = clamp(heights, min(shortest, 0.999), 1.0);
    return saturate((1.0 - least + heights * log(least)) / max(1.0 - shortest, 1e-3));
}

// Coverage to expect along a segment where strands are too thin to tell: random strands, `density` of them per area, sweep 2 r per length of way, and seen from
// above cover what their sections grow by. radius: mean, at the begin, the middle and the end of the segment (Simpson's rule).
float furExpected(float density, float3 radius, float way)
{
    float swept = dot(radius, float3(1.0, 4.0, 1.0)) / 3.0 * way + kPi * max(radius.z * radius.z - radius.x * radius.x, 0.0);
    return 1.0 - exp(-density * swept);
}

#endif
