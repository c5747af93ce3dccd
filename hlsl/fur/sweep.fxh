// The way of a ray through the coat. From layer to layer its place over the skin (the root's side of the strands it passes) moves by the tangential part of the
// view, and its height falls:
//   h(s) = h0 - fall s + bend s^2 / 2,  s = mm along the skin, heights as shares of the coat; bend = curvature of the skin along the way / coat.
// On a curved skin a grazing ray turns before it meets the layer below and leaves the coat again.
#ifndef TEGUMENT_FUR_SWEEP_FXH
#define TEGUMENT_FUR_SWEEP_FXH

// Where the place goes while the height falls by 1: mm, tangential. view: unit, towards the skin. strand: how the coat's point moves while the height
// rises by 1, mm. A ray that rises along the skin is taken as falling with this cosine: it leaves at once by its bend.
static const float kFurLeastCosine = 0.02;
float3 furTravel(float3 view, float3 normal, float3 strand)
{
    float cosine = max(-dot(view, normal), kFurLeastCosine);
    float rise = dot(strand, normal);
    float3 along = view + normal * -dot(view, normal);
    return along * (rise / cosine) + (strand - normal * rise);
}

// Curvature of the skin, 1 / mm, along the unit tangent: how far the normal turns that way from pixel to pixel, over how far the place goes, in the direction across
// the screen in which the place goes that way fastest. Where the skin is seen at a grazing angle, which is where curvature matters, place goes almost only that way.
// Convex is positive.
float furCurvature(float3 tangent, float3 placeX, float3 placeY, float3 normalX, float3 normalY)
{
    float2 place = float2(dot(placeX, tangent), dot(placeY, tangent));
    float2 turn = float2(dot(normalX, tangent), dot(normalY, tangent));
    return dot(place, turn) / max(dot(place, place), 1e-20);
}

// mm along the skin until the height has fallen by `drop`, or, where it never does, until the ray leaves the layer again.
float furWay(float fall, float bend, float drop)
{
    float square = fall * fall - 2.0 * bend * drop;
    return square > 0.0 ? 2.0 * drop / (fall + sqrt(square)) : 2.0 * fall / max(bend, 1e-20);
}

// Height after s mm of the way.
float furFallen(float height, float fall, float bend, float s)
{
    return height - fall * s + 0.5 * bend * s * s;
}

// Every how many layers one is drawn, 1, 2, 4 ..: as rarely as keeps a segment within `most` spacings, and `fewest` layers in all; and how many its sweep spans. Where the
// normal turns from one layer to the next, they may disagree by one doubling: near that the sweep already spans twice as many, so that no layer is left out by both.
// travel: of the place from tips to skin, spacings.
float2 furStride(float layers, float travel, float most, float fewest)
{
    float spare = log2(layers / max(travel / most, fewest));
    return exp2(floor(max(float2(spare, spare + 0.25), 0.0)));
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
