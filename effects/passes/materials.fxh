// The maps of the material. gSkinMap: sRGB; alpha 1 skin, 0 plain material (eyeballs), which neither scatters nor receives scattered light.
#ifndef TEGUMENT_PASSES_MATERIALS_FXH
#define TEGUMENT_PASSES_MATERIALS_FXH

Texture2D gSkinMap : DIFFUSE < string ColorSpace = "sRGB"; float4 Fallback = { 0.8, 0.6, 0.5, 1.0 }; string UIName = "Colour map"; >;
TG_SAMPLER2D_SRGB(gSkin, LINEAR, WRAP);

#endif
// SPDX-License-Identifier: MIT
