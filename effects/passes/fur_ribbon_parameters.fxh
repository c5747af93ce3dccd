// What an artist may turn on strands that are ribbons.
#ifndef TEGUMENT_PASSES_FUR_RIBBON_PARAMETERS_FXH
#define TEGUMENT_PASSES_FUR_RIBBON_PARAMETERS_FXH

float gFurCut < UI_SLIDER("Cut", 0.05, 0.95, 0.01)
    string UIHelp = "coverage from which a strand hides what is behind it; what has less is drawn after all strands"; > = 0.4;
float gFurShare < UI_SLIDER("Share of the strands", 0.05, 1.0, 0.01)
    string UIHelp = "that are drawn, as much wider: for far away"; > = 1.0;
float gFurEdge < UI_SLIDER("Soft edge", 0.1, 0.5, 0.01)
    string UIHelp = "pixels that a ribbon is wider than its strand on each side; 0.5: all that is covered"; > = 0.5;
float gRibbonSegment < UI_SLIDER("Pixels of a segment", 0.0, 64.0, 0.5)
    string UIHelp = "strands that are shorter have fewer segments, so that these are as long"; > = 4.2;
float gRibbonFewest < UI_SLIDER("Fewest strands", 0.0, 1.0, 0.01)
    string UIHelp = "share that distance leaves where thin strands are drawn fewer and wider"; > = 0.33;
float gCoatSegment < UI_SLIDER("Pixels of a coat's segment", 0.0, 64.0, 0.5)
    string UIHelp = "the same of locks and their underfur"; > = 16.0;
float gRibbonThin < UI_SLIDER("Thin", 0.0, 4.0, 0.01)
    string UIHelp = "pixels: where a strand is narrower it hides nothing, and is blended after all strands"; > = 0.7;

#endif
// SPDX-License-Identifier: MIT
