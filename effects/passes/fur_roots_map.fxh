// The texture of roots: on the whole mesh where nothing names one.
#ifndef TEGUMENT_PASSES_FUR_ROOTS_MAP_FXH
#define TEGUMENT_PASSES_FUR_ROOTS_MAP_FXH

Texture2D gFurRootsMap < string Generator = "fur roots"; float4 Fallback = { 0.0, 0.0, 0.0, 0.0 }; string UIName = "Roots";
    string UIHelp = "from tegument fur roots, made from this mesh"; >;
TG_SAMPLER2D(gFurRoots, POINT, CLAMP);

#endif
// SPDX-License-Identifier: MIT
