// peers/separable_kernel.fxh as its authors' program has it.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PRINTED_SEPARABLE_FXH
#define TEGUMENT_PRINTED_SEPARABLE_FXH

// What the authors' program computes with its default strength (.48 .41 .28) and falloff (1 .37 .3).
static const float4 kTgSeparableKernel[32] = {
    // 7 samples
    float4(6.197395e-01, 8.026325e-01, 8.902653e-01, 0.000000),
    float4(1.404804e-01, 8.437434e-02, 4.904676e-02, 0.222222),
    float4(4.319295e-02, 1.403345e-02, 5.746406e-03, 0.888889),
    float4(6.456917e-03, 2.759880e-04, 7.417460e-05, 2.000000),
    // 11 samples
    float4(5.604788e-01, 6.690861e-01, 7.847278e-01, 0.000000),
    float4(7.718024e-02, 1.134912e-01, 7.938032e-02, 0.080000),
    float4(8.219038e-02, 3.586084e-02, 2.092604e-02, 0.320000),
    float4(3.638996e-02, 1.309991e-02, 6.436849e-03, 0.720000),
    float4(1.928312e-02, 2.820184e-03, 8.421406e-04, 1.280000),
    float4(4.716915e-03, 1.847708e-04, 5.075656e-05, 2.000000),
    // 17 samples
    float4(5.363425e-01, 6.246244e-01, 7.488670e-01, 0.000000),
    float4(3.244625e-02, 6.567180e-02, 5.328213e-02, 0.031250),
    float4(5.824165e-02, 6.599588e-02, 4.113288e-02, 0.125000),
    float4(5.710558e-02, 2.874324e-02, 1.728435e-02, 0.281250),
    float4(3.473169e-02, 1.510853e-02, 8.719834e-03, 0.500000),
    float4(2.163012e-02, 7.946179e-03, 3.769906e-03, 0.781250),
    float4(1.446094e-02, 3.172690e-03, 1.063987e-03, 1.125000),
    float4(1.003857e-02, 9.146792e-04, 2.757021e-04, 1.531250),
    float4(3.173942e-03, 1.348229e-04, 3.772691e-05, 2.000000),
    // 25 samples
    float4(5.306051e-01, 6.135144e-01, 7.396010e-01, 0.000000),
    float4(2.114117e-02, 4.592863e-02, 3.781955e-02, 0.020833),
    float4(4.027840e-02, 6.572441e-02, 4.631004e-02, 0.083333),
    float4(4.935882e-02, 3.677259e-02, 2.194847e-02, 0.187500),
    float4(4.101717e-02, 1.998990e-02, 1.184807e-02, 0.333333),
    float4(2.636417e-02, 1.197153e-02, 6.845982e-03, 0.520833),
    float4(1.792396e-02, 7.116910e-03, 3.471937e-03, 0.750000),
    float4(1.284963e-02, 3.563291e-03, 1.320159e-03, 1.020833),
    float4(9.438904e-03, 1.391194e-03, 4.165984e-04, 1.333333),
    float4(7.009757e-03, 4.936600e-04, 1.519376e-04, 1.687500),
    float4(5.003638e-03, 2.009396e-04, 5.288483e-05, 2.083333),
    float4(3.338044e-03, 7.854431e-05, 1.294503e-05, 2.520833),
    float4(9.737932e-04, 1.118619e-05, 9.434374e-07, 3.000000)
};

// Weights (RGB) and offset of row i of the table.
float4 tgSeparableTap(int i)
{
    return kTgSeparableKernel[i];
}

// As far as it appears in the height of the picture when it faces the eye, also across.
float2 tgSeparableStep(float2 axis, float3 across, float depth, float2 frustum, float unit)
{
    return (axis.x > 0.0 ? float2(1.0, 0.0) : float2(0.0, 1.0)) * (0.5 * unit / (frustum.y * max(depth, 1e-3)));
}

// By the difference of depth; scale from tgSeparableScale.
float tgSeparableShare(float3 way, float3 along, float scale)
{
    return 1.0 - saturate(scale * abs(way.z));
}

#endif
// SPDX-License-Identifier: MIT
