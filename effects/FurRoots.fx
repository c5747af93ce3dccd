// FurRoots: fur whose strands grow on the surface itself, in proportion to area, without texture coordinates, seams or stretch, and few
// layers that each sweep what lies between them and the next. Technique Cellular needs nothing but the mesh; technique Roots reads roots
// made by `tegument fur roots`.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/fur.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/shadow_map.fxh"
#include "passes/no_lamps.fxh"
#include "passes/fur_parameters.fxh"
#include "passes/fur_roots_parameters.fxh"
#include "passes/fur_roots_map.fxh"
#include "passes/fur_roots_texture.fxh"
#include "passes/fur_rounds.fxh"
#include "passes/fur_coat.fxh"
#include "passes/fur_strands.fxh"
#include "passes/fur_cellular.fxh"
#include "passes/fur_rooted.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Cellular") string Workspace = "bunny_roots.json"; > = 0.8;

#ifdef FX_TECHNIQUES
#define STRANDS_TECHNIQUE(name, endVS, behindVS, strandsVS, strandsPS) \
technique name < string Script = \
    SHADOW_MAP_SCRIPT \
    ROUNDS_SCRIPT("Skin", "Strands"); > \
{ \
    SHADOW_MAP_PASS \
    TG_MESH_PASS(Skin, SkinVS, SkinPS, TG_STATE_SOLID) \
    TG_MESH_PASS(CoatEnd, endVS, CoatEndPS, TG_STATE_INSIDE) \
    TG_LAYER_PASS(Behind, "gFurLayers", behindVS, strandsPS, TG_STATE_LAYER) \
    TG_LAYER_PASS(Strands, "gFurLayers", strandsVS, strandsPS, TG_STATE_LAYER) \
}

STRANDS_TECHNIQUE(Cellular, CellularEndVS, CellularBehindVS, CellularVS, CellularPS)
STRANDS_TECHNIQUE(Roots, RootsEndVS, RootsBehindVS, RootsVS, RootsPS)
#endif
// SPDX-License-Identifier: MIT
