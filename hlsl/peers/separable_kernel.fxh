// The kernel of separable scattering, laid along the surface. unit = mm for each unit of the kernel's offsets. docs/design/peers.md
// derives it.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PEERS_SEPARABLE_KERNEL_FXH
#define TEGUMENT_PEERS_SEPARABLE_KERNEL_FXH

// Marginal of the six Gaussians, each row that of its cell between the midpoints to its neighbours; offsets in mm.
static const float4 kTgSeparableKernel[32] = {
    // 7 samples
    float4(3.139999e-01, 5.842734e-01, 7.127511e-01, 0.000000),
    float4(1.587820e-01, 1.885519e-01, 1.412234e-01, 0.244444),
    float4(1.138729e-01, 1.864571e-02, 2.279040e-03, 0.977778),
    float4(7.034512e-02, 6.656376e-04, 1.219756e-04, 2.200000),
    // 11 samples
    float4(1.663179e-01, 3.129954e-01, 3.918107e-01, 0.000000),
    float4(1.459342e-01, 2.494993e-01, 2.635436e-01, 0.108000),
    float4(1.030094e-01, 8.095149e-02, 3.907799e-02, 0.432000),
    float4(7.888494e-02, 1.194099e-02, 1.217622e-03, 0.972000),
    float4(5.174154e-02, 8.659674e-04, 2.440156e-04, 1.728000),
    float4(3.727103e-02, 2.445882e-04, 1.147770e-05, 2.700000),
    // 17 samples
    float4(8.027781e-02, 1.513988e-01, 1.905337e-01, 0.000000),
    float4(1.190357e-01, 2.202935e-01, 2.653236e-01, 0.050000),
    float4(8.784418e-02, 1.317968e-01, 1.130511e-01, 0.200000),
    float4(7.138227e-02, 5.402738e-02, 2.416189e-02, 0.450000),
    float4(5.951977e-02, 1.488082e-02, 1.589004e-03, 0.800000),
    float4(4.713368e-02, 2.551128e-03, 4.576405e-04, 1.250000),
    float4(3.408732e-02, 4.702514e-04, 1.332462e-04, 1.800000),
    float4(2.107825e-02, 1.896742e-04, 1.608553e-05, 2.450000),
    float4(1.977990e-02, 9.105753e-05, 6.147635e-07, 3.200000),
    // 25 samples
    float4(4.719454e-02, 8.903993e-02, 1.121644e-01, 0.000000),
    float4(8.417919e-02, 1.578491e-01, 1.958675e-01, 0.029167),
    float4(8.973742e-02, 1.582202e-01, 1.725919e-01, 0.116667),
    float4(6.122356e-02, 7.972353e-02, 5.649129e-02, 0.262500),
    float4(5.451083e-02, 3.923502e-02, 1.634168e-02, 0.466667),
    float4(4.741870e-02, 1.462817e-02, 1.785293e-03, 0.729167),
    float4(4.020885e-02, 4.305012e-03, 4.910879e-04, 1.050000),
    float4(3.279636e-02, 9.195944e-04, 2.488079e-04, 1.429167),
    float4(2.502888e-02, 3.141165e-04, 8.278493e-05, 1.866667),
    float4(1.734005e-02, 1.610442e-04, 1.583949e-05, 2.362500),
    float4(1.073974e-02, 7.951351e-05, 1.530050e-06, 2.916667),
    float4(6.045604e-03, 3.242392e-05, 6.437093e-08, 3.529167),
    float4(7.173568e-03, 1.230640e-05, 1.001836e-09, 4.200000)
};

// Weights (RGB) and offset of row i of the table.
float4 tgSeparableTap(int i)
{
    return kTgSeparableKernel[i];
}

// uv for each unit of the offsets: so many pixels as bring it that far along the surface.
float2 tgSeparableStep(float2 axis, float3 across, float depth, float2 frustum, float unit)
{
    return axis * (unit / max(length(across), 1e-6));
}

// What a tap keeps of its own light: the squared cosine between the way to the tap and the surface at the centre, whose unit vector is
// along.
float tgSeparableShare(float3 way, float3 along, float scale)
{
    float ahead = dot(way, along);
    return ahead * ahead / max(dot(way, way), 1e-12);
}

#endif
// SPDX-License-Identifier: MIT
