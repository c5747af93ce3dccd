// Light on strands (J. Kajiya and T. Kay, Rendering Fur with Three Dimensional Textures, 1989), normalised by energy, and the shadow of the coat on itself.
//   A cylinder whose axis t makes the angle a with the light catches sin(a) of the light's irradiance along its length and, white and dull, sends it out
//   as radiance E sin(a) / pi^2. The light's colour is E / pi here, hence sin(a) / pi. Light scattered from strand to strand adds to that.
#ifndef TEGUMENT_FUR_LIGHTING_FXH
#define TEGUMENT_FUR_LIGHTING_FXH

// Sine of the angle between unit vectors, from their cosine.
float furSine(float cosine)
{
    return sqrt(saturate(1.0 - cosine * cosine));
}

// toLight, strand: unit. multiple: 0 light scattered once, 1 as bright as a dull surface that faces the light.
float furDiffuse(float3 strand, float3 toLight, float multiple)
{
    return furSine(dot(strand, toLight)) * lerp(1.0 / kPi, 1.0, multiple);
}

// The mirror cone of the strand: cos^p of the angle between it and the direction to the eye. Its integral over all directions is bounded by
// 2 pi * integral of cos^p = 2 pi sqrt(2 pi / (p + 2/3)) (a Gaussian's width for cos^p), by which it is divided; E / pi makes that 1 / 2 sqrt(...).
float furSpecular(float3 strand, float3 toLight, float3 toEye, float exponent)
{
    float light = dot(strand, toLight);
    float eye = dot(strand, toEye);
    float cosine = saturate(furSine(light) * furSine(eye) - light * eye);
    return furSine(light) * pow(max(cosine, 1e-6), exponent) * 0.5 * sqrt((exponent + 0.6666667) / (2.0 * kPi));
}

// Share of the light that reaches this height: the way through the coat above is (1 - height) / cosine, of which the part (1 - height) sine / cosine runs
// across the strands. density: optical depth of the whole coat for light at 45 degrees. cosine: of the coat's normal and the light.
float furTransmittance(float height, float cosine, float density)
{
    float c = max(cosine, 1e-3);
    return cosine > 0.0 ? exp(-density * (1.0 - height) * furSine(c) / c) : 0.0;
}

#endif
