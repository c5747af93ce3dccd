// Drawing a mesh into its own texture space (Borshukov and Lewis 2003). Texel row 0 of the map is v = 0.
#ifndef TEGUMENT_SURFACE_UNWRAP_FXH
#define TEGUMENT_SURFACE_UNWRAP_FXH

float4 tgUnwrapPosition(float2 uv, float z)
{
    return float4(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0, z, 1.0);
}

#endif
// SPDX-License-Identifier: MIT
