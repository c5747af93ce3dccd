// Light by light (TEGUMENT_LIGHT_BY_LIGHT): surroundings and each lamp in a pass of its own, which draws the mesh over the
// picture once more and adds what that light is worth there. Shader model 3 has no slots for all in one pass; where one pass has them, all
// of this is empty. Of a last pass PREFIX: function PREFIXShare(varying), LIGHTS(PREFIX, varying), and in its technique LIGHTS_SCRIPT and
// LIGHTS_PASSES. What of a light enters the maps is in them by their own passes.
#ifndef TEGUMENT_PASSES_LIGHT_BY_LIGHT_FXH
#define TEGUMENT_PASSES_LIGHT_BY_LIGHT_FXH

#if TEGUMENT_LIGHT_BY_LIGHT
// A point, and what the picture shows of light that falls on it: as it falls, and of what enters skin.
struct LitShare
{
    LitPoint p;
    float3 plain;
    float3 skin;
};

float3 towardsEye(LitPoint p)
{
    return tgSafeNormalize(gCameraPosition - p.world);
}

// own: the share of the light that enters at the point and leaves there; the maps bring what leaves elsewhere.
LitShare skinShare(LitPoint p, float3 own)
{
    LitShare s;
    s.p = p;
    s.plain = p.albedo * (1.0 - p.scatters);
    float3 colour = tgIrradianceColour(p.albedo, gMix) * tgIrradianceColour(p.albedo, 1.0 - gMix);
    s.skin = own * colour * (p.scatters * diffuseShare(dot(p.normal, towardsEye(p))));
    return s;
}

#if TEGUMENT_SURROUNDINGS
float4 aloneSurroundings(LitShare s)
{
    float3 light = surroundingsLight(s.p.uv, s.p.normal, s.p.meshNormal).rgb;
    return float4(light * (s.plain + s.skin * diffuseShare(kTgEvenCosine)) + surroundingsReflected(s.p, towardsEye(s.p)), 0.0);
}
#define IF_SURROUNDINGS(code) code
#else
#define IF_SURROUNDINGS(code)
#endif

#if TEGUMENT_LAMPS
float4 aloneLamp(LitShare s, int i)
{
    Lamp lamp = lampAt(i, s.p.world, lampsSeen(s.p.uv));
    float cosine = saturate(dot(s.p.normal, lamp.toLight));
    float3 light = lamp.light * cosine;
    return float4(light * (s.plain + s.skin * diffuseShare(cosine)) + lampReflected(s.p, towardsEye(s.p), lamp, i), 0.0);
}
#endif

#define ALONE_LAMP(number, i) float4 aloneLamp##number(LitShare s) { return aloneLamp(s, i); }
#if TEGUMENT_LAMPS > 0
ALONE_LAMP(1, 0)
#define IF_LAMP1(code) code
#else
#define IF_LAMP1(code)
#endif
#if TEGUMENT_LAMPS > 1
ALONE_LAMP(2, 1)
#define IF_LAMP2(code) code
#else
#define IF_LAMP2(code)
#endif
#if TEGUMENT_LAMPS > 2
ALONE_LAMP(3, 2)
#define IF_LAMP3(code) code
#else
#define IF_LAMP3(code)
#endif
#if TEGUMENT_LAMPS > 3
ALONE_LAMP(4, 3)
#define IF_LAMP4(code) code
#else
#define IF_LAMP4(code)
#endif
#if TEGUMENT_LAMPS > 4
ALONE_LAMP(5, 4)
#define IF_LAMP5(code) code
#else
#define IF_LAMP5(code)
#endif
#if TEGUMENT_LAMPS > 5
ALONE_LAMP(6, 5)
#define IF_LAMP6(code) code
#else
#define IF_LAMP6(code)
#endif
#if TEGUMENT_LAMPS > 6
ALONE_LAMP(7, 6)
#define IF_LAMP7(code) code
#else
#define IF_LAMP7(code)
#endif

