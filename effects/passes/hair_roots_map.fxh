// The texture of roots: on a head where hair grows, where nothing names one.
#ifndef TEGUMENT_PASSES_HAIR_ROOTS_MAP_FXH
#define TEGUMENT_PASSES_HAIR_ROOTS_MAP_FXH

Texture2D gFurRootsMap < string Generator = "hair roots"; float4 Fallback = { 0.0, 0.0, 0.0, 0.0 }; string UIName = "Roots";
    string UIHelp = "from tegument fur roots, made from this mesh"; >;
TG_SAMPLER2D(gFurRoots, POINT, CLAMP);

#endif
// SPDX-License-Identifier: MIT
