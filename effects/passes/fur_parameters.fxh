// What an artist may turn on fur. Lengths are shares of the mesh's radius, so that one setting fits meshes of any size.
#ifndef TEGUMENT_PASSES_FUR_PARAMETERS_FXH
#define TEGUMENT_PASSES_FUR_PARAMETERS_FXH

float3 gBoundingCenter : BOUNDINGCENTER < string UIWidget = "None"; >;
float gMeshRadius : BOUNDINGSPHERESIZE < string UIWidget = "None"; >;

float gFurLayers < string UIName = "Layers"; string UIWidget = "Slider"; float UIMin = 1.0; float UIMax = 512.0; float UIStep = 1.0;
    > = 32.0;
float gFurLength < string UIName = "Length"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 0.5; float UIStep = 0.001;
    string UIHelp = "share of the mesh's radius"; > = 0.06;
float gFurTaper < string UIName = "Taper"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0; float UIStep = 0.01;
    string UIHelp = "0: alpha is coverage; 1: alpha is the height of the strand"; > = TG_FUR_TAPER;
float gFurOuterFirst < string UIName = "Outer layers first"; string UIWidget = "CheckBox"; float UIMin = 0.0; float UIMax = 1.0;
    string UIHelp = "alpha tested and opaque: hidden layers are rejected early"; > = 0.0;

float3 gFurRootColor < string UIName = "Colour at the root"; string UIWidget = "Color"; string UIHelp = "albedo, linear";
    > = { 0.16, 0.085, 0.04 };
float gFurAlphaTest < string UIName = "Alpha test"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0; float UIStep = 0.01;
    string UIHelp = "coverage below which a layer shows nothing"; > = 0.02;
float3 gFurTipColor < string UIName = "Colour at the tip"; string UIWidget = "Color"; string UIHelp = "albedo, linear";
    > = { 0.72, 0.52, 0.33 };
float gFurKajiyaKay < string UIName = "Light strands"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0;
    float UIStep = 1.0; string UIHelp = "0: N.L of the mesh; 1: Kajiya and Kay"; > = TG_FUR_KAJIYA_KAY;

float gFurMultiple < string UIName = "Multiple scattering"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0;
    float UIStep = 0.01; > = 0.7;
float gFurSpecular < string UIName = "Specular"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0; float UIStep = 0.01;
    string UIHelp = "share of the light that a strand mirrors"; > = 0.08;
float gFurExponent < string UIName = "Specular exponent"; string UIWidget = "Slider"; float UIMin = 1.0; float UIMax = 500.0;
    float UIStep = 1.0; > = 40.0;
float gFurDensity < string UIName = "Shadow in the coat"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 10.0;
    float UIStep = 0.01; string UIHelp = "optical depth of the coat for light at 45 degrees"; > = 1.2;

float gFurLayer < string UIWidget = "None"; > = 0.0;
float gFurLean < string UIName = "Lean"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0; float UIStep = 0.01;
    string UIHelp = "how far the tips hang down"; > = 0.25;
float gFurCurl < string UIName = "Curl"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 0.05; float UIStep = 0.001;
    string UIHelp = "radius of a strand's turns, radians of the map"; > = 0.0;
float gFurSoftness < string UIName = "Softness"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0; float UIStep = 0.01;
    string UIHelp = "height across which a tapered strand ends"; > = 0.2;

float3 gFurFill < string UIName = "Light from all sides"; string UIWidget = "Color";
    string UIHelp = "irradiance / pi, linear; it throws no shadow but within the coat"; > = { 0.0, 0.0, 0.0 };
float gFurSpread < string UIName = "Spread of the layers"; string UIWidget = "Slider"; float UIMin = 0.25; float UIMax = 4.0;
    float UIStep = 0.01; string UIHelp = "heights are (l / n)^this: below 1 denser at the tips"; > = 1.0;

float gFurDeviation < string UIName = "Deviation of the heights"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 0.5;
    float UIStep = 0.001;
    string UIHelp = "of a tapered fur map; tegument fur texture prints it; 0: seen from afar the coat is as high as the map's mean";
    > = 0.0;
float gFurGrain < string UIName = "Grain of the heights"; string UIWidget = "Slider"; float UIMin = 0.0001; float UIMax = 0.2;
    float UIStep = 0.0001; string UIHelp = "radians of the map across which they vary; printed likewise"; > = 0.006;
float gFurShadow < string UIName = "Shadow of the coat"; string UIWidget = "CheckBox"; float UIMin = 0.0; float UIMax = 1.0;
    string UIHelp = "on other parts of the mesh"; > = 0.0;
float gFurShadowHeight < string UIName = "Height of its shadow"; string UIWidget = "Slider"; float UIMin = 0.0; float UIMax = 1.0;
    float UIStep = 0.01; string UIHelp = "share of the coat that counts as full"; > = 0.65;
float3 gFurDown < string UIName = "Down"; string UIHelp = "unit vector of the world: where tips hang"; > = { 0.0, -1.0, 0.0 };
float gFurFringes < string UIName = "Fringes"; string UIWidget = "CheckBox"; float UIMin = 0.0; float UIMax = 1.0;
    string UIHelp = "1: what lies behind the nearest coat is drawn before it, so that soft fringes show it; 0: in one round";
    > = TG_FUR_FRINGES;

#endif
