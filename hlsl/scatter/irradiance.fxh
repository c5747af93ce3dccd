// Diffuse light entering the skin (seed equation 38; d'Eon and Luebke 2007):
//   E = albedo^mix * colour * shadow * max(N.L, 0) * share,   share = what the specular layer leaves (specular/energy.fxh)
// The rest of the colour, albedo^(1 - mix), follows after diffusion: mix = 1/2 is a thin absorbing layer crossed twice.
#ifndef TEGUMENT_SCATTER_IRRADIANCE_FXH
#define TEGUMENT_SCATTER_IRRADIANCE_FXH

// Powers of zero are undefined where the exponent is zero too.
static const float kSmallestAlbedo = 1e-5;

float3 irradianceColour(float3 albedo, float exponent)
{
    return pow(max(albedo, kSmallestAlbedo), exponent);
}

float3 irradianceEntering(float3 albedo, float mix, float3 light, float cosine, float shadow, float share)
{
    return irradianceColour(albedo, mix) * light * (saturate(cosine) * shadow * share);
}

#endif
