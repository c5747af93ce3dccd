// Shadow map: depth of the surface nearest to the light (seed equation 7). Lit where depth - tolerance <= texel. The functions read x only,
// so a translucent shadow map serves too. filter.fxh says what a depth is, and tests it.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SHADOW_MAP_FXH
#define TEGUMENT_SHADOW_MAP_FXH

// Depth of what is not there, mm or z/w.
static const float kTgNoSurface = 1e9;
// Makes the square of one rounding step beside the map, 6e-8 of it, deeper than anything.
static const float kTgFarBeyond = 1e30;

float2 tgShadowCoordinate(float4 lightClip)
{
    return lightClip.xy / max(lightClip.w, 1e-6) * float2(0.5, -0.5) + 0.5;
}

// mm across a texel at this w of the light's clip space; spread = mm across half of the light's view for each unit of w.
float tgShadowFootprint(float w, float spread)
{
    return 2.0 * w * spread / kTgShadowSize;
}

// Maps are cleared to 0, because Direct3D 9 clears to 0..1 in 8 bits: there is no surface, and nothing lies in front of anything.
float4 tgShadowStored(float4 depth)
{
    return float4(depth.x > 0.0 ? depth.x : kTgNoSurface, depth.y > 0.0 ? depth.y : kTgNoSurface, depth.z > 0.0 ? depth.z : kTgNoSurface,
                  depth.w > 0.0 ? depth.w : kTgNoSurface);
}

// Square of the distance from the map, 0 on it. What lies outside is lit: a clamped look-up would stretch the shadow of its border texels
// over the world.
float tgShadowBeyond(float2 coordinate)
{
    float2 beyond = coordinate - saturate(coordinate);
    return dot(beyond, beyond);
}

// Lit where the nearest surface is not before this depth.
float tgShadowLit(TG_SAMPLER2D_PARAM(map), float2 coordinate, float depth)
{
    float texel = tgShadowStored(TG_TEX2DLOD(map, float4(coordinate, 0.0, 0.0))).x;
    return depth <= texel + kTgFarBeyond * tgShadowBeyond(coordinate) ? 1.0 : 0.0;
}

#endif
// SPDX-License-Identifier: MIT
