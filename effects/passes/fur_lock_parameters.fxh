// What an artist may turn on a coat of locks. Lengths are shares of the mesh's radius, of a strand, or spacings of the roots.
#ifndef TEGUMENT_PASSES_FUR_LOCK_PARAMETERS_FXH
#define TEGUMENT_PASSES_FUR_LOCK_PARAMETERS_FXH

float3 gCoatRootColor < UI_COLOUR("Colour at the root")
    string UIHelp = "albedo, linear, as all colours of the coat"; > = { 0.10, 0.068, 0.048 };
float gCoatChildren < UI_SLIDER("Strands of a lock", 1.0, 32.0, 1.0) > = 4.0;
float3 gCoatMidColor < UI_COLOUR("Colour half-way") > = { 0.36, 0.225, 0.13 };
float gCoatUnderfur < UI_SLIDER("Underfur of a lock", 0.0, 32.0, 1.0) string UIHelp = "short strands below"; > = 3.0;
float3 gCoatTipColor < UI_COLOUR("Colour of the tip") > = { 0.66, 0.47, 0.30 };
float gCoatRadius < UI_SLIDER("Radius", 0.0001, 0.01, 0.00001) string UIHelp = "of a strand, share of the mesh's radius"; > = 0.00075;
float3 gCoatUnderColor < UI_COLOUR("Colour of the underfur") > = { 0.27, 0.19, 0.13 };
float gCoatUnderLength < UI_SLIDER("Length of the underfur", 0.0, 1.0, 0.01) > = 0.55;
float3 gCoatBellyColor < UI_COLOUR("Colour below") string UIHelp = "of what looks down"; > = { 0.80, 0.70, 0.58 };
float gCoatBelly < UI_SLIDER("Pale below", 0.0, 1.0, 0.01) > = 0.8;
float3 gCoatGuardColor < UI_COLOUR("Colour of guard hairs") string UIHelp = "at their tips"; > = { 0.16, 0.105, 0.07 };
float gCoatGuard < UI_SLIDER("Guard hairs", 0.0, 1.0, 0.01)
    string UIHelp = "share of the strands that are longer, with tips of their own"; > = 0.16;
float3 gCoatShortColor < UI_COLOUR("Tint of short fur") string UIHelp = "times the others: ears, paws, noses"; > = { 0.95, 0.88, 0.82 };
float gCoatShort < UI_SLIDER("Shorter", 0.0, 1.0, 0.01) string UIHelp = "how much, on ears, paws, noses"; > = 0.55;

float gCoatSpread < UI_SLIDER("Spread of a lock", 0.0, 3.0, 0.01) string UIHelp = "of its strands' roots, spacings"; > = 0.9;
float gCoatClump < UI_SLIDER("Clump", 0.0, 1.0, 0.01) string UIHelp = "how far a lock's tips come together"; > = 0.72;
float gCoatLean < UI_SLIDER("Lie", 0.0, 1.5, 0.01) string UIHelp = "how far strands lie along the skin, lengths"; > = 1.1;
float gCoatLocks < UI_SLIDER("Unruly locks", 0.0, 2.0, 0.01) string UIHelp = "how far each goes its own way"; > = 0.5;

float gCoatWaves < UI_SLIDER("Waves of the coat", 0.0, 2.0, 0.01) string UIHelp = "how far regions go their own way"; > = 0.45;
float gCoatStray < UI_SLIDER("Stray strands", 0.0, 1.0, 0.01) > = 0.2;
float gCoatCurl < UI_SLIDER("Curl", 0.0, 1.0, 0.01) string UIHelp = "radius of a strand's turns at its tip, shares of its length"; > = 0.05;
float gCoatTurns < UI_SLIDER("Turns", 0.0, 8.0, 0.1) string UIHelp = "root to tip"; > = 1.0;

float3 gCoatWind < string UIName = "Wind";
    string UIHelp = "how far tips are blown, or left behind by a body that moves; of the world, lengths"; > = { 0.0, 0.0, 0.0 };
float gTime : TIME < string UIWidget = "None"; string UIHelp = "seconds"; > = 0.0;
float3 gCoatGusts < string UIName = "Gusts";
    string UIHelp = "share of the wind that comes and goes; in a second; in a mesh's radius"; > = { 0.5, 0.7, 0.8 };

float3 gCoatSky < UI_COLOUR("Light from above") string UIHelp = "share of the light, thrown back"; > = { 0.126, 0.156, 0.206 };
float gCoatShadow < UI_SLIDER("Shadow", 0.0, 4.0, 0.01) string UIHelp = "of strands on strands"; > = 0.9;
float3 gCoatGround < UI_COLOUR("Light from below") string UIHelp = "likewise"; > = { 0.1, 0.083, 0.07 };
float gCoatThrough < UI_SLIDER("Light through strands", 0.0, 2.0, 0.01) string UIHelp = "towards who looks against it"; > = 0.5;
float3 gCoatRim < UI_COLOUR("Rim light") string UIHelp = "likewise"; > = { 0.116, 0.131, 0.158 };
float gCoatShine < UI_SLIDER("Shine", 0.0, 1.0, 0.01) string UIHelp = "highlight of the surface of strands"; > = 0.07;
float gCoatSheen < UI_SLIDER("Sheen", 0.0, 1.0, 0.01) string UIHelp = "coloured highlight from inside strands"; > = 0.25;

float gCoatSegments < UI_SLIDER("Segments", 2.0, 15.0, 1.0) string Generator = "fur strands segments";
    string UIHelp = "of a strand, where strands are grown for the mesh; a lock's have half of them: more for curls"; > = 6.0;
float gCoatUndercoat < UI_SLIDER("Undercoat", 0.0, 1.0, 0.01)
    string UIHelp = "height of the opaque layer below, shares of the coat"; > = 0.1;
float gCoatVariation < UI_SLIDER("Variation", 0.0, 1.0, 0.01)
    string UIHelp = "of brightness, from strand to strand and lock to lock"; > = 0.4;
float gCoatPainted < UI_SLIDER("Painted", 0.0, 1.0, 0.01)
    string UIHelp = "how much of the colours that the strands bring replaces these"; > = 0.0;
float gCoatThin < UI_SLIDER("Thinnest", 0.1, 4.0, 0.01) string UIHelp = "pixels: of thinner strands fewer are drawn, wider"; > = 0.7;
float gCoatUnderThin < UI_SLIDER("Thinnest underfur", 0.1, 4.0, 0.01) string UIHelp = "the same of underfur"; > = 1.05;
float gCoatShineExponent < UI_SLIDER("Sharpness of the shine", 1.0, 500.0, 1.0) > = 60.0;
float gCoatSheenExponent < UI_SLIDER("Sharpness of the sheen", 1.0, 500.0, 1.0) > = 14.0;
float gCoatShadowStrands < UI_SLIDER("Strands that throw shadows", 1.0, 32.0, 1.0)
    string UIHelp = "of a lock: the others are part of them"; > = 2.0;
float gCoatAfar < UI_SLIDER("Afar", 0.0, 4.0, 0.01)
    string UIHelp = "pixels: where strands are drawn narrower they hide nothing, and are blended after all"; > = 1.0;
float gFurChild < string UIWidget = "None"; > = 0.0;

#endif
// SPDX-License-Identifier: MIT
