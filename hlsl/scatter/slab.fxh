// Light through a slab of skin, as photons in three layers pass it (docs/design/skin-error.md, "Through an ear"): epidermis, upper dermis,
// bloody dermis, and back. The published profile lets far less through: of red .022 behind 4.5 mm, where the simulation has .139.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_SLAB_FXH
#define TEGUMENT_SCATTER_SLAB_FXH

// Decay per mm and share at 0 of two exponentials, fitted to 1.5, 2.5, 4.5 and 6.5 mm within 1 %. Divided by the simulated skin's own
// albedo, as the profile is normalised and the colour map says how much comes back.
static const float3 kTgSlabDecay = float3(0.1107, 0.387, 3.541);
static const float3 kTgSlabShare = float3(0.2295, 0.2128, 1.396);
static const float2 kTgSlabThin = float2(1.41, 0.0955); // green alone
static const float3 kTgSlabAlbedo = float3(0.4894, 0.4059, 0.3118);

// Per channel. thickness: mm. What is thinner than 1 mm was not simulated: it passes as much as that.
float3 tgSlabPassed(float thickness)
{
    float t = max(thickness, 1.0);
    float3 passed = kTgSlabShare * exp(-kTgSlabDecay * t);
    passed.y += kTgSlabThin.y * exp(-kTgSlabThin.x * t);
    return passed / kTgSlabAlbedo;
}

#endif
// SPDX-License-Identifier: MIT
