// Light that crosses the surface.
#ifndef TEGUMENT_PASSES_ENERGY_SHARE_FXH
#define TEGUMENT_PASSES_ENERGY_SHARE_FXH

float3 ownEntering(LitPoint p)
{
    return tgIrradianceEntering(p.albedo, gMix, p.light, p.cosine, p.shadow, diffuseShare(p.cosine));
}

float3 enteringLight(LitPoint p)
{
    return WITH_MORE_LIGHT(ownEntering(p), moreEntering(p));
}

// Of what the last pass lights itself, here and below.
float3 enteringHere(LitPoint p)
{
    return WITH_MORE_LIGHT_HERE(ownEntering(p), moreEntering(p));
}

// Of plain material, which does not scatter.
float3 plainLight(LitPoint p)
{
    return WITH_MORE_LIGHT_HERE(p.albedo * p.light * (saturate(p.cosine) * p.shadow), p.albedo * moreIrradiance(p));
}

float3 mirroredLight(LitPoint p, float3 toEye)
{
    return WITH_MORE_LIGHT_HERE(reflectedLight(p, toEye), moreReflected(p, toEye));
}

#endif
// SPDX-License-Identifier: MIT
