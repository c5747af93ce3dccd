#ifndef FRESNEL_HLSL
#define FRESNEL_HLSL

// The share of unpolarised light that a dielectric of this index of refraction mirrors.
float fresnel(float cosine, float index)
{
    float squared = index * index - 1.0 + cosine * cosine;
    if (squared < 0.0) return 1.0; // total reflection
    float g = sqrt(squared);
    float a = (g - cosine) / (g + cosine);
    float b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Schlick 1994.
float fresnelFast(float cosine, float index)
{
    float straight = (index - 1.0) / (index + 1.0);
    return lerp(straight * straight, 1.0, pow(1.0 - cosine, 5.0));
}

#endif
