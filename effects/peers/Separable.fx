// Separable: separable screen-space subsurface scattering after Jimenez et al. 2015, as a peer of Main.fx (docs/design/peers.md).
// Techniques Separable7, 11, 17 and 25, by the number of samples along each axis. TEGUMENT_PEERS_AS_PRINTED chooses between the authors'
// kernel and one of the six Gaussians.
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
#include "../../hlsl/peers/separable_kernel.fxh"
#include "../../hlsl/printed/separable.fxh"
#include "../../hlsl/peers/separable.fxh"
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
#include "passes/separable.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("Separable25") string WithoutUvs = "*"; > = 0.8;

#ifdef FX_TECHNIQUES
#define SEPARABLE_TECHNIQUE(samples) \
technique Separable##samples < string Script = \
    LIGHT_SCRIPT \
    "RenderColorTarget0=gScatterXMap; Pass=AlongX;" \
    "RenderColorTarget0=gScatterMap; Pass=AlongY;" \
    SCATTERED_SCRIPT; > \
{ \
    LIGHT_PASSES \
    TG_QUAD_PASS(AlongX, TgQuadVS, AlongX##samples##PS, TG_STATE_BUFFER) \
    TG_QUAD_PASS(AlongY, TgQuadVS, AlongY##samples##PS, TG_STATE_BUFFER) \
    SCATTERED_PASS \
}

SEPARABLE_TECHNIQUE(7)
SEPARABLE_TECHNIQUE(11)
SEPARABLE_TECHNIQUE(17)
SEPARABLE_TECHNIQUE(25)
#endif
// SPDX-License-Identifier: MIT
