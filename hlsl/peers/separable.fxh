// Separable screen-space subsurface scattering (Jimenez, Zsolnai, Jarabo, Freude, Auzinger, Wu, von der Pahlen, Wimmer and Gutierrez,
// 2015): one kernel with a weight for each colour, along x and then along y of the picture.
// unit = mm for each unit of the kernel's offsets. Kernels are symmetric; only the centre and one side are kept. docs/design/peers.md
// derives them.
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
#ifndef TEGUMENT_PEERS_SEPARABLE_KERNEL_FXH
#include "../peers/separable_kernel.fxh"
#endif
#ifndef TEGUMENT_PRINTED_SEPARABLE_FXH
#include "../printed/separable.fxh"
#endif
#ifndef TEGUMENT_PEERS_SEPARABLE_FXH
#define TEGUMENT_PEERS_SEPARABLE_FXH

// Depth, over the kernel's unit and times the distance of the projection window, at which a tap counts as another surface: the printed
// 300 * width * |dz| with the width of the authors' demonstration, 0.012 of its units, which the kernel's 1.5 units stand for.
static const float kTgSeparableDepthScale = 300.0 * 0.012 * 0.012 / 1.5;

float tgSeparableScale(float2 frustum, float unit)
{
    return kTgSeparableDepthScale / (frustum.y * max(unit, 1e-6));
}

// light: RGB times coverage, and coverage; so a tap half beyond the outline counts half. between: the depth in halves in y and z. ray:
// place over depth. The maps have one level.
float4 tgSeparableLight(TG_SAMPLER2D_PARAM(light), TG_SAMPLER2D_PARAM(between), float2 uv, float3 ray, float3 here, float3 along,
    float scale)
{
    float z = tgHalvesSum(TG_TEX2DFINEST(between, uv).yz);
    return TG_TEX2DFINEST(light, uv) * tgSeparableShare(z * ray - here, along, scale);
}

// One direction: rows first .. first + pairs of the tables. axis: one pixel along x or y, in uv. between: the depth in halves,
// interpolated, because the nearest pixel's would seem to stand out of a surface that is seen at an angle. The centre stands in for what
// the taps do not keep. strength: share of each colour that diffuses.
float4 tgSeparableConvolve(TG_SAMPLER2D_PARAM(light), TG_SAMPLER2D_PARAM(depth), TG_SAMPLER2D_PARAM(between), float2 uv, float2 axis,
    float2 frustum, float unit,
                         float3 strength, int first, int pairs)
{
    float z = TG_TEX2DLOD(depth, float4(uv, 0.0, 0.0)).x;
    float3 across = tgScreenTangent(TG_SAMPLER2D_ARG(depth), uv, axis, frustum);
    float3 along = tgSafeNormalize(across);
    float2 step = tgSeparableStep(axis, across, z, frustum, unit);
    float3 ray = tgScreenPosition(uv, 1.0, frustum);
    float3 turn = float3(step * float2(2.0, -2.0) * frustum, 0.0);
    float scale = tgSeparableScale(frustum, unit);
    float3 sum = float3(0.0, 0.0, 0.0);
    float3 kept = float3(0.0, 0.0, 0.0);
    [unroll] for (int i = 1; i <= pairs; i++)
    {
        float4 tap = tgSeparableTap(first + i);
        float4 pair = tgSeparableLight(TG_SAMPLER2D_ARG(light), TG_SAMPLER2D_ARG(between), uv + tap.w * step, ray + tap.w * turn, z * ray,
            along, scale) +
                      tgSeparableLight(TG_SAMPLER2D_ARG(light), TG_SAMPLER2D_ARG(between), uv - tap.w * step, ray - tap.w * turn, z * ray,
                          along, scale);
        sum += tap.rgb * pair.rgb;
        kept += tap.rgb * pair.a;
    }
    float3 centre = TG_TEX2DLOD(light, float4(uv, 0.0, 0.0)).rgb;
    return z > 0.0 ? float4(centre + strength * (sum - kept * centre), 1.0) : float4(0.0, 0.0, 0.0, 0.0);
}

#endif
// SPDX-License-Identifier: MIT
