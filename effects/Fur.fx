// Fur: shells over any mesh, as seed 004 defines them, without texture coordinates. Six techniques: the fur lies in a cube map or in a
// sphere map (tegument fur texture makes both) and is looked up by the position of the vertex, by its normal, or by the sum of both. Each
// technique draws the shadow map, the hull of the coat into one of its own if wanted, the skin, then gFurLayers shells, what lies behind
// the nearest coat first: in instanced draws, or, for Direct3D 9, in loops of the script.
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/fur.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/shadow_map.fxh"
#include "passes/lamp_light.fxh"
#include "passes/fur_parameters.fxh"
#include "passes/fur_rounds.fxh"
#include "passes/fur_coat.fxh"
#include "passes/fur_shadow.fxh"
#include "passes/fur_shell.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("CubePosition") string Workspace = "bunny.json"; > = 0.8;

#ifdef FX_TECHNIQUES
// The six differ in one pixel shader.
#define FUR_TECHNIQUE(name, shellPS) \
technique name < string Script = \
    SHADOW_MAP_SCRIPT HULL_SCRIPT \
    ROUNDS_SCRIPT("Skin", "Shells"); > \
{ \
    SHADOW_MAP_PASS \
    HULL_PASSES \
    TG_MESH_PASS(Skin, SkinVS, CoatedSkinPS, TG_STATE_SOLID) \
    TG_MESH_PASS(CoatEnd, CoatEndVS, CoatEndPS, TG_STATE_INSIDE) \
    TG_LAYER_PASS(Behind, "gFurLayers", BehindVS, shellPS, TG_STATE_LAYER) \
    TG_LAYER_PASS(Shells, "gFurLayers", ShellsVS, shellPS, TG_STATE_LAYER) \
}

FUR_TECHNIQUE(CubePosition, CubePositionPS)
FUR_TECHNIQUE(CubeNormal, CubeNormalPS)
FUR_TECHNIQUE(CubeCombined, CubeCombinedPS)
FUR_TECHNIQUE(SpherePosition, SpherePositionPS)
FUR_TECHNIQUE(SphereNormal, SphereNormalPS)
FUR_TECHNIQUE(SphereCombined, SphereCombinedPS)
#endif
// SPDX-License-Identifier: MIT