#define LIGHT_ENTRY(prefix, varying, light) \
float4 prefix##light##PS(varying input) : SV_Target0 \
{ \
    return alone##light(prefix##Share(input)); \
}
#define LIGHT_SCRIPT_OF(prefix, name) "Pass=" prefix name ";"
#define LIGHT_BLURRED_SCRIPT_OF(odd, even, name) BLURRED_SCRIPT(odd name, even name)
#define LIGHT_PASS(prefix, vs, light) TG_MESH_PASS(prefix##light, vs, prefix##light##PS, TG_STATE_ADDED)

#define LIGHTS(prefix, varying) \
    IF_SURROUNDINGS(LIGHT_ENTRY(prefix, varying, Surroundings)) \
    IF_LAMP1(LIGHT_ENTRY(prefix, varying, Lamp1)) \
    IF_LAMP2(LIGHT_ENTRY(prefix, varying, Lamp2)) \
    IF_LAMP3(LIGHT_ENTRY(prefix, varying, Lamp3)) \
    IF_LAMP4(LIGHT_ENTRY(prefix, varying, Lamp4)) \
    IF_LAMP5(LIGHT_ENTRY(prefix, varying, Lamp5)) \
    IF_LAMP6(LIGHT_ENTRY(prefix, varying, Lamp6)) \
    IF_LAMP7(LIGHT_ENTRY(prefix, varying, Lamp7))
#define LIGHTS_SCRIPT(prefix) \
    IF_SURROUNDINGS(LIGHT_SCRIPT_OF(prefix, "Surroundings")) \
    IF_LAMP1(LIGHT_SCRIPT_OF(prefix, "Lamp1")) \
    IF_LAMP2(LIGHT_SCRIPT_OF(prefix, "Lamp2")) \
    IF_LAMP3(LIGHT_SCRIPT_OF(prefix, "Lamp3")) \
    IF_LAMP4(LIGHT_SCRIPT_OF(prefix, "Lamp4")) \
    IF_LAMP5(LIGHT_SCRIPT_OF(prefix, "Lamp5")) \
    IF_LAMP6(LIGHT_SCRIPT_OF(prefix, "Lamp6")) \
    IF_LAMP7(LIGHT_SCRIPT_OF(prefix, "Lamp7"))
#define LIGHTS_BLURRED_SCRIPT(odd, even) \
    IF_SURROUNDINGS(LIGHT_BLURRED_SCRIPT_OF(odd, even, "Surroundings")) \
    IF_LAMP1(LIGHT_BLURRED_SCRIPT_OF(odd, even, "Lamp1")) \
    IF_LAMP2(LIGHT_BLURRED_SCRIPT_OF(odd, even, "Lamp2")) \
    IF_LAMP3(LIGHT_BLURRED_SCRIPT_OF(odd, even, "Lamp3")) \
    IF_LAMP4(LIGHT_BLURRED_SCRIPT_OF(odd, even, "Lamp4")) \
    IF_LAMP5(LIGHT_BLURRED_SCRIPT_OF(odd, even, "Lamp5")) \
    IF_LAMP6(LIGHT_BLURRED_SCRIPT_OF(odd, even, "Lamp6")) \
    IF_LAMP7(LIGHT_BLURRED_SCRIPT_OF(odd, even, "Lamp7"))
#define LIGHTS_PASSES(prefix, vs) \
    IF_SURROUNDINGS(LIGHT_PASS(prefix, vs, Surroundings)) \
    IF_LAMP1(LIGHT_PASS(prefix, vs, Lamp1)) \
    IF_LAMP2(LIGHT_PASS(prefix, vs, Lamp2)) \
    IF_LAMP3(LIGHT_PASS(prefix, vs, Lamp3)) \
    IF_LAMP4(LIGHT_PASS(prefix, vs, Lamp4)) \
    IF_LAMP5(LIGHT_PASS(prefix, vs, Lamp5)) \
    IF_LAMP6(LIGHT_PASS(prefix, vs, Lamp6)) \
    IF_LAMP7(LIGHT_PASS(prefix, vs, Lamp7))
#else
#define LIGHTS(prefix, varying)
#define LIGHTS_SCRIPT(prefix) ""
#define LIGHTS_BLURRED_SCRIPT(odd, even) ""
#define LIGHTS_PASSES(prefix, vs)
#endif

#endif
// SPDX-License-Identifier: MIT
