// The blurs of Gosselin's technique. Defaults come from the setting (hlsl/settings.fxh, docs/settings.md).
#ifndef TEGUMENT_PASSES_BLUR_PARAMETERS_FXH
#define TEGUMENT_PASSES_BLUR_PARAMETERS_FXH

float gBlurSize < string UIName = "Radius of each blur"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 20.0;
    float UIStep = 0.1; string UIHelp = "mm where the kernel size is 1; settings seed and deon2007: pairs of texels"; > = TG_SKIN_BLUR_SIZE;
float gBlurTurn < string UIName = "Turn from blur to blur"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 6.2832;
    float UIStep = 0.01; string UIHelp = "radians by which the disc is turned, so that the blurs do not repeat its pattern";
    > = TG_SKIN_BLUR_TURN;
int gBlurCount < string UIName = "Blurs"; string UIWidget = "Slider"; int UIMin = 1; int UIMax = 6; > = 3;
int gBlurIndex < string UIWidget = "None"; string UIHelp = "counted by the script"; > = -1;

#endif
