// Burley: normalised diffusion gathered over a disc of the picture with importance sampling, after Golubev 2018, as a peer of Main.fx
// (docs/design/peers.md). Techniques Burley20, 40 and 80, by the number of samples. TEGUMENT_PEERS_AS_PRINTED chooses between the published
// weights on a disc that faces the eye and weights over area on one that lies in the surface.
#include "../../hlsl/platform.fxh"
#include "../../hlsl/settings.fxh"
#include "../../hlsl/constants.fxh"
#include "../../hlsl/printed/seed.fxh"
#include "../../hlsl/printed/deon2007.fxh"
#include "../../hlsl/space.fxh"
#include "../../hlsl/workspace.fxh"
#include "../../hlsl/surface/normal.fxh"
#include "../../hlsl/surface/halves.fxh"
#include "../../hlsl/surface/unwrap.fxh"
#include "../../hlsl/specular/fresnel.fxh"
#include "../../hlsl/specular/beckmann.fxh"
#include "../../hlsl/specular/kelemen.fxh"
#include "../../hlsl/specular/lobes.fxh"
#include "../../hlsl/specular/energy.fxh"
#include "../../hlsl/printed/energy.fxh"
#include "../../hlsl/light/surroundings.fxh"
#include "../../hlsl/light/lamps.fxh"
#include "../../hlsl/shadow/map.fxh"
#include "../../hlsl/shadow/planar.fxh"
#include "../../hlsl/shadow/blocks.fxh"
#include "../../hlsl/shadow/soft.fxh"
#include "../../hlsl/shadow/filter.fxh"
#include "../../hlsl/printed/filter.fxh"
#include "../../hlsl/scatter/irradiance.fxh"
#include "../../hlsl/peers/screen.fxh"
#include "../../hlsl/peers/burley_profile.fxh"
#include "../../hlsl/peers/burley_weight.fxh"
#include "../../hlsl/printed/burley.fxh"
#include "../../hlsl/peers/burley.fxh"
#include "../passes/annotations.fxh"
#include "../passes/vertex.fxh"
#include "../passes/engine_light.fxh"
#include "../passes/own_light.fxh"
#include "../passes/quad.fxh"
#include "../passes/materials.fxh"
#include "../passes/skin_parameters.fxh"
#include "../passes/shadow_map.fxh"
#include "../passes/lamp_light.fxh"
#include "../passes/lamps.fxh"
#include "../passes/more_light.fxh"
#include "../passes/surface.fxh"
#include "../passes/specular.fxh"
#include "passes/energy_map.fxh"
#include "../passes/diffuse_share.fxh"
#include "../passes/more_light_sum.fxh"
#include "../passes/energy_share.fxh"
#include "passes/point.fxh"
#include "passes/screen.fxh"
#include "passes/burley.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Burley40") string WithoutUvs = "*"; > = 0.8;

#ifdef FX_TECHNIQUES
#define BURLEY_TECHNIQUE(samples) \
technique Burley##samples < string Script = \
    LIGHT_SCRIPT \
    "RenderColorTarget0=gScatterMap; Pass=Gather;" \
    SCATTERED_SCRIPT; > \
{ \
    LIGHT_PASSES \
    TG_QUAD_PASS(Gather, TgQuadVS, Gather##samples##PS, TG_STATE_BUFFER) \
    SCATTERED_PASS \
}

BURLEY_TECHNIQUE(20)
BURLEY_TECHNIQUE(40)
BURLEY_TECHNIQUE(80)
#endif
// SPDX-License-Identifier: MIT
