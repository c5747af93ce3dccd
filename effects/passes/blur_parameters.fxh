// The blurs of Gosselin's technique. Defaults come from the setting (hlsl/settings.fxh, docs/settings.md).
#ifndef TEGUMENT_PASSES_BLUR_PARAMETERS_FXH
#define TEGUMENT_PASSES_BLUR_PARAMETERS_FXH

float gBlurSize < UI_SLIDER("Radius of each blur", 0.0, 20.0, 0.1)
    string UIHelp = "mm where the kernel size is 1; as printed: pairs of texels"; > = TG_SKIN_BLUR_SIZE;
float gBlurTurn < UI_SLIDER("Turn from blur to blur", 0.0, 6.2832, 0.01)
    string UIHelp = "radians by which the disc is turned, so that the blurs do not repeat its pattern"; > = TG_SKIN_BLUR_TURN;
int gBlurCount < string UIName = "Blurs"; string UIWidget = "Slider"; int UIMin = 1; int UIMax = 6; > = 3;
int gBlurIndex < string UIWidget = "None"; string UIHelp = "counted by the script"; > = -1;

#endif
// SPDX-License-Identifier: MIT
