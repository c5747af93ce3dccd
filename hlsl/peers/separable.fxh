// Separable screen-space subsurface scattering (Jimenez, Zsolnai, Jarabo, Freude, Auzinger, Wu, von der Pahlen, Wimmer and Gutierrez, 2015): one kernel
// with a weight for each colour, along x and then along y of the picture.
// unit = mm for each unit of the kernel's offsets. Kernels are symmetric; only the centre and one side are kept. docs/peers.md derives them.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_SURFACE_HALVES_FXH
#include "../surface/halves.fxh"
#endif
#ifndef TEGUMENT_PEERS_SCREEN_FXH
#include "../peers/screen.fxh"
#endif
#ifndef TEGUMENT_PEERS_SEPARABLE_FXH
#define TEGUMENT_PEERS_SEPARABLE_FXH

// Marginal of the six Gaussians, each row that of its cell between the midpoints to its neighbours; offsets in mm.
static const float4 kSeparableCorrected[32] = {
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
// What the authors' program computes with its default strength (.48 .41 .28) and falloff (1 .37 .3).
static const float4 kSeparablePrinted[32] = {
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

// Depth, over the kernel's unit and times the distance of the projection window, at which a tap counts as another surface: the printed 300 * width * |dz|
// with the width of the authors' demonstration, 0.012 of its units, which the kernel's 1.5 units stand for.
static const float kSeparableDepthScale = 300.0 * 0.012 * 0.012 / 1.5;

// Weights (RGB) and offset of row i of the tables.
float4 separableTap(int i)
{
    return kPeersAsPrinted ? kSeparablePrinted[i] : kSeparableCorrected[i];
}

// uv for each unit of the offsets. Corrected: so many pixels as bring it that far along the surface. Printed: as far as it appears in the height of the
// picture when it faces the eye, also across.
float2 separableStep(float2 axis, float3 across, float depth, float2 frustum, float unit)
{
    float2 printed = (axis.x > 0.0 ? float2(1.0, 0.0) : float2(0.0, 1.0)) * (0.5 * unit / (frustum.y * max(depth, 1e-3)));
    return kPeersAsPrinted ? printed : axis * (unit / max(length(across), 1e-6));
}

// What a tap keeps of its own light. Corrected: the squared cosine between the way to the tap and the surface at the centre, whose unit vector is along.
// Printed: by the difference of depth; scale from separableScale.
float separableShare(float3 way, float3 along, float scale)
{
    float ahead = dot(way, along);
    return kPeersAsPrinted ? 1.0 - saturate(scale * abs(way.z)) : ahead * ahead / max(dot(way, way), 1e-12);
}

float separableScale(float2 frustum, float unit)
{
    return kSeparableDepthScale / (frustum.y * max(unit, 1e-6));
}

// light: RGB times coverage, and coverage; so a tap half beyond the outline counts half. between: the depth in halves in y and z. ray: place over depth.
// The maps have one level: plain look-ups take half of the slots that those with a level take in shader model 3.
float4 separableLight(SAMPLER2D_PARAM(light), SAMPLER2D_PARAM(between), float2 uv, float3 ray, float3 here, float3 along, float scale)
{
    float z = halvesSum(tex2D(between, uv).yz);
    return tex2D(light, uv) * separableShare(z * ray - here, along, scale);
}

// One direction: rows first .. first + pairs of the tables. axis: one pixel along x or y, in uv. between: the depth in halves, interpolated, because the nearest
// pixel's would seem to stand out of a surface that is seen at an angle. The centre stands in for what the taps do not keep.
// strength: share of each colour that diffuses.
float4 separableConvolve(SAMPLER2D_PARAM(light), SAMPLER2D_PARAM(depth), SAMPLER2D_PARAM(between), float2 uv, float2 axis, float2 frustum, float unit,
                         float3 strength, int first, int pairs)
{
    float z = tex2Dlod(depth, float4(uv, 0.0, 0.0)).x;
    float3 across = screenAcross(SAMPLER2D_ARG(depth), uv, axis, frustum);
    float3 along = safeNormalize(across);
    float2 step = separableStep(axis, across, z, frustum, unit);
    float3 ray = screenPosition(uv, 1.0, frustum);
    float3 turn = float3(step * float2(2.0, -2.0) * frustum, 0.0);
    float scale = separableScale(frustum, unit);
    float3 sum = float3(0.0, 0.0, 0.0);
    float3 kept = float3(0.0, 0.0, 0.0);
    [unroll] for (int i = 1; i <= pairs; i++)
    {
        float4 tap = separableTap(first + i);
        float4 pair = separableLight(SAMPLER2D_ARG(light), SAMPLER2D_ARG(between), uv + tap.w * step, ray + tap.w * turn, z * ray, along, scale) +
                      separableLight(SAMPLER2D_ARG(light), SAMPLER2D_ARG(between), uv - tap.w * step, ray - tap.w * turn, z * ray, along, scale);
        sum += tap.rgb * pair.rgb;
        kept += tap.rgb * pair.a;
    }
    float3 centre = tex2Dlod(light, float4(uv, 0.0, 0.0)).rgb;
    return z > 0.0 ? float4(centre + strength * (sum - kept * centre), 1.0) : float4(0.0, 0.0, 0.0, 0.0);
}

#endif
