// The normal map of the material, in tangent space.
#ifndef TEGUMENT_PASSES_NORMAL_MAP_FXH
#define TEGUMENT_PASSES_NORMAL_MAP_FXH

Texture2D gNormalMap : NORMAL < float4 Fallback = { 0.5, 0.5, 1.0, 1.0 }; string UIName = "Normal map"; >;
TG_SAMPLER2D(gNormal, LINEAR, CLAMP);

#endif
