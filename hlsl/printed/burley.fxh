// peers/burley_weight.fxh as printed (Golubev 2018): densities without the ratio of the distances, differences of depth, whole pixels.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PEERS_BURLEY_PROFILE_FXH
#include "../peers/burley_profile.fxh"
#endif
#ifndef TEGUMENT_PRINTED_BURLEY_FXH
#define TEGUMENT_PRINTED_BURLEY_FXH

// R(apart) / density of the taps, which are drawn from R itself with the widest d: the tap lies `radius` away on the disc, and `apart` in
// space.
float3 tgBurleyWeight(float apart, float radius, float3 d, float widest)
{
    float3 ratio = tgBurleyPolar(apart, d) / max(tgBurleyPolar(radius, float3(widest, widest, widest)), 1e-30);
    return ratio;
}

float tgBurleyApart(float3 way, float3 normal, float radius)
{
    float departure = way.z;
    return sqrt(radius * radius + departure * departure);
}

float2 tgBurleyPlace(float2 at, float2 pixel)
{
    return pixel;
}

#endif
// SPDX-License-Identifier: MIT
