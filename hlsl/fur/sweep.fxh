// The way of a ray through the coat. As it falls, its place over the skin (where the strands that it passes have their roots) moves along:
// a curve in (place, height), followed from layer to layer.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_FUR_SWEEP_FXH
#define TEGUMENT_FUR_SWEEP_FXH

// Unit vector along v, for vectors that are no shorter than 1e-6, zero of zero: a slot of shader model 3 less than tgSafeNormalize.
float3 tgFurAlong(float3 v)
{
    return v * rsqrt(dot(v, v) + 1e-20);
}

// How a ray goes on from a layer. After the height s by which a flat skin would have made it fall, its place has moved by travel s, and its
// normal has turned by turn s. All lengths in spacings of the strands.
struct TgFurPath
{
    float3 travel;
    float3 turn;
    float bow; // the height has fallen by s - bow s^2 / 2: on a ball the ray flattens as it goes, and rises again
};

// What changes from pixel to pixel of a layer, along x and y.
struct TgFurSlopes
{
    float3 across; // of the coat's point
    float3 down;
    float3 placeAcross; // of the skin below it
    float3 placeDown;
    float3 normalAcross;
    float3 normalDown;
};

// The layer is a triangle here, on which place and normal change evenly: the ray's way along it, in pixels, gives both. Its own plane
// counts, not the interpolated normal, for it is on the next layer's plane that the ray will be found. view: unit, towards the skin.
// strand: how the coat's point moves while the height rises by 1, in coats; coat: the length of one. least: square of the cosine at which
// rays go on for longest; those along the plane must not for ever.
TgFurPath tgFurPath(float3 view, float3 strand, float coat, float least, TgFurSlopes slopes)
{
    float3 plane = cross(slopes.across, slopes.down);
    float square = dot(plane, plane) + 1e-20; // where nothing changes
    float fall = dot(view, plane);
    float way = -dot(strand, plane) * fall / (fall * fall + least * square);
    float3 along = strand + view * way;
    float2 pixels = float2(dot(cross(along, slopes.down), plane), dot(cross(slopes.across, along), plane)) * (coat / square);
    TgFurPath path;
    path.travel = slopes.placeAcross * pixels.x + slopes.placeDown * pixels.y;
    path.turn = slopes.normalAcross * pixels.x + slopes.normalDown * pixels.y;
    path.bow = dot(view, path.turn) * way;
    return path;
}

static const float kTgFurStraight = 1e-3; // least bow: rays are taken as straight over hollow skin

// s at which the height has fallen by `depth`; where it never does, s where it is back at the layer.
float tgFurFall(float bow, float depth)
{
    float bowed = max(bow, kTgFurStraight);
    float root = 1.0 - 2.0 * bowed * depth;
    return 2.0 * (root > 0.0 ? depth / (1.0 + sqrt(root)) : 1.0 / bowed);
}

// How far the height has fallen at s. Behind the deepest point it stays there: the ray rises again past strands that it meets higher up,
// which layers this thin may neglect.
float tgFurFallen(float bow, float s)
{
    float bowed = max(bow, kTgFurStraight);
    float falling = min(s, 1.0 / bowed);
    return falling - 0.5 * bowed * falling * falling;
}

// How often the layers could be halved, logarithm to the base 2, until a segment is as long as `most` or `fewest` are left. travel: of the
// place from tips to skin, spacings.
float tgFurSpare(float layers, float travel, float most, float fewest)
{
    return log2(max(layers, 1.0) / max(travel / max(most, 1e-3), max(fewest, 1.0)));
}

// Every how many layers one is drawn: 1, 2, 4 .. The margin keeps whole numbers, where `fewest` puts most of a picture, from falling to
// either side.
static const float kTgFurMargin = 0.02;
float tgFurStride(float spare)
{
    return exp2(floor(max(spare + kTgFurMargin, 0.0)));
}

// Mean radius, share of the base radius, of strands at these heights (0 to 1), if their lengths lie evenly between `shortest` (below 1) and
// 1: the mean of max(1 - h / L, 0).
float2 tgFurMeanRadius(float2 heights, float shortest)
{
    float2 least = max(heights, shortest);
    return saturate((1.0 - least + heights * log(least)) / (1.0 - shortest));
}

// Coverage to expect along a segment where strands are too thin to tell: random strands, `density` of them per area, sweep 2 r per length
// of way, and seen from above cover what their sections grow by. radius: mean, at the begin and the end of the segment, where it is no
// less.
float tgFurExpected(float density, float2 radius, float way)
{
    float swept = (radius.x + radius.y) * way + kTgPi * (radius.y * radius.y - radius.x * radius.x);
    return 1.0 - exp(-density * swept);
}

#endif
// SPDX-License-Identifier: MIT
