// The full-screen quad of every pass that processes a map, and of those that show one.
#ifndef TEGUMENT_PASSES_QUAD_FXH
#define TEGUMENT_PASSES_QUAD_FXH

struct TgQuadVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
};

TgQuadVarying TgQuadVS(TgQuadInput input)
{
    TgQuadVarying output;
    output.position = TG_HALF_PIXEL(float4(input.position.xy, 0.0, 1.0), gViewportSize);
    output.uv = input.uv;
    return output;
}

#endif
// SPDX-License-Identifier: MIT
