// Weights of Burley's taps over area, on a disc that lies in the surface. Lengths in mm.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PEERS_BURLEY_PROFILE_FXH
#include "../peers/burley_profile.fxh"
#endif
#ifndef TEGUMENT_PEERS_BURLEY_WEIGHT_FXH
#define TEGUMENT_PEERS_BURLEY_WEIGHT_FXH

// R has a pole at the centre. A thousandth of a pixel of the closest portrait, mm.
static const float kTgBurleyNearest = 1e-4;

// R(apart) / density of the taps, which are drawn from R itself with the widest d: the tap lies `radius` away on the disc, and `apart` in
// space.
float3 tgBurleyWeight(float apart, float radius, float3 d, float widest)
{
    float3 ratio = tgBurleyPolar(apart, d) / max(tgBurleyPolar(radius, float3(widest, widest, widest)), 1e-30);
    return ratio * (max(radius, kTgBurleyNearest) / max(apart, kTgBurleyNearest));
}

// How far a tap lies from the centre in space, when it was drawn at `radius`: what the surface departs from its tangent plane counts
// besides; at the middle of the pixel, which is where the depth is known.
float tgBurleyApart(float3 way, float3 normal, float radius)
{
    float departure = dot(way, normal);
    return sqrt(radius * radius + departure * departure);
}

// Where a tap reads the light. pixel: middle of the pixel that it falls into.
float2 tgBurleyPlace(float2 at, float2 pixel)
{
    return at;
}

#endif
// SPDX-License-Identifier: MIT
