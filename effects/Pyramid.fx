// Pyramid: human skin by a pyramid of B-splines in texture space instead of a cascade of convolutions. Light enters in one full-screen pass
// over an atlas of the mesh, is reduced a few times, and comes back from the levels, weighed so that they make the diffusion profile; what
// is narrower than a texel is left to the pixel. Techniques: Pyramid, for one chart; PyramidLinked, where the widest Gaussians come along
// precomputed links in space, across seams, folds and through thin parts (docs/design/modules/Pyramid.md).
#define TEGUMENT_LIGHTS_IN_ONE_PASS 0
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
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
#include "passes/coarse_levels.fxh"
#include "passes/profile.fxh"
#include "passes/flesh.fxh"
#include "passes/tone.fxh"
#include "passes/planar_shadow.fxh"
#include "passes/atlas.fxh"
#include "passes/relight.fxh"
#include "passes/pyramid_maps.fxh"
#include "passes/bare_skin.fxh"
#include "passes/pyramid.fxh"
#include "passes/pyramid_links.fxh"
#include "passes/pyramid_final.fxh"
#include "passes/pyramid_compute.fxh"

float Script : STANDARDSGLOBAL <
    STARTS_WITH("PyramidLinked") string WithoutUvs = "Main.fx, peers/Separable.fx, peers/Burley.fx, Specular.fx";
> = 0.8;

#ifdef FX_TECHNIQUES
technique Pyramid < string Script =
    LIGHT_SCRIPT(LAMPS_SCRIPT SHADOW_MAP_SCRIPT
    ENTRY_SCRIPT REDUCE_SCRIPT("1") REDUCE_SCRIPT("2") REDUCE_SCRIPT("3") REDUCE_SCRIPT("4") REDUCE_SCRIPT("5") REDUCE_SCRIPT("6")
    LEVEL_SCRIPT("6") LEVEL_SCRIPT("5") LEVEL_SCRIPT("4") LEVEL_SCRIPT("3") LEVEL_SCRIPT("2") LEVEL_SCRIPT("1") LEVEL_SCRIPT("0"))
    PYRAMID_FINAL_SCRIPT; >
{
    LAMPS_PASSES
    PLANAR_SHADOW_PASS
    ENTRY_PASS
    REDUCE_PASS(1) REDUCE_PASS(2) REDUCE_PASS(3) REDUCE_PASS(4) REDUCE_PASS(5) REDUCE_PASS(6)
    LEVEL_PASS(6) LEVEL_PASS(5) LEVEL_PASS(4) LEVEL_PASS(3) LEVEL_PASS(2) LEVEL_PASS(1) LEVEL_PASS(0)
    PYRAMID_FINAL_PASS
}

technique PyramidLinked < string Script =
    LIGHT_SCRIPT(LAMPS_SCRIPT SHADOW_MAP_SCRIPT ENTRY_SCRIPT LINKED_SCRIPT)
    PYRAMID_FINAL_SCRIPT; >
{
    LAMPS_PASSES
    PLANAR_SHADOW_PASS
    ENTRY_PASS
    LINKED_PASSES
    PYRAMID_FINAL_PASS
}
#endif
#ifdef TEGUMENT_COMPUTE_TECHNIQUES
technique PyramidCompute < string Script =
    LIGHT_SCRIPT(LAMPS_SCRIPT SHADOW_MAP_SCRIPT ENTRY_SCRIPT COMPUTE_SCRIPT)
    PLACE_SCRIPT; >
{
    LAMPS_PASSES
    PLANAR_SHADOW_PASS
    COMPUTE_PASSES
    PLACE_PASSES
}
#endif
// SPDX-License-Identifier: MIT
