// The precomputed Stretch map, made by Stretch.fx.
#ifndef TEGUMENT_PASSES_STRETCH_FXH
#define TEGUMENT_PASSES_STRETCH_FXH

Texture2D gStretchMap < string Producer = "Stretch.fx/gStretchMap"; string ResourceName = "stretch.dds"; >;
TG_SAMPLER2D(gStretch, POINT, CLAMP);

#endif
// SPDX-License-Identifier: MIT
