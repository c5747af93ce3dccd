// The precomputed table of the specular layer's share, made by EnergyAttenuation.fx.
#ifndef TEGUMENT_PEERS_PASSES_ENERGY_MAP_FXH
#define TEGUMENT_PEERS_PASSES_ENERGY_MAP_FXH

Texture2D gEnergyAttenuationMap < string Producer = "../EnergyAttenuation.fx/gEnergyAttenuationMap";
    string ResourceName = "energy_attenuation.dds"; >;
TG_SAMPLER2D(gEnergyAttenuation, LINEAR, CLAMP);

#endif
// SPDX-License-Identifier: MIT
