// Texture-space culling (seed 5.3.1; Gosselin et al. 2004): a prepass writes depth 1 where a texel cannot show, and the later passes, drawn
// at depth 0 with the test EQUAL, skip it. normal, toEye: unit; toEye points from the surface to the eye (the seed's wording, taken
// literally, would cull the front).
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_CONSTANTS_FXH
#include "../constants.fxh"
#endif
#ifndef TEGUMENT_PRINTED_SEED_FXH
#include "../printed/seed.fxh"
#endif
#ifndef TEGUMENT_PRINTED_DEON2007_FXH
#include "../printed/deon2007.fxh"
#endif
#ifndef TEGUMENT_CULL_VISIBILITY_FXH
#define TEGUMENT_CULL_VISIBILITY_FXH

// Both signs, and all that is behind the camera.
bool tgCullOutside(float4 clip)
{
    return clip.w <= 0.0 || abs(clip.x) > clip.w || abs(clip.y) > clip.w;
}

// slack: 0 in the seed. A triangle may face the eye although its interpolated normal does not yet.
bool tgCullBackFace(float3 normal, float3 toEye, float slack)
{
    return dot(normal, toEye) < -slack;
}

bool tgCullBlack(float3 colour)
{
    return max(colour.r, max(colour.g, colour.b)) <= kTgBlack;
}

#endif
// SPDX-License-Identifier: MIT
