// What an artist may turn on strands that grow on the surface. Lengths are shares of the mesh's radius, or spacings of the strands.
#ifndef TEGUMENT_PASSES_FUR_ROOTS_PARAMETERS_FXH
#define TEGUMENT_PASSES_FUR_ROOTS_PARAMETERS_FXH

float gCameraFov : FIELDOFVIEW < string UIWidget = "None"; string UIHelp = "horizontal, radians"; >;
float gFurSpacing < UI_SLIDER("Spacing", 0.001, 0.05, 0.0001) string UIHelp = "of strands, share of the mesh's radius"; > = 0.008;
float gFurRadius < UI_SLIDER("Radius", 0.02, 0.5, 0.01) string UIHelp = "of a strand at its root, spacings"; > = 0.3;
float gFurShortest < UI_SLIDER("Shortest", 0.05, 1.0, 0.01) string UIHelp = "length of the shortest strand, share of the longest"; > = 0.55;

float gFurScatter < UI_SLIDER("Scatter", 0.0, 1.0, 0.01) string UIHelp = "how far tips stray each by itself, spacings"; > = 0.4;
float gFurTufts < UI_SLIDER("Tufts", 0.0, 4.0, 0.01) string UIHelp = "how far tips stray together, spacings"; > = 1.5;
float gFurTuftSize < UI_SLIDER("Size of tufts", 1.0, 20.0, 0.1) string UIHelp = "spacings"; > = 4.0;
float gFurVariation < UI_SLIDER("Variation of colour", 0.0, 1.0, 0.01) > = 0.4;

float gFurCurls < UI_SLIDER("Curl", 0.0, 0.5, 0.01) string UIHelp = "radius of a strand's turns at its tip, spacings"; > = 0.15;
float gFurTurns < UI_SLIDER("Turns", 0.0, 4.0, 0.1) string UIHelp = "of a strand, root to tip"; > = 1.0;
float gFurSegment < UI_SLIDER("Segment", 0.5, 16.0, 0.1)
    string UIHelp = "what a layer sweeps before another layer is drawn, spacings"; > = 3.0;
float gFurFewest < UI_SLIDER("Fewest layers", 1.0, 64.0, 1.0) string UIHelp = "drawn whatever the view"; > = 4.0;

#endif
// SPDX-License-Identifier: MIT
