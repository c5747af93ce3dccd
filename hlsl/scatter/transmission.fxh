// Light through thin parts (d'Eon and Luebke 2007, "Modified translucent shadow maps"; seed equation 39). Since the profile is a sum of Gaussians,
// R(sqrt(r^2 + t^2)) = sum of w_i exp(-t^2 / (2 v_i)) G(v_i, r): the light convolved on the lit side, attenuated by thickness t, appears behind.
// Thickness travels in the alpha of the irradiance maps and is blurred with them. Units: mm, or light-depth units where kThicknessAsDepth.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_TRANSMISSION_FXH
#define TEGUMENT_SCATTER_TRANSMISSION_FXH

// exp(-50) is 2e-22. Smaller shares would only bring denormal numbers, which processors may or may not flush.
static const float kNothingPasses = 50.0;
// mm^2, a micrometre wide: an artist may turn a Gaussian off by a variance of 0, and 0 / 0 would be no number.
static const float kSmallestVariance = 1e-6;

// Depth along the light's ray turned into thickness of a flat slab: cosine correction in so far as the lit side is parallel to this one.
// cosine = N.L here; litNormal = normal where the light entered. No thickness where the light reaches the surface directly.
float transmissionThickness(float path, float cosine, float3 normal, float3 litNormal)
{
    float parallel = saturate(-dot(litNormal, normal));
    float corrected = saturate(-cosine) * path;
    return cosine > 0.0 ? kOpaqueDistance : lerp(path, corrected, parallel);
}

// What is no number, as the thickness by a normal that is none, is opaque: it must not reach the neighbours.
float transmissionEncode(float thickness)
{
    float known = thickness >= 0.0 ? thickness : kOpaqueDistance;
    return min(kThicknessAsDepth ? known : exp(-kThicknessDecay * known), kLargestAlpha);
}

// range: mm between the light's planes. Alphas below 1e-6 (69 mm) are the half's denormals.
float transmissionDecode(float alpha, float range)
{
    return kThicknessAsDepth ? alpha * range : -log(max(alpha, 1e-6)) / kThicknessDecay;
}

// Share of Gaussian `variance` that passes. apart = distance over the surface between the two points, mm: close to each other the convolution has
// already brought the light here.
float transmissionShare(float thickness, float variance, float apart)
{
    float v = max(variance, kSmallestVariance);
    float exponent = thickness * thickness * kTransmissionExponent / v;
    float passed = exponent < kNothingPasses ? exp(-exponent) : 0.0;
    return kFadeNearLitSide ? passed * saturate(apart / (6.0 * sqrt(v))) : passed;
}

// mm of surface per unit of uv, from what neighbouring pixels see.
float transmissionScale(float3 world, float2 uv)
{
    float area = length(cross(ddx(world), ddy(world)));
    float2 dx = ddx(uv);
    float2 dy = ddy(uv);
    return sqrt(area / max(abs(dx.x * dy.y - dx.y * dy.x), 1e-12));
}

#endif
