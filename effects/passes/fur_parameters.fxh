// What an artist may turn on fur. Lengths are shares of the mesh's radius, so that one setting fits meshes of any size.
#ifndef TEGUMENT_PASSES_FUR_PARAMETERS_FXH
#define TEGUMENT_PASSES_FUR_PARAMETERS_FXH

float3 gBoundingCenter : BOUNDINGCENTER < string UIWidget = "None"; >;
float gMeshRadius : BOUNDINGSPHERESIZE < string UIWidget = "None"; >;

float gFurLayers < UI_SLIDER("Layers", 1.0, 512.0, 1.0) > = 32.0;
float gFurLength < UI_SLIDER("Length", 0.0, 0.5, 0.001) string UIHelp = "share of the mesh's radius"; > = 0.06;
float gFurTaper < UI_SLIDER("Taper", 0.0, 1.0, 0.01)
    string UIHelp = "0: alpha is coverage; 1: alpha is the height of the strand"; > = TG_FUR_TAPER;
float gFurOuterFirst < UI_CHECKBOX("Outer layers first")
    string UIHelp = "alpha tested and opaque: hidden layers are rejected early"; > = 0.0;

float3 gFurRootColor < UI_COLOUR("Colour at the root") string UIHelp = "albedo, linear"; > = { 0.16, 0.085, 0.04 };
float gFurAlphaTest < UI_SLIDER("Alpha test", 0.0, 1.0, 0.01) string UIHelp = "coverage below which a layer shows nothing"; > = 0.02;
float3 gFurTipColor < UI_COLOUR("Colour at the tip") string UIHelp = "albedo, linear"; > = { 0.72, 0.52, 0.33 };
float gFurKajiyaKay < UI_SLIDER("Light strands", 0.0, 1.0, 1.0) string UIHelp = "0: N.L of the mesh; 1: Kajiya and Kay";
    > = TG_FUR_KAJIYA_KAY;

float gFurMultiple < UI_SLIDER("Multiple scattering", 0.0, 1.0, 0.01) > = 0.7;
float gFurSpecular < UI_SLIDER("Specular", 0.0, 1.0, 0.01) string UIHelp = "share of the light that a strand mirrors"; > = 0.08;
float gFurExponent < UI_SLIDER("Specular exponent", 1.0, 500.0, 1.0) > = 40.0;
float gFurDensity < UI_SLIDER("Shadow in the coat", 0.0, 10.0, 0.01)
    string UIHelp = "optical depth of the coat for light at 45 degrees"; > = 1.2;

float gFurLayer < string UIWidget = "None"; > = 0.0;
float gFurLean < UI_SLIDER("Lean", 0.0, 1.0, 0.01) string UIHelp = "how far the tips hang down"; > = 0.25;
float gFurCurl < UI_SLIDER("Curl", 0.0, 0.05, 0.001) string UIHelp = "radius of a strand's turns, radians of the map"; > = 0.0;
float gFurSoftness < UI_SLIDER("Softness", 0.0, 1.0, 0.01) string UIHelp = "height across which a tapered strand ends"; > = 0.2;

float3 gFurFill < UI_COLOUR("Light from all sides")
    string UIHelp = "irradiance / pi, linear; it throws no shadow but within the coat"; > = { 0.0, 0.0, 0.0 };
float gFurSpread < UI_SLIDER("Spread of the layers", 0.25, 4.0, 0.01)
    string UIHelp = "heights are (l / n)^this: below 1 denser at the tips"; > = 1.0;

float gFurDeviation < UI_SLIDER("Deviation of the heights", 0.0, 0.5, 0.001)
    string UIHelp = "of a tapered fur map; tegument fur texture prints it; "
                    "0: seen from afar the coat is as high as the map's mean"; > = 0.0;
float gFurGrain < UI_SLIDER("Grain of the heights", 0.0001, 0.2, 0.0001)
    string UIHelp = "radians of the map across which they vary; printed likewise"; > = 0.006;
float gFurShadow < UI_CHECKBOX("Shadow of the coat") string UIHelp = "on other parts of the mesh"; > = 0.0;
float gFurShadowHeight < UI_SLIDER("Height of its shadow", 0.0, 1.0, 0.01)
    string UIHelp = "share of the coat that counts as full"; > = 0.65;
float3 gFurDown < string UIName = "Down"; string UIHelp = "unit vector of the world: where tips hang"; > = { 0.0, -1.0, 0.0 };
float gFurFringes < UI_CHECKBOX("Fringes")
    string UIHelp = "1: what lies behind the nearest coat is drawn before it, so that soft fringes show it; "
                    "0: in one round"; > = TG_FUR_FRINGES;

#endif
// SPDX-License-Identifier: MIT
