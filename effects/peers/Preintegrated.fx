// Preintegrated: skin shaded from a table over N.L and curvature, after Penner and Borshukov 2011, as a peer of Main.fx
// (docs/design/peers.md). Technique Preintegrated scatters around curved surfaces; PreintegratedPenumbra at the edges of shadows too.
// TEGUMENT_PEERS_AS_PRINTED chooses between the printed listing and FaceWorks' one-dimensional integral.
#define TEGUMENT_LIGHTS_IN_ONE_PASS 0
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
#include "../../hlsl/peers/ring.fxh"
#include "../../hlsl/peers/ring_light.fxh"
#include "../../hlsl/printed/preintegrated.fxh"
#include "../../hlsl/peers/preintegrated.fxh"
#include "../../hlsl/peers/penumbra.fxh"
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
#include "../passes/light_by_light.fxh"
#include "passes/point.fxh"
#include "../passes/profile.fxh"
#include "passes/preintegrated.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("PreintegratedPenumbra") > = 0.8;

#ifdef FX_TECHNIQUES
technique Preintegrated < string Script =
    LAMPS_SCRIPT SHADOW_MAP_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Final;" LIGHTS_SCRIPT("Preintegrated"); >
{
    LAMPS_PASSES
    SHADOW_MAP_PASS
    TG_MESH_PASS(Final, SurfaceVS, PreintegratedPS, TG_STATE_SOLID)
    LIGHTS_PASSES(Preintegrated, SurfaceVS)
}

technique PreintegratedPenumbra < string Script =
    LAMPS_SCRIPT SHADOW_MAP_SCRIPT
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Final;" LIGHTS_SCRIPT("Preintegrated"); >
{
    LAMPS_PASSES
    SHADOW_MAP_PASS
    TG_MESH_PASS(Final, SurfaceVS, PreintegratedPenumbraPS, TG_STATE_SOLID)
    LIGHTS_PASSES(Preintegrated, SurfaceVS)
}
#endif
// SPDX-License-Identifier: MIT
