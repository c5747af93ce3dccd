// FurRoots: fur whose strands grow on the surface itself, in proportion to area, without texture coordinates, seams or stretch, and few layers that each sweep
// what lies between them and the next. Technique Cellular needs nothing but the mesh; technique Roots reads roots made by `tegument fur roots`.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/fur.fxh"
#include "passes/shadow_map.fxh"
#include "passes/fur_parameters.fxh"
#include "passes/fur_roots_parameters.fxh"
#include "passes/fur_rounds.fxh"
#include "passes/fur_coat.fxh"
#include "passes/fur_strands.fxh"
#include "passes/fur_cellular.fxh"
#include "passes/fur_rooted.fxh"

float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "object";
    string ScriptOrder = "standard";
    string ScriptOutput = "color";
    string Workspace = "bunny_roots.json";
    string Script = "Technique=Cellular;";
> = 0.8;

#ifdef FX_TECHNIQUES
#define STRANDS_TECHNIQUE(name, endVS, behindVS, strandsVS, strandsPS) \
technique name < string Script = \
    "RenderColorTarget0=gShadowMap; RenderDepthStencilTarget=gShadowDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=ShadowMap;" \
    ROUNDS_SCRIPT("Skin", "Strands"); > \
{ \
    MESH_PASS(ShadowMap, ShadowMapVS, ShadowMapPS, STATE_TWOSIDED) \
    MESH_PASS(Skin, SkinVS, SkinPS, STATE_SOLID) \
    MESH_PASS(CoatEnd, endVS, CoatEndPS, STATE_INSIDE) \
    LAYER_PASS(Behind, "gFurLayers", behindVS, strandsPS, STATE_LAYER) \
    LAYER_PASS(Strands, "gFurLayers", strandsVS, strandsPS, STATE_LAYER) \
}

STRANDS_TECHNIQUE(Cellular, CellularEndVS, CellularBehindVS, CellularVS, CellularPS)
STRANDS_TECHNIQUE(Roots, RootsEndVS, RootsBehindVS, RootsVS, RootsPS)
#endif
