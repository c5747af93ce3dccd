// In place of lamp_light.fxh, of an effect that takes no lamps whatever TEGUMENT_LAMPS says: they add nothing.
#ifndef TEGUMENT_PASSES_NO_LAMPS_FXH
#define TEGUMENT_PASSES_NO_LAMPS_FXH

#define WITH_LAMPS(light, lamps) light

struct Lamp
{
    float3 toLight;
    float3 light;
};

Lamp lampAt(int i, float3 world, float3 seen)
{
    Lamp lamp = (Lamp)0;
    return lamp;
}

#endif
// SPDX-License-Identifier: MIT
