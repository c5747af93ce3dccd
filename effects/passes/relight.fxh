// Light that stands still: what depends on light, pose and skin alone is drawn once, into targets that keep it (annotation Keeps).
#ifndef TEGUMENT_PASSES_RELIGHT_FXH
#define TEGUMENT_PASSES_RELIGHT_FXH

int gRelight < string UIName = "Light, pose or skin have changed"; string UIWidget = "CheckBox"; int UIMin = 0; int UIMax = 1;
    string UIHelp = "0 where they stand still: the light of the picture before serves, whatever the camera does"; > = 1;
#define LIGHT_SCRIPT(script) "LoopByCount=gRelight;" script "LoopEnd;"

#endif
// SPDX-License-Identifier: MIT
