// Lamps beside the light of the workspace: points, spots, parallel light, with a size. Unit vectors from the surface; lengths in world
// units.
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_LIGHT_LAMPS_FXH
#define TEGUMENT_LIGHT_LAMPS_FXH

// place: a point with w = 1; w = 0: the direction that parallel light comes from, of any length but 0.
float3 tgLampVector(float4 place, float3 world)
{
    return place.w > 0.5 ? place.xyz - world : place.xyz;
}

// Of light whose colour holds at the distance `reference`: inverse square; 0: the same everywhere.
float tgLampFalloff(float distance, float reference)
{
    float ratio = reference / max(distance, 1e-6);
    return reference > 0.0 ? ratio * ratio : 1.0;
}

// Share of a spot's light that goes towards the surface: 1 within the inner cosine, 0 outside of the outer one. axis: the way that it
// shines. Every point is within an outer cosine of -2 and an inner one of -1.
float tgLampSpot(float3 toLight, float3 axis, float inner, float outer)
{
    float share = saturate((dot(-toLight, axis) - outer) / max(inner - outer, 1e-4));
    return share * share * (3.0 - 2.0 * share);
}

// What a lamp sees of a body: a square that is fitted to its bounding sphere. A point looks at the sphere's centre; parallel light is seen
// from two radii before it.
struct TgLampView
{
    float3 eye;
    float3 axis; // where it looks, unit
    float3 right;
    float3 up;
    float spread; // half of the view's width for each unit of w
    float near;   // the planes, along the axis
    float far;
    bool parallel;
};

// Tangent of the half angle that a lamp beside or within the sphere looks through: 63 degrees. What it does not see is lit.
static const float kTgWidestLamp = 2.0;
// Nearest plane of a lamp within the sphere, in radii.
static const float kTgNearestLamp = 0.02;

// Where a lamp looks, unit.
float3 tgLampAxis(float4 place, float3 centre)
{
    return -tgSafeNormalize(tgLampVector(place, centre));
}

// up: the view's own is near to it, or to `instead` where the axis is; unit vectors that turn with the body, so that the map does.
TgLampView tgLampView(float4 place, float3 centre, float radius, float3 up, float3 instead)
{
    TgLampView view;
    view.parallel = place.w <= 0.5;
    float away = view.parallel ? 2.0 * radius : length(place.xyz - centre);
    view.axis = tgLampAxis(place, centre);
    view.eye = view.parallel ? centre - away * view.axis : place.xyz;
    view.right = tgSafeNormalize(cross(view.axis, abs(dot(view.axis, up)) < 0.9 ? up : instead));
    view.up = cross(view.right, view.axis);
    float tangent = radius * rsqrt(max(away * away - radius * radius, radius * radius / (kTgWidestLamp * kTgWidestLamp)));
    view.spread = view.parallel ? radius : tangent;
    view.near = max(away - radius, kTgNearestLamp * radius);
    view.far = away + radius;
    return view;
}

// Along the axis.
float tgLampDepth(TgLampView view, float3 world)
{
    return dot(world - view.eye, view.axis);
}

// Clip space of the view: z from 0 to w between the planes.
float4 tgLampClip(TgLampView view, float3 world)
{
    float3 from = world - view.eye;
    float depth = dot(from, view.axis);
    float w = view.parallel ? 1.0 : depth;
    float z = (depth - view.near) / (view.far - view.near) * (view.parallel ? 1.0 : view.far);
    return float4(dot(from, view.right) / view.spread, dot(from, view.up) / view.spread, z, w);
}

#endif
// SPDX-License-Identifier: MIT
