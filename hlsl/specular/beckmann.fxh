// Beckmann's distribution as Kelemen and Szirmay-Kalos (2001) and d'Eon and Luebke (2007) use it, and its 0.1-power encoding for textures.
//   PH(c, m) = exp(-tan^2 / m^2) / (m^2 c^4), c = N.H, m = roughness (rms slope). The integral of PH c over the hemisphere is pi.
#ifndef TEGUMENT_SPECULAR_BECKMANN_FXH
#define TEGUMENT_SPECULAR_BECKMANN_FXH

// c^4 m^2 below 1e-12 would overflow the quotient before the exponential brings it to zero.
static const float kTgSmallestCosine = 1e-3;
static const float kTgSmallestRoughness = 1e-3;

float tgBeckmannPH(float cosine, float roughness)
{
    float c2 = max(cosine, kTgSmallestCosine) * max(cosine, kTgSmallestCosine);
    float m2 = max(roughness, kTgSmallestRoughness) * max(roughness, kTgSmallestRoughness);
    return exp((c2 - 1.0) / (c2 * m2)) / (m2 * c2 * c2);
}

// PH spans eight decades; its tenth root fits a texture.
float tgBeckmannEncode(float ph)
{
    return 0.5 * pow(max(ph, 1e-30), 0.1);
}

float tgBeckmannDecode(float texel)
{
    return pow(max(2.0 * texel, 0.0), 10.0);
}

#endif
// SPDX-License-Identifier: MIT
