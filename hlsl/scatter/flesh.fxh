// Light through bent skin. A diffusion profile R is that of a half-space; where the surface bends flesh lies under the straight way from
// one point to another, and more light passes:  K = R(|x - x'|) (1 + c h),  h = max(0, (x - x').(n - n') / 2).  h is 0 on a plane,
// r^2 / (2 a) on a ball of radius a, the thickness through a slab. c belongs to the tissue: about 1.1 times its effective attenuation.
#ifndef TEGUMENT_SCATTER_FLESH_FXH
#define TEGUMENT_SCATTER_FLESH_FXH

// h in mm. Places in mm, unit normals.
float tgFleshUnder(float3 place, float3 normal, float3 from, float3 fromNormal)
{
    return max(0.5 * dot(place - from, normal - fromNormal), 0.0);
}

// Curvature, per mm, that two points tell of the surface between them: that of the ball on which h = r^2 / (2 a) holds.
float tgFleshCurvature(float3 place, float3 normal, float3 from, float3 fromNormal)
{
    float3 way = place - from;
    return 2.0 * tgFleshUnder(place, normal, from, fromNormal) / max(dot(way, way), 1e-6);
}

// What a Gaussian weighs more on a surface of that curvature: r^2 / 2 has the mean v under it.
float3 tgFleshShare(float3 flesh, float curvature, float variance)
{
    return 1.0 + flesh * (curvature * variance);
}

#endif
// SPDX-License-Identifier: MIT
