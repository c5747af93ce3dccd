// Schlick's approximation (1994) of Fresnel reflectance. cosine = V.H, clamped to 0..1.
#ifndef TEGUMENT_SPECULAR_FRESNEL_FXH
#define TEGUMENT_SPECULAR_FRESNEL_FXH

float tgFresnelSchlick(float cosine, float f0)
{
    float c = 1.0 - saturate(cosine);
    float c2 = c * c;
    return f0 + (1.0 - f0) * c2 * c2 * c;
}

#endif
// SPDX-License-Identifier: MIT
