// Light that crosses the surface.
#ifndef TEGUMENT_PASSES_ENERGY_SHARE_FXH
#define TEGUMENT_PASSES_ENERGY_SHARE_FXH

float3 enteringLight(LitPoint p)
{
    return WITH_MORE_LIGHT(tgIrradianceEntering(p.albedo, gMix, gLightColor, p.cosine, p.shadow, diffuseShare(p.cosine)),
                           moreEntering(p));
}

// Of plain material, which does not scatter.
float3 plainLight(LitPoint p)
{
    return WITH_MORE_LIGHT(p.albedo * gLightColor * (saturate(p.cosine) * p.shadow), p.albedo * moreIrradiance(p));
}

float3 mirroredLight(LitPoint p, float3 toEye)
{
    return WITH_MORE_LIGHT(reflectedLight(p, toEye), moreReflected(p, toEye));
}

#endif
