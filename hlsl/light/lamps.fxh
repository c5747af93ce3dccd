// Lamps beside the light of the workspace: points, spots, parallel light, with a size. Unit vectors from the surface; lengths in world
// units.
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_LIGHT_LAMPS_FXH
#define TEGUMENT_LIGHT_LAMPS_FXH

// Sine of the largest half angle that a lamp is seen under: 45 degrees.
static const float kTgLargestLamp = 0.7071;
static const float kTgSmallestLamp = 0.01;

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

// Sine of the half angle under which a lamp of this radius is seen; of parallel light the radius is that sine.
float tgLampSine(float radius, float distance, float near)
{
    return clamp(near > 0.5 ? radius / max(distance, 1e-6) : radius, kTgSmallestLamp, kTgLargestLamp);
}

// Share of a lamp that is seen through the open part of the sky, as a cap about its mean direction (Oat and Sander 2007, "Ambient Aperture
// Lighting"). Here the cap is as large as the cosine-weighted share that is open: sin^2 of its half angle. cosine: between that direction
// and the lamp's centre. All is seen while the centre is within, nothing once the cap is a lamp's width away.
float tgLampOpenShare(float cosine, float open, float sine)
{
    float a = saturate(open);
    float twice = 2.0 * sine * sqrt(1.0 - sine * sine);
    float inner = sqrt(1.0 - a);
    float outer = inner * (1.0 - 2.0 * sine * sine) - sqrt(a) * twice;
    float share = saturate((cosine - outer) / max(inner - outer, 1e-4));
    return share * share * (3.0 - 2.0 * share);
}

#endif
