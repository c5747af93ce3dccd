// Where every effect takes its light from. An engine replaces this file: it defines these two functions and the guard below before it
// includes an effect (docs/your-engine.md). Passes of shadow maps that its functions do not ask for need not be drawn.
// i: 0 the light of the workspace, from 1 on its lamps; position: world; ours: what this project's own light says.
#ifndef TEGUMENT_PASSES_ENGINE_LIGHT_FXH
#define TEGUMENT_PASSES_ENGINE_LIGHT_FXH

TgLight tgEngineLight(int i, float3 position, TgLight ours)
{
    return ours;
}

// Share of the light that arrives. normal: of the surface, unit; 0 for strands. ours: by this project's maps, of a lamp with its falloff.
float tgEngineVisibility(int i, float3 position, float3 normal, float ours)
{
    return ours;
}

#endif
// SPDX-License-Identifier: MIT
