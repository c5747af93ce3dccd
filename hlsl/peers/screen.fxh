// Places in view space from a depth buffer, for diffusion over the pixels of a picture.
// View space here: x right, y up, z away from the eye along the view, mm. frustum = tangents of half the angles of view, across and up. uv
// of the picture, v down. A depth of 0 means that there is no skin.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_PEERS_SCREEN_FXH
#define TEGUMENT_PEERS_SCREEN_FXH

// Depth of a neighbouring pixel over its distance beyond which it belongs to another part of the surface: one that is seen at less than 4
// degrees.
static const float kTgSteepest = 16.0;

// A half ends at 65504: what is further away counts as here, mm.
static const float kTgFarthestHalf = 65000.0;

// mm: the coarser of the two halves that hold a depth is a multiple of it. The finer one leaves 0.25 um up to 2 m from the eye, 16 um up to
// 65 m.
float tgScreenDepthStep(float depth)
{
    return depth < 2048.0 ? 1.0 : depth < 16384.0 ? 8.0 : 64.0;
}

// From a projection whose axis is the middle of the picture.
float2 tgScreenFrustum(float4x4 projection)
{
    return 1.0 / max(float2(projection[0][0], projection[1][1]), 1e-6);
}

float3 tgScreenPosition(float2 uv, float depth, float2 frustum)
{
    return depth * float3((uv * 2.0 - 1.0) * float2(1.0, -1.0) * frustum, 1.0);
}

float2 tgScreenCoordinate(float3 position, float2 frustum)
{
    return position.xy / (frustum * max(position.z, 1e-3)) * float2(0.5, -0.5) + 0.5;
}

// Change of depth from here to the next pixel; `axis` = one pixel in uv. Of the two neighbours the one whose depth is nearer tells, so that
// an outline leaves the surface beside it as it is; where neither is near, the surface faces the eye.
float tgScreenSlope(TG_SAMPLER2D_PARAM(depth), float2 uv, float2 axis, float2 frustum)
{
    float z = TG_TEX2DLOD(depth, float4(uv, 0.0, 0.0)).x;
    float before = TG_TEX2DLOD(depth, float4(uv - axis, 0.0, 0.0)).x;
    float after = TG_TEX2DLOD(depth, float4(uv + axis, 0.0, 0.0)).x;
    float change = abs(after - z) < abs(z - before) ? after - z : z - before;
    float pixel = 2.0 * z * dot(abs(axis), frustum);
    return abs(change) < kTgSteepest * pixel ? change : 0.0;
}

// Derivative of the place along the surface, by pixel. The way to the next pixel has change times pixel besides, which leans towards the
// axis: in a mirror its length, and so that of a kernel, would be another one.
float3 tgScreenTangent(TG_SAMPLER2D_PARAM(depth), float2 uv, float2 axis, float2 frustum)
{
    float z = TG_TEX2DLOD(depth, float4(uv, 0.0, 0.0)).x;
    float change = tgScreenSlope(TG_SAMPLER2D_ARG(depth), uv, axis, frustum);
    return tgScreenPosition(uv, change, frustum) + float3(z * axis * float2(2.0, -2.0) * frustum, 0.0);
}

// A number in 0..1 that neighbouring pixels spread evenly: interleaved gradient noise (Jimenez, Next generation post processing in Call of
// Duty, 2014).
float tgScreenNoise(float2 pixel)
{
    return frac(52.9829189 * frac(dot(pixel, float2(0.06711056, 0.00583715))));
}

#endif
// SPDX-License-Identifier: MIT
