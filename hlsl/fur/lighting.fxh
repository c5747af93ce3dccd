// Light on strands (J. Kajiya and T. Kay, Rendering Fur with Three Dimensional Textures, 1989), normalised by energy, and the shadow of the
// coat on itself.
//   A cylinder whose axis t makes the angle a with the light catches sin(a) of the light's irradiance along its length and, white and dull,
// sends it out
//   as radiance E sin(a) / pi^2. The light's colour is E / pi here, hence sin(a) / pi. Light scattered from strand to strand adds to that.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_FUR_LIGHTING_FXH
#define TEGUMENT_FUR_LIGHTING_FXH

// Sine of the angle between unit vectors, from their cosine.
float tgFurSine(float cosine)
{
    return sqrt(saturate(1.0 - cosine * cosine));
}

// toLight, strand: unit. multiple: 0 light scattered once, 1 as bright as a dull surface that faces the light.
float tgFurDiffuse(float3 strand, float3 toLight, float multiple)
{
    return tgFurSine(dot(strand, toLight)) * lerp(1.0 / kTgPi, 1.0, multiple);
}

// The mirror cone of the strand: cos^p of the angle between it and the direction to the eye. Its integral over all directions is bounded by
// 2 pi * integral of cos^p = 2 pi sqrt(2 pi / (p + 2/3)) (a Gaussian's width for cos^p), by which it is divided; E / pi makes that 1 / 2
// sqrt(...).
float tgFurSpecular(float3 strand, float3 toLight, float3 toEye, float exponent)
{
    float light = dot(strand, toLight);
    float eye = dot(strand, toEye);
    float cosine = saturate(tgFurSine(light) * tgFurSine(eye) - light * eye);
    return tgFurSine(light) * pow(cosine, exponent) * 0.5 * sqrt((exponent + 0.6666667) / (2.0 * kTgPi));
}

// Way of the light through a coat to this height, in its thicknesses. The coat is that of a ball of radius 1, `thickness` thick. The way
// out of a ball of radius 1 + thickness from the radius b = 1 + height * thickness, against the light, is sqrt((1 + thickness)^2 - b^2
// sine^2) - b cosine. Flat (thickness 0) that is (1 - height) / cosine; on the ball nothing jumps where light grazes, and tips beyond the
// horizon still see it. cosine: of the coat's normal and the light.
float tgFurWay(float height, float cosine, float thickness)
{
    float k = max(thickness, 1e-3);
    float b = 1.0 + height * k;
    float above = (1.0 - height) * (2.0 + k + height * k); // ((1 + k)^2 - b^2) / k
    float across = sqrt(abs(b * b * cosine * cosine + k * above)); // below 0 by a rounding where a height at a centroid is beyond 1
    // The two forms are equal; each is exact where the other cancels.
    return cosine > 0.0 ? above / max(across + b * cosine, 1e-6) : (across - b * cosine) / k;
}

// Share of the light that reaches this height; of its way the part `sine` runs across the strands. density: optical depth of a flat coat
// for light at 45 degrees.
float tgFurTransmittance(float height, float cosine, float density, float thickness)
{
    return exp(-density * tgFurWay(height, cosine, thickness) * tgFurSine(cosine));
}

// What light from all sides, of this colour, leaves of white at this height: one half of the directions, through the coat above as for
// light at 45 degrees. multiple as for tgFurDiffuse: light scattered once, a cylinder that sees half of a bright sphere; or as bright as a
// dull surface.
float tgFurFill(float height, float density, float multiple)
{
    return exp(-density * (1.0 - height)) * lerp(0.5, 1.0, multiple);
}

// How much of the coat of other parts light has passed before it comes to a point, in thicknesses of the coat. It has entered the nearest
// coat at `front` and come out of it at `back`, distances from the light as all of these. Before the back the point is in that coat itself:
// what goes beyond its own way (tgFurWay) is due to others that touch it, but for a margin, since surfaces are not balls. The change from
// one case to the other takes a quarter of a thickness.
static const float2 kTgFurOwn = float2(1.25, 0.25);
float tgFurForeignCoat(float place, float front, float back, float own, float thickness)
{
    float coat = max(thickness, 1e-6);
    float inside = (place - front) / coat - kTgFurOwn.x * own - kTgFurOwn.y;
    return max(lerp(inside, (back - front) / coat, saturate(4.0 * (place - back) / coat)), 0.0);
}

#endif
// SPDX-License-Identifier: MIT
