// FurSkin: skin and hair of a head in one picture: skin by Pyramid's pyramid of light, scalp, brows and beard as FurCoat's ribbons.
// Strands throw shadows on skin and strands, and the head throws its own on both. The mesh has the part "underfur", which the host grows
// where hair is (docs/design/modules/FurSkin.md).
#define TEGUMENT_LIGHTS_IN_ONE_PASS 0
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
#include "../hlsl/fur.fxh"
#include "passes/annotations.fxh"
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/quad.fxh"
#include "passes/materials.fxh"
#include "passes/skin_parameters.fxh"
#include "passes/shadow_map.fxh"
#include "passes/lamp_light.fxh"
#include "passes/lamps.fxh"
#include "passes/more_light.fxh"
#include "passes/surface.fxh"
#include "passes/specular.fxh"

Texture2D gEnergyAttenuationMap < string Producer = "EnergyAttenuation.fx/gEnergyAttenuationMap";
    string ResourceName = "energy_attenuation.dds"; >;
TG_SAMPLER2D(gEnergyAttenuation, LINEAR, CLAMP);

#include "passes/diffuse_share.fxh"
#include "passes/more_light_sum.fxh"
#include "passes/energy_share.fxh"
#include "passes/light_by_light.fxh"
#include "passes/fur_parameters.fxh"
#include "passes/fur_roots_parameters.fxh"
#include "passes/fur_ribbon_parameters.fxh"
#include "passes/hair_roots_map.fxh"
#include "passes/fur_roots_texture.fxh"
#include "passes/fur_rounds.fxh"
#include "passes/fur_coat.fxh"
#include "passes/fur_ribbons.fxh"
#include "passes/fur_curves.fxh"
#include "passes/fur_lock_parameters.fxh"
#include "passes/relight.fxh"
#include "passes/fur_opacity.fxh"
#include "passes/fur_fibre_light.fxh"
static const float kLockHidden = 0.0; // at a parting nothing of a strand is
#include "passes/fur_locks.fxh"
#include "passes/profile.fxh"
#include "passes/flesh.fxh"
#include "passes/tone.fxh"
#include "passes/planar_shadow.fxh"
#include "passes/atlas.fxh"
#include "passes/pyramid_maps.fxh"
#include "passes/hairy_skin.fxh"
#include "passes/pyramid.fxh"
#include "passes/pyramid_final.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Hair") string Workspace = "human_hair.json"; > = 0.8;

#ifdef FX_TECHNIQUES
technique Hair < string Script =
    LIGHT_SCRIPT(LAMPS_SCRIPT SHADOW_MAP_SCRIPT OPACITY_SCRIPT
    ENTRY_SCRIPT REDUCE_SCRIPT("1") REDUCE_SCRIPT("2") REDUCE_SCRIPT("3") REDUCE_SCRIPT("4") REDUCE_SCRIPT("5") REDUCE_SCRIPT("6")
    LEVEL_SCRIPT("6") LEVEL_SCRIPT("5") LEVEL_SCRIPT("4") LEVEL_SCRIPT("3") LEVEL_SCRIPT("2") LEVEL_SCRIPT("1") LEVEL_SCRIPT("0"))
    PYRAMID_FINAL_SCRIPT
    TG_LAYER_SCRIPT("gCoatChildren", "gFurChild", "Core") TG_LAYER_SCRIPT("gCoatChildren", "gFurChild", "Fringe"); >
{
    LAMPS_PASSES
    PLANAR_SHADOW_PASS
    OPACITY_PASSES
    ENTRY_PASS
    REDUCE_PASS(1) REDUCE_PASS(2) REDUCE_PASS(3) REDUCE_PASS(4) REDUCE_PASS(5) REDUCE_PASS(6)
    LEVEL_PASS(6) LEVEL_PASS(5) LEVEL_PASS(4) LEVEL_PASS(3) LEVEL_PASS(2) LEVEL_PASS(1) LEVEL_PASS(0)
    PYRAMID_FINAL_PASS
    TG_SEEN_LAYER_PASS(Core, "underfur", LOCK_CORE, "gCoatChildren", LocksVS, RibbonSoftCorePS, TG_STATE_STRAND)
    TG_SEEN_LAYER_PASS(Fringe, "underfur", LOCK_SEEN, "gCoatChildren", LocksVS, RibbonSoftFringePS, TG_STATE_FRINGE)
}
#endif
// SPDX-License-Identifier: MIT
