// Burley's normalised diffusion gathered over a disc of the picture (Golubev, Efficient screen-space subsurface scattering using Burley's
// normalized diffusion in real-time, 2018; Christensen and Burley, Approximate reflectance profiles for efficient subsurface scattering,
// 2015).
//   R(r) = (exp(-r / d) + exp(-r / 3d)) / (8 pi d r),   share of light within r: 1 - exp(-r / d) / 4 - 3 exp(-r / 3d) / 4
// d, r in mm; one d for each colour.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PEERS_SCREEN_FXH
#include "../peers/screen.fxh"
#endif
#ifndef TEGUMENT_PEERS_BURLEY_PROFILE_FXH
#include "../peers/burley_profile.fxh"
#endif
#ifndef TEGUMENT_PEERS_BURLEY_WEIGHT_FXH
#include "../peers/burley_weight.fxh"
#endif
#ifndef TEGUMENT_PRINTED_BURLEY_FXH
#include "../printed/burley.fxh"
#endif
#ifndef TEGUMENT_PEERS_BURLEY_FXH
#define TEGUMENT_PEERS_BURLEY_FXH

// pi (3 - sqrt 5).
static const float kTgGoldenAngle = 2.39996323;

// Direction of tap i: the golden angle from tap to tap, turned from pixel to pixel.
float2 tgBurleyDirection(float i, float turn)
{
    float angle = kTgGoldenAngle * i + 2.0 * kTgPi * turn;
    return float2(cos(angle), sin(angle));
}

// Middle of the pixel that uv falls into.
float2 tgBurleyPixel(float2 uv, float2 viewport)
{
    return (floor(uv * viewport) + 0.5) / viewport;
}

// light: RGB times coverage, and coverage. Axes of the disc: unit vectors in view space. turning: 1 turns the pattern from pixel to pixel.
// The taps' light over the sum of their weights, of each colour.
float4 tgBurleyGather(TG_SAMPLER2D_PARAM(light), TG_SAMPLER2D_PARAM(depth), float2 uv, float2 viewport, float2 frustum, float3 axisU,
    float3 axisV, float3 d,
                    float turning, int count)
{
    float z = TG_TEX2DLOD(depth, float4(uv, 0.0, 0.0)).x;
    float3 here = tgScreenPosition(uv, z, frustum);
    float3 normal = cross(axisU, axisV);
    float widest = max(d.x, max(d.y, d.z));
    float turn = turning * tgScreenNoise(floor(uv * viewport));
    float3 sum = float3(0.0, 0.0, 0.0);
    float3 total = float3(0.0, 0.0, 0.0);
    [loop] for (int i = 0; i < count; i++)
    {
        float radius = widest * tgBurleyRadius((i + 0.5) / count);
        float2 direction = tgBurleyDirection(i, turn);
        float2 at = tgScreenCoordinate(here + radius * (direction.x * axisU + direction.y * axisV), frustum);
        float2 pixel = tgBurleyPixel(at, viewport);
        float there = TG_TEX2DLOD(depth, float4(pixel, 0.0, 0.0)).x;
        float4 tap = TG_TEX2DLOD(light, float4(tgBurleyPlace(at, pixel), 0.0, 0.0));
        float apart = tgBurleyApart(tgScreenPosition(pixel, there, frustum) - here, normal, radius);
        float3 weight = there > 0.0 ? tgBurleyWeight(apart, radius, d, widest) : float3(0.0, 0.0, 0.0);
        sum += weight * tap.rgb;
        total += weight * tap.a;
    }
    float4 centre = TG_TEX2DLOD(light, float4(uv, 0.0, 0.0));
    return z > 0.0 ? float4(total.z > 1e-6 ? sum / max(total, 1e-6) : centre.rgb, 1.0) : float4(0.0, 0.0, 0.0, 0.0);
}

#endif
// SPDX-License-Identifier: MIT
