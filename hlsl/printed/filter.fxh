// shadow/filter.fxh as printed: one comparison with a constant tolerance. Depth: seed z/w; deon2007 the distance to the light in mm.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PRINTED_SEED_FXH
#include "../printed/seed.fxh"
#endif
#ifndef TEGUMENT_PRINTED_DEON2007_FXH
#include "../printed/deon2007.fxh"
#endif
#ifndef TEGUMENT_SHADOW_MAP_FXH
#include "../shadow/map.fxh"
#endif
#ifndef TEGUMENT_PRINTED_FILTER_FXH
#define TEGUMENT_PRINTED_FILTER_FXH

float tgShadowDepth(float4 lightClip, float3 toLight)
{
    float depth = kTgDepthInMillimetres ? length(toLight) : lightClip.z / max(lightClip.w, 1e-6);
    return lightClip.z > 0.0 ? depth : 0.0;
}

float2 tgShadowSlope(float3 normal, float3 axisX, float3 axisY, float3 toLight, float footprint)
{
    return float2(0.0, 0.0);
}

float tgShadowHorizon(float cosine)
{
    return 1.0;
}

// depth, tolerance: mm, or z/w.
float tgShadowTest(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth, float tolerance, float2 slope)
{
    return tgShadowLit(TG_SAMPLER2D_ARG(map), coordinate, depth - tolerance);
}

float3 tgTsmAcross(float3 axis, float3 back, float3 toLight)
{
    return axis;
}

#endif
// SPDX-License-Identifier: MIT
