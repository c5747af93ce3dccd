// The light of the workspace, as the engine leaves it (engine_light.fxh).
#ifndef TEGUMENT_PASSES_OWN_LIGHT_FXH
#define TEGUMENT_PASSES_OWN_LIGHT_FXH

TgLight ownLight(float3 world)
{
    TgLight ours;
    ours.toLight = tgLightDirection(world);
    ours.color = gLightColor;
    return tgEngineLight(0, world, ours);
}

// By how much the engine's direction differs from this project's: 0 unless it has another one.
float3 ownLightTurned(float3 world)
{
    return ownLight(world).toLight - tgLightDirection(world);
}

float ownVisibility(float3 world, float3 normal, float ours)
{
    return tgEngineVisibility(0, world, normal, ours);
}

#endif
// SPDX-License-Identifier: MIT
