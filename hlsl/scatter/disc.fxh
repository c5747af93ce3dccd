// The disc of Gosselin's blurs, twelve points (seed 5.3, after Gosselin, Sander and Mitchell 2004).
#ifndef TEGUMENT_SCATTER_DISC_FXH
#define TEGUMENT_SCATTER_DISC_FXH

static const float2 kTgPoissonDisc[12] = {
    float2(-0.326212, -0.405810), float2(-0.840144, -0.073580), float2(-0.695914, 0.457137), float2(-0.203345, 0.620716),
    float2(0.962340, -0.194983), float2(0.473434, -0.480026), float2(0.519456, 0.767022), float2(0.185461, -0.893124),
    float2(0.507431, 0.064425), float2(0.896420, 0.412458), float2(-0.321940, -0.932615), float2(-0.791559, -0.597710)
};

#endif
// SPDX-License-Identifier: MIT
