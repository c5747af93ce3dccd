// Scattering at the edges of shadows without a blur (Penner and Borshukov 2011, "Shadow scattering"): a shadow is filtered so wide that the
// share of light says how far the edge is, and the profile's own response to an edge takes the filter's place.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SHADOW_MAP_FXH
#include "../shadow/map.fxh"
#endif
#ifndef TEGUMENT_PEERS_PENUMBRA_FXH
#define TEGUMENT_PEERS_PENUMBRA_FXH

static const int kTgPenumbraTaps = 32;

// Tap i on a disc of radius 1: uniform over a half sphere, seen from above. Bands of equal width of a sphere have equal area (Archimedes),
// so as an edge moves over the disc the share of taps beyond it changes evenly. The golden angle from tap to tap; turn 0..1.
float2 tgPenumbraTap(float i, float turn)
{
    float height = 1.0 - (i + 0.5) / kTgPenumbraTaps;
    float angle = 2.39996323 * i + 2.0 * kTgPi * turn;
    return sqrt(max(1.0 - height * height, 0.0)) * float2(cos(angle), sin(angle));
}

// A way along the surface (mm) as the shadow map has it: change of its uv, and of depth. texel: its footprint.
float3 tgPenumbraAxis(float3 way, float3 axisX, float3 axisY, float3 toLight, float texel)
{
    return float3(float2(dot(way, axisX), -dot(way, axisY)) / (texel * kTgShadowSize), -dot(way, toLight));
}

// Share of light over the disc in the surface whose radii are axisU and axisV, as the map has them. depth: less tolerance. rise: by how
// much the surface may stand out at the rim without shadowing the centre, less nearer to it: else every hollow would shadow itself.
float tgPenumbraShare(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float3 axisU, float3 axisV, float rise, float turn)
{
    float sum = 0.0;
    [loop] for (int i = 0; i < kTgPenumbraTaps; i++)
    {
        float2 tap = tgPenumbraTap(i, turn);
        float3 offset = tap.x * axisU + tap.y * axisV;
        sum += tgShadowLit(TG_SAMPLER2D_ARG(map), coordinate + offset.xy, depth + offset.z - rise * length(tap));
    }
    return sum / kTgPenumbraTaps;
}

// Edge of one Gaussian, 1/2 (1 + erf(t / sqrt 2)), t = x / sigma, by Abramowitz and Stegun 7.1.26: off by 8e-8 at most.
float tgPenumbraEdge(float t)
{
    float x = abs(t) * 0.70710678;
    float k = 1.0 / (1.0 + 0.3275911 * x);
    float tail = k * (0.254829592 + k * (-0.284496736 + k * (1.421413741 + k * (-1.453152027 + k * 1.061405429)))) * exp(-x * x);
    return t > 0.0 ? 1.0 - 0.5 * tail : 0.5 * tail;
}

// Shadow of each colour. Wide Gaussians (4 to 6) respond to the edge at distance x that the filtered share tells, scaled so that the ends
// of the filter's reach are light and shadow; narrow ones, narrower than the filter's noise, to the sharp shadow.
float3 tgPenumbraShadow(float4 gaussians[6], float sharp, float share, float radius)
{
    float x = (2.0 * share - 1.0) * radius;
    float3 sum = float3(0.0, 0.0, 0.0);
    [unroll] for (int i = 0; i < 3; i++)
        sum += gaussians[i].rgb * sharp;
    [unroll] for (int j = 3; j < 6; j++)
    {
        float width = rsqrt(max(gaussians[j].w, 1e-6));
        float beyond = tgPenumbraEdge(-radius * width);
        sum += gaussians[j].rgb * saturate((tgPenumbraEdge(x * width) - beyond) / (1.0 - 2.0 * beyond));
    }
    return sum;
}

#endif
// SPDX-License-Identifier: MIT
