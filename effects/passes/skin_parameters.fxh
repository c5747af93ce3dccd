// What an artist may turn. Defaults come from the setting (hlsl/settings.fxh, docs/settings.md).
#ifndef TEGUMENT_PASSES_SKIN_PARAMETERS_FXH
#define TEGUMENT_PASSES_SKIN_PARAMETERS_FXH

float gMix < UI_SLIDER("Colour before diffusion", 0.0, 1.0, 0.01)
    string UIHelp = "exponent of the colour that light takes on entering; the rest on leaving"; > = TG_SKIN_MIX;
float gShadowTolerance < UI_SLIDER("Shadow tolerance", 0.0, 10.0, 0.001)
    string UIHelp = "mm; in setting seed a share of the light's depth range"; > = TG_SKIN_SHADOW_TOLERANCE;
float gTransmission < UI_SLIDER("Transmission", 0.0, 1.0, 0.01) string UIHelp = "weight of the light through thin parts"; > = 1.0;
int gUsePrePass < string UIName = "Cull texels that do not show"; string UIWidget = "CheckBox"; int UIMin = 0; int UIMax = 1; > = 0;

#endif
// SPDX-License-Identifier: MIT
