// Skin without hair.
#ifndef TEGUMENT_PASSES_BARE_SKIN_FXH
#define TEGUMENT_PASSES_BARE_SKIN_FXH

// What hair leaves of the light to the skin at a point of the world.
float skinOpen(float3 world)
{
    return 1.0;
}

#endif
// SPDX-License-Identifier: MIT
