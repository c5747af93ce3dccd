// Lamps beside the light of the workspace (TEGUMENT_LAMPS): what a scene says of them, and what arrives at a point.
// WITH_LAMPS(light, lamps) is the first alone where there is none.
#ifndef TEGUMENT_PASSES_LAMP_LIGHT_FXH
#define TEGUMENT_PASSES_LAMP_LIGHT_FXH

#if TEGUMENT_LAMPS
#define WITH_LAMPS(light, lamps) ((light) + (lamps))
#else
#define WITH_LAMPS(light, lamps) light
#endif

#if TEGUMENT_LAMPS
// Three, or seven where there are more: the first TEGUMENT_LAMPS are lit, of them the first TEGUMENT_LAMP_SHADOWS throw shadows. By default
// a fill from the left in front, a rim from the right behind, and one from the left behind, all parallel; the other four are dark.
#if TEGUMENT_LAMPS > 3
#define LAMP_VALUES 7
#define WITH_DARK_LAMPS(values) , values, values, values, values
#else
#define LAMP_VALUES 3
#define WITH_DARK_LAMPS(values)
#endif
#define DARK_LAMP_PLACE { 0.0, 1.0, 0.0, 0.0 }
#define DARK_LAMP_COLOR { 0.0, 0.0, 0.0, 0.0 }
#define LAMP_AXIS { 0.0, 0.0, 1.0, 0.15 }
#define LAMP_SPOT { -1.0, -2.0, 1.0, 1.0 }
float4 gLampPlace[LAMP_VALUES] < string UIName = "Lamps: place";
    string UIHelp = "w 1: a point in the world; 0: the direction that light comes from"; > = {
    { 0.85, 0.1, 0.5, 0.0 }, { -0.7, 0.45, -0.55, 0.0 }, { 0.6, 0.5, -0.65, 0.0 } WITH_DARK_LAMPS(DARK_LAMP_PLACE) };
float4 gLampColor[LAMP_VALUES] < string UIName = "Lamps: colour";
    string UIHelp = "irradiance / pi, linear; w: the distance where it is that, then inverse square; 0: everywhere"; > = {
    { 0.25, 0.27, 0.30, 0.0 }, { 0.14, 0.15, 0.16, 0.0 }, { 0.12, 0.12, 0.12, 0.0 } WITH_DARK_LAMPS(DARK_LAMP_COLOR) };
float4 gLampAxis[LAMP_VALUES] < string UIName = "Lamps: the way they shine";
    string UIHelp = "unit; w: radius; of parallel light the sine of its half angle"; > = {
    { 0.0, 0.0, -1.0, 0.25 }, LAMP_AXIS, LAMP_AXIS WITH_DARK_LAMPS(LAMP_AXIS) };
float4 gLampSpot[LAMP_VALUES] < string UIName = "Lamps: spots";
    string UIHelp = "cosines of the inner and outer half angle; weight of the shadow; of the highlight"; > = {
    LAMP_SPOT, LAMP_SPOT, LAMP_SPOT WITH_DARK_LAMPS(LAMP_SPOT) };

struct Lamp
{
    float3 toLight;
    float3 light; // E / pi on a surface that faces it, what hides it taken off
};

// seen: of each of the first three lamps the share that is seen.
Lamp lampAt(int i, float3 world, float3 seen)
{
    Lamp lamp;
    float open = i < TEGUMENT_LAMP_SHADOWS ? seen[min(i, 2)] : 1.0;
    float3 towards = tgLampVector(gLampPlace[i], world);
    float distance = length(towards);
    lamp.toLight = towards / max(distance, 1e-6);
    float share = tgLampFalloff(distance, gLampColor[i].w) * tgLampSpot(lamp.toLight, gLampAxis[i].xyz, gLampSpot[i].x, gLampSpot[i].y);
    TgLight ours;
    ours.toLight = lamp.toLight;
    ours.color = gLampColor[i].rgb;
    TgLight light = tgEngineLight(i + 1, world, ours);
    lamp.toLight = light.toLight;
    lamp.light = light.color * tgEngineVisibility(i + 1, world, float3(0.0, 0.0, 0.0), share * lerp(1.0, open, gLampSpot[i].z));
    return lamp;
}
#endif

#endif
// SPDX-License-Identifier: MIT
