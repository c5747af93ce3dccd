// What lights skin besides the light of the workspace: surroundings (TEGUMENT_SURROUNDINGS) and lamps (TEGUMENT_LAMPS, lamps.fxh). Nothing
// of it is compiled where a scene has none: the macros are what other files ask. MORE_LIGHT_MEMBERS of a LitPoint; MORE_LIGHT_AT fills
// them; WITH_MORE_LIGHT(light, more); WITH_MORE_LIGHT_HERE(light, more) in the last pass, which leaves them to light_by_light.fxh where
// shader model 3 has no slots for so many.
#ifndef TEGUMENT_PASSES_MORE_LIGHT_FXH
#define TEGUMENT_PASSES_MORE_LIGHT_FXH

#if TEGUMENT_MORE_LIGHT
#define MORE_LIGHT_MEMBERS float2 uv;
#define MORE_LIGHT_AT(p, uvHere, worldHere) p.uv = uvHere;
#define WITH_MORE_LIGHT(light, more) ((light) + (more))
#else
#define MORE_LIGHT_MEMBERS
#define MORE_LIGHT_AT(p, uvHere, worldHere)
#define WITH_MORE_LIGHT(light, more) light
#endif

#if TEGUMENT_LIGHT_BY_LIGHT
#define WITH_MORE_LIGHT_HERE(light, more) light
#else
#define WITH_MORE_LIGHT_HERE(light, more) WITH_MORE_LIGHT(light, more)
#endif

#if TEGUMENT_SURROUNDINGS
Texture2D gOcclusionMap < string Generator = "occlusion"; float4 Fallback = { 0.5, 0.5, 0.5, 1.0 }; string UIName = "Occlusion map";
    string UIHelp = "from tegument prep occlusion, of this mesh"; >;
TG_SAMPLER2D(gOcclusion, LINEAR, CLAMP);

// The mean open direction, unit, and in w the share of an even sky that is open.
float4 openSky(float2 uv, float3 meshNormal, float weight)
{
    float4 texel = tex2Dlod(gOcclusion, float4(uv, 0.0, 0.0));
    float3 stored = texel.xyz * 2.0 - 1.0;
    float3 open = dot(stored, stored) > 0.25 ? tgWorldNormal(stored) : meshNormal;
    return float4(lerp(meshNormal, open, weight), lerp(1.0, texel.w, weight));
}

float gSurroundings < UI_SLIDER("Surroundings", 0.0, 4.0, 0.01) string UIHelp = "times what the cube map holds"; > = 1.0;
float gSurroundingsTurn < UI_SLIDER("Turn of the surroundings", -180.0, 180.0, 1.0)
    string UIHelp = "degrees, counter-clockwise seen from above"; > = 0.0;
float gOcclusionShare < UI_SLIDER("Occlusion of the surroundings", 0.0, 1.0, 0.01) string UIHelp = "0: all is open"; > = 1.0;
float gReflections < UI_SLIDER("Reflections of the surroundings", 0.0, 4.0, 0.01) string UIHelp = "times what energy allows"; > = 1.0;

TextureCube gEnvironmentMap < string Generator = "studio"; float4 Fallback = { 0.25, 0.25, 0.25, 1.0 }; string UIName = "Surroundings";
    string UIHelp = "from tegument prep environment"; >;
TG_SAMPLERCUBE(gEnvironment, LINEAR);

float3 surroundingsAt(float3 direction, float level)
{
    float turn = radians(gSurroundingsTurn);
    float3 turned = tgSurroundingsTurned(direction, float2(sin(turn), cos(turn)));
    return gSurroundings * texCUBElod(gEnvironment, float4(tgSurroundingsDirection(turned, level), level)).rgb;
}

// Irradiance / pi, and in w the share that is open.
float4 surroundingsLight(float2 uv, float3 normal, float3 meshNormal)
{
    float4 open = openSky(uv, meshNormal, gOcclusionShare);
    float3 towards = tgSurroundingsNormal(normal, meshNormal, open.xyz);
    return float4(open.w * surroundingsAt(towards, kTgSurroundingsDiffuse), open.w);
}
#endif

#endif
// SPDX-License-Identifier: MIT
