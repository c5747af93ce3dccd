// Diffuse light entering the skin (seed equation 38; d'Eon and Luebke 2007):
//   E = albedo^mix * colour * shadow * max(N.L, 0) * share,   share = what the specular layer leaves (specular/energy.fxh)
// The rest of the colour, albedo^(1 - mix), follows after diffusion: mix = 1/2 is a thin absorbing layer crossed twice.
#ifndef TEGUMENT_SCATTER_IRRADIANCE_FXH
#define TEGUMENT_SCATTER_IRRADIANCE_FXH

// Powers of zero are undefined where the exponent is zero too.
static const float kTgSmallestAlbedo = 1e-5;

float3 tgIrradianceColour(float3 albedo, float exponent)
{
    return pow(max(albedo, kTgSmallestAlbedo), exponent);
}

// What a map of light may hold: no convolution can then make an infinity of it, nor 0 times an infinity of its neighbours. What is no
// number is black. largest: of the map's format.
float3 tgIrradianceBounded(float3 light, float largest)
{
    return float3(light.r > 0.0 ? min(light.r, largest) : 0.0, light.g > 0.0 ? min(light.g, largest) : 0.0,
                  light.b > 0.0 ? min(light.b, largest) : 0.0);
}

float3 tgIrradianceEntering(float3 albedo, float mix, float3 light, float cosine, float shadow, float share)
{
    return tgIrradianceColour(albedo, mix) * light * (saturate(cosine) * shadow * share);
}

#endif
// SPDX-License-Identifier: MIT
