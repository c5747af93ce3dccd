// Surroundings by a cube map whose levels are lobes (docs/design/light.md): how `tegument prep environment` makes it, and how it is read.
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_LIGHT_SURROUNDINGS_FXH
#define TEGUMENT_LIGHT_SURROUNDINGS_FXH

// Side of level 0 in texels; roughness (Beckmann m) from level to level; the last level with a lobe, and the first with irradiance / pi.
static const float kTgSurroundingsSide = 256.0;
static const float kTgSurroundingsStep = 0.15;
static const float kTgSurroundingsRoughest = 3.0;
static const float kTgSurroundingsDiffuse = 4.0;
// Cosine at which the surface mirrors as much as of light that comes evenly from a hemisphere: .48 to .50 for m of .1 to .5.
static const float kTgEvenCosine = 0.495;

float tgSurroundingsLevel(float roughness)
{
    return min(roughness / kTgSurroundingsStep, kTgSurroundingsRoughest);
}

// Where to read a direction at a level: the outermost texels of a face lie on its edge, so the face is shrunk by half a texel all around
// (Castano 2012, "Seamless Cube Map Filtering").
float3 tgSurroundingsDirection(float3 direction, float level)
{
    float3 a = abs(direction);
    float3 shrunk = direction * (1.0 - exp2(level) / kTgSurroundingsSide);
    float most = max(a.x, max(a.y, a.z));
    return float3(a.x < most ? shrunk.x : direction.x, a.y < most ? shrunk.y : direction.y, a.z < most ? shrunk.z : direction.z);
}

// About the vertical: what stood at azimuth 0 stands at the angle. turn: its sine and cosine.
float3 tgSurroundingsTurned(float3 direction, float2 turn)
{
    return float3(direction.x * turn.y - direction.z * turn.x, direction.y, direction.x * turn.x + direction.z * turn.y);
}

// The direction that most of the open sky lies in, for a surface whose normal the normal map has bent. open: unit; baked for meshNormal.
float3 tgSurroundingsNormal(float3 normal, float3 meshNormal, float3 open)
{
    return tgSafeNormalize(normal + open - meshNormal);
}

// Share of a mirrored lobe that is open where `open` of the hemisphere is (Lagarde and de Rousiers 2014, "Moving Frostbite to Physically
// Based Rendering", 4.10.2). cosine: N.V.
float tgSurroundingsReflectedShare(float cosine, float open, float roughness)
{
    return saturate(pow(max(saturate(cosine) + open, 1e-4), exp2(-16.0 * roughness - 1.0)) - 1.0 + open);
}

#endif
// SPDX-License-Identifier: MIT
