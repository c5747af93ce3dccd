// What the prepass of the frustum takes out: all that is outside, by every side of the view and behind the camera.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_CULL_VISIBILITY_FXH
#include "../cull/visibility.fxh"
#endif
#ifndef TEGUMENT_CULL_OUTSIDE_FXH
#define TEGUMENT_CULL_OUTSIDE_FXH

bool tgCullOutsideView(float4 clip)
{
    return tgCullOutside(clip);
}

#endif
// SPDX-License-Identifier: MIT
