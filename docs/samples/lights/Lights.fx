// An engine's own lights on every effect of this project: its file stands in effects/, beside the effect that it includes, and is compiled
// in its place. One sun, whose shadows are two cascades in one atlas, side by side.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"

float4 gSunDirection = { 0.0, 0.0, 1.0, 0.0 };  // towards it
float4 gSunColor = { 1.0, 1.0, 1.0, 0.0 };      // irradiance / pi
float4x4 gSunCascade[2];                        // world to (u, v, depth) of the atlas, row vectors
float4 gSunSplit = { 10.0, 0.001, 0.0, 0.0 };   // distance from the eye at which the second begins; bias
Texture2D gSunAtlasMap < string UIName = "Atlas"; >;
TG_SAMPLER2D(gSunAtlas, POINT, CLAMP);

TgLight tgEngineLight(int i, float3 position, TgLight ours)
{
    TgLight sun;
    sun.toLight = gSunDirection.xyz;
    sun.color = i == 0 ? gSunColor.rgb : float3(0.0, 0.0, 0.0);
    return sun;
}

float tgEngineVisibility(int i, float3 position, float3 normal, float ours)
{
    float4 near = mul(float4(position, 1.0), gSunCascade[0]);
    float4 far = mul(float4(position, 1.0), gSunCascade[1]);
    float4 place = length(position - gCameraPosition) < gSunSplit.x ? near : far;
    return place.z - gSunSplit.y <= tex2Dlod(gSunAtlas, float4(place.xy, 0.0, 0.0)).x ? 1.0 : 0.0;
}
#define TEGUMENT_PASSES_ENGINE_LIGHT_FXH
#include "Main.fx"
// SPDX-License-Identifier: MIT
