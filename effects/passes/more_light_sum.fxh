// Sums over what more_light.fxh declares, at a LitPoint: what falls on the surface, what of it enters skin, and what is mirrored.
#ifndef TEGUMENT_PASSES_MORE_LIGHT_SUM_FXH
#define TEGUMENT_PASSES_MORE_LIGHT_SUM_FXH

#if TEGUMENT_MORE_LIGHT
// Irradiance / pi on the surface.
float3 moreIrradiance(LitPoint p)
{
    float3 sum = 0.0;
#if TEGUMENT_SURROUNDINGS
    sum += surroundingsLight(p.uv, p.normal, p.meshNormal).rgb;
#endif
#if TEGUMENT_LAMPS
    float3 seen = lampsSeen(p.uv);
    [unroll] for (int i = 0; i < TEGUMENT_LAMPS; i++)
    {
        Lamp lamp = lampAt(i, p.world, seen);
        sum += lamp.light * saturate(dot(p.normal, lamp.toLight));
    }
#endif
    return sum;
}

// Of it what enters skin, white.
float3 moreCrossing(LitPoint p)
{
    float3 sum = 0.0;
#if TEGUMENT_SURROUNDINGS
    sum += surroundingsLight(p.uv, p.normal, p.meshNormal).rgb * diffuseShare(kTgEvenCosine);
#endif
#if TEGUMENT_LAMPS
    float3 seen = lampsSeen(p.uv);
    [unroll] for (int i = 0; i < TEGUMENT_LAMPS; i++)
    {
        Lamp lamp = lampAt(i, p.world, seen);
        float cosine = saturate(dot(p.normal, lamp.toLight));
        sum += lamp.light * (cosine * diffuseShare(cosine));
    }
#endif
    return sum;
}

float3 moreEntering(LitPoint p)
{
    return tgIrradianceColour(p.albedo, gMix) * moreCrossing(p);
}

#if TEGUMENT_SURROUNDINGS
// By a lobe of this roughness: its albedo is what diffuseShare() leaves out.
float3 mirroredSurroundings(LitPoint p, float3 toEye, float roughness, float intensity)
{
    float cosine = dot(p.normal, toEye);
    float albedo = intensity * tgEnergyAlbedo(tgHalvesSum(energyTexel(cosine, roughness)));
    float share = albedo * tgSurroundingsReflectedShare(cosine, surroundingsLight(p.uv, p.normal, p.meshNormal).w, roughness);
    return gReflections * share * surroundingsAt(reflect(-toEye, p.normal), tgSurroundingsLevel(roughness));
}
#endif

float reflectingIntensity(LitPoint p)
{
    return lerp(gPlainIntensity, TG_SKIN_INTENSITY(p), p.scatters);
}

#if TEGUMENT_SURROUNDINGS
float3 surroundingsReflected(LitPoint p, float3 toEye)
{
    float intensity = reflectingIntensity(p);
#if TEGUMENT_LOBES
    float3 lobes = specularLobes(p);
    return lerp(mirroredSurroundings(p, toEye, lobes.x, intensity), mirroredSurroundings(p, toEye, lobes.y, intensity), lobes.z);
#else
    return mirroredSurroundings(p, toEye, lerp(gPlainRoughness, gRoughness, p.scatters), intensity);
#endif
}
#endif

#if TEGUMENT_LAMPS
float3 lampReflected(LitPoint p, float3 toEye, Lamp lamp, int i)
{
    return lamp.light * (gLampSpot[i].w * surfaceSpecular(p, lamp.toLight, toEye, reflectingIntensity(p)));
}
#endif

// Mirrored towards the eye.
float3 moreReflected(LitPoint p, float3 toEye)
{
    float3 sum = 0.0;
#if TEGUMENT_SURROUNDINGS
    sum += surroundingsReflected(p, toEye);
#endif
#if TEGUMENT_LAMPS
    float3 seen = lampsSeen(p.uv);
    [unroll] for (int i = 0; i < TEGUMENT_LAMPS; i++)
        sum += lampReflected(p, toEye, lampAt(i, p.world, seen), i);
#endif
    return sum;
}
#endif

#endif
// SPDX-License-Identifier: MIT
