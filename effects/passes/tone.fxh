// Skin by its melanin and blood (hlsl/scatter/tone.fxh) in the place of a profile given by its numbers, and how the skin that the colour
// map shows becomes that one.
#ifndef TEGUMENT_SCATTER_TONE_FXH
#include "../../hlsl/scatter/tone.fxh"
#endif
#ifndef TEGUMENT_PASSES_TONE_FXH
#define TEGUMENT_PASSES_TONE_FXH

float gMelanin < UI_SLIDER("Melanin", 0.0, 0.32, 0.001)
    string UIHelp = "share of the epidermis, from 0.004 (very light) to 0.32; 0: skin is what gGaussianWeight and gFlesh say"; > = 0.0;
float gBlood < UI_SLIDER("Blood", 0.002, 0.05, 0.0005) string UIHelp = "share of the dermis, beside gMelanin"; > = 0.006;
float gMapMelanin < UI_SLIDER("Melanin of the colour map", 0.004, 0.32, 0.001)
    string UIHelp = "of the skin that it shows: the map's colours are multiplied by what gMelanin changes"; > = 0.014;
float gMapBlood < UI_SLIDER("Blood of the colour map", 0.002, 0.05, 0.0005) string UIHelp = "as gMapMelanin"; > = 0.006;

bool toneGiven()
{
    return gMelanin > 0.0;
}

// Of a Gaussian: weights (RGB) and variance, mm^2.
float4 profileGaussian(int gaussian)
{
    float4 given = gGaussianWeight[gaussian];
    [branch] if (toneGiven())
        given = float4(tgToneWeight(gaussian, gMelanin, gBlood) / tgToneAlbedo(gMapMelanin, gMapBlood), kTgToneVariance[gaussian]);
    return given;
}

#endif
// SPDX-License-Identifier: MIT
