// What an artist may turn on strands that grow on the surface. Lengths are shares of the mesh's radius, or spacings of the strands.
#ifndef TEGUMENT_PASSES_FUR_ROOTS_PARAMETERS_FXH
#define TEGUMENT_PASSES_FUR_ROOTS_PARAMETERS_FXH

float gCameraFov : FIELDOFVIEW < string UIWidget = "None"; string UIHelp = "horizontal, radians"; >;
float gFurSpacing < string UIName = "Spacing"; string UIWidget = "Slider"; float UIMin = 0.001; float UIMax = 0.05; float UIStep = 0.0001;
    string UIHelp = "of strands, share of the mesh's radius"; > = 0.008;
float gFurRadius < string UIName = "Radius"; string UIWidget = "Slider"; float UIMin = 0.02; float UIMax = 0.5; float UIStep = 0.01;
    string UIHelp = "of a strand at its root, spacings"; > = 0.3;
float gFurShortest < string UIName = "Shortest"; string UIWidget = "Slider"; float UIMin = 0.05; float UIMax = 1.0; float UIStep = 0.01;
    string UIHelp = "length of the shortest strand, share of the longest"; > = 0.55;

float gFurScatter < string UIName = "Scatter"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0; float UIStep = 0.01;
    string UIHelp = "how far tips stray each by itself, spacings"; > = 0.4;
float gFurTufts < string UIName = "Tufts"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 4.0; float UIStep = 0.01;
    string UIHelp = "how far tips stray together, spacings"; > = 1.5;
float gFurTuftSize < string UIName = "Size of tufts"; string UIWidget = "Slider"; float UIMin = 1.0; float UIMax = 20.0;
    float UIStep = 0.1; string UIHelp = "spacings"; > = 4.0;
float gFurVariation < string UIName = "Variation of colour"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0;
    float UIStep = 0.01; > = 0.4;

float gFurCurls < string UIName = "Curl"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 0.5; float UIStep = 0.01;
    string UIHelp = "radius of a strand's turns at its tip, spacings"; > = 0.15;
float gFurTurns < string UIName = "Turns"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 4.0; float UIStep = 0.1;
    string UIHelp = "of a strand, root to tip"; > = 1.0;
float gFurSegment < string UIName = "Segment"; string UIWidget = "Slider"; float UIMin = 0.5; float UIMax = 16.0; float UIStep = 0.1;
    string UIHelp = "what a layer sweeps before another layer is drawn, spacings"; > = 3.0;
float gFurFewest < string UIName = "Fewest layers"; string UIWidget = "Slider"; float UIMin = 1.0; float UIMax = 64.0; float UIStep = 1.0;
    string UIHelp = "drawn whatever the view"; > = 4.0;

#endif
