// cull/outside.fxh as printed: clip-space form of seed equations 41 and 42, p.x / p.z > tan(fov / 2) is x / w > 1.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PRINTED_OUTSIDE_FXH
#define TEGUMENT_PRINTED_OUTSIDE_FXH

// In the plane of the eye the ratio has no value.
static const float kTgSmallestClipW = 1e-6;

// The right and the upper side only; of the points behind the camera, which have no picture, half count as inside.
bool tgCullOutsideView(float4 clip)
{
    float2 ratio = clip.xy / (abs(clip.w) > kTgSmallestClipW ? clip.w : kTgSmallestClipW);
    return ratio.x > 1.0 || ratio.y > 1.0;
}

#endif
// SPDX-License-Identifier: MIT
