// Diffusion of light over an engine's own buffers: light that enters the skin, without colour, and the depth buffer.
// A pixel's light is the sum over the surface that the picture shows, of R(distance) * light * area; R = a sum of six Gaussians, distance
// in space, so that nothing crosses from an ear to the cheek behind it. Lengths in mm, in view space; place along the view of either sign.
// matrix: from (u, v, depth as stored, 1) of the picture to view space, row vectors: whatever the projection, it alone says so.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SCATTER_POST_FXH
#define TEGUMENT_SCATTER_POST_FXH

// Tables: a row for each profile. Profiles: six texels, RGB weight / (2 pi variance), alpha log2(e) / (2 variance). Kernels: a texel for
// each sample, RGB its share of the light over R at its radius, mm^2; alpha the radius, mm.
static const float kTgPostProfiles = 16.0;
static const float kTgPostGaussians = 8.0;
static const float kTgPostSamples = 64.0;
// Largest area of the surface in a pixel over that of one that faces the eye: seen at less than 5 degrees.
static const float kTgPostGrazing = 12.0;
// Coarsest level that samples read, and how much finer than their distance it is.
static const float kTgPostCoarsest = 6.0;
static const float kTgPostFiner = 0.5;
// Samples within this share of a pixel's area are the pixel's own light.
static const float kTgPostOwn = 0.5;

// alpha of the light: 0 no skin; profile 0 to 15, strength 0 to 1.
float tgPostMask(float profile, float strength)
{
    return (profile + 0.0625 + 0.875 * saturate(strength)) / kTgPostProfiles;
}

float tgPostProfile(float mask)
{
    return min(floor(mask * kTgPostProfiles), kTgPostProfiles - 1.0);
}

float tgPostStrength(float mask)
{
    return saturate((frac(min(mask * kTgPostProfiles, kTgPostProfiles - 0.001)) - 0.0625) / 0.875);
}

// Place in view space, mm, of what a depth buffer holds. mm: of a unit of view space.
float3 tgPostUnproject(float2 uv, float depth, float4x4 fromPicture, float mm)
{
    float4 place = mul(float4(uv, depth, 1.0), fromPicture);
    return place.xyz * (mm / place.w);
}

// Places by their z in view space: origin + z * ray, both linear in uv.
struct TgPostView
{
    float3 origin, originU, originV;
    float3 ray, rayU, rayV;
};

// Two depths that every convention has at finite distances.
static const float2 kTgPostDepths = float2(0.25, 0.75);

float3 tgPostRay(float3 one, float3 other)
{
    return (other - one) / (other.z - one.z);
}

TgPostView tgPostView(float4x4 fromPicture, float mm)
{
    float3 a = tgPostUnproject(float2(0.0, 0.0), kTgPostDepths.x, fromPicture, mm);
    float3 u = tgPostUnproject(float2(1.0, 0.0), kTgPostDepths.x, fromPicture, mm);
    float3 v = tgPostUnproject(float2(0.0, 1.0), kTgPostDepths.x, fromPicture, mm);
    TgPostView view;
    view.ray = tgPostRay(a, tgPostUnproject(float2(0.0, 0.0), kTgPostDepths.y, fromPicture, mm));
    float3 rayU = tgPostRay(u, tgPostUnproject(float2(1.0, 0.0), kTgPostDepths.y, fromPicture, mm));
    float3 rayV = tgPostRay(v, tgPostUnproject(float2(0.0, 1.0), kTgPostDepths.y, fromPicture, mm));
    view.origin = a - a.z * view.ray;
    view.originU = u - u.z * rayU - view.origin;
    view.originV = v - v.z * rayV - view.origin;
    view.rayU = rayU - view.ray;
    view.rayV = rayV - view.ray;
    return view;
}

float3 tgPostPlace(TgPostView view, float2 uv, float z)
{
    return view.origin + uv.x * view.originU + uv.y * view.originV + z * (view.ray + uv.x * view.rayU + uv.y * view.rayV);
}

// mm^2 that a step in uv covers on a plane at z that faces the eye.
float tgPostSpread(TgPostView view, float z)
{
    float2 u = view.originU.xy + z * view.rayU.xy;
    float2 v = view.originV.xy + z * view.rayV.xy;
    return abs(u.x * v.y - u.y * v.x);
}

// Change of z to the next pixel, of two neighbours by the one that is nearer; step: mm across a pixel. Where there is none, or it is another
// surface, 0. before, after: z, and 1 for skin.
float tgPostSlope(float2 before, float z, float2 after, float step)
{
    float2 way = float2(before.y > 0.0 ? z - before.x : 1e9, after.y > 0.0 ? after.x - z : 1e9);
    float change = abs(way.x) < abs(way.y) ? way.x : way.y;
    return abs(change) < kTgPostGrazing * step ? change : 0.0;
}

// Ways to the next pixels along the surface: of origin + z ray, changes included. slope: of z, to the right and down.
float3 tgPostTangent(TgPostView view, float2 uv, float z, float2 axis, float slope)
{
    return tgPostPlace(view, uv + axis, z + slope) - tgPostPlace(view, uv, z);
}

// mm^2 of surface in a pixel over those of one that faces the eye. pixel: its size in uv.
float tgPostGrazing(TgPostView view, float z, float2 pixel, float3 right, float3 down)
{
    float facing = tgPostSpread(view, z) * pixel.x * pixel.y;
    return clamp(length(cross(right, down)) / max(facing, 1e-12), 1.0, kTgPostGrazing);
}

// z and whether there is skin, from the prepared map.
float2 tgPostZ(TG_SAMPLER2D_PARAM(depth), float2 uv)
{
    float2 texel = TG_TEX2DLOD(depth, float4(uv, 0.0, 0.0)).xy;
    return float2(texel.x / max(texel.y, 1e-6), step(1e-3, texel.y));
}

// R at a squared distance. gaussians: rows of the table.
float3 tgPostReflectance(float4 gaussians[6], float square)
{
    float3 sum = float3(0.0, 0.0, 0.0);
    [unroll] for (int i = 0; i < 6; i++)
        sum += gaussians[i].rgb * exp2(-square * gaussians[i].w);
    return sum;
}

// Share of the light that leaves within so much (squared).
float3 tgPostShare(float4 gaussians[6], float square)
{
    float3 sum = float3(0.0, 0.0, 0.0);
    [unroll] for (int i = 0; i < 6; i++)
        sum += gaussians[i].rgb * (4.53236014 / gaussians[i].w) * (1.0 - exp2(-square * gaussians[i].w));
    return sum;
}

void tgPostRead(TG_SAMPLER2D_PARAM(profiles), float row, out float4 gaussians[6])
{
    [unroll] for (int i = 0; i < 6; i++)
        gaussians[i] = TG_TEX2DLOD(profiles, float4((i + 0.5) / kTgPostGaussians, (row + 0.5) / kTgPostProfiles, 0.0, 0.0));
}

// Share of samples within a squared distance: the widest channel of each Gaussian, its square root, so that wide and faint ones have some.
float tgPostChance(float4 gaussians[6], float square)
{
    float2 sum = float2(0.0, 1e-9);
    [unroll] for (int i = 0; i < 6; i++)
    {
        float3 weight = gaussians[i].rgb * (4.53236014 / gaussians[i].w);
        float most = sqrt(max(weight.x, max(weight.y, weight.z)));
        sum += most * float2(1.0 - exp2(-square * gaussians[i].w), 1.0);
    }
    return sum.x / sum.y;
}

// Its inverse: a radius, mm.
float tgPostRadius(float4 gaussians[6], float share)
{
    float2 bounds = float2(0.0, 32.0);
    [loop] for (int i = 0; i < 24; i++)
    {
        float middle = 0.5 * (bounds.x + bounds.y);
        bounds = tgPostChance(gaussians, middle * middle) < share ? float2(middle, bounds.y) : float2(bounds.x, middle);
    }
    return 0.5 * (bounds.x + bounds.y);
}

// Texel of the kernels' table.
float4 tgPostTap(float4 gaussians[6], float i, float count)
{
    float inner = tgPostRadius(gaussians, i / count);
    float outer = i + 1.5 < count ? tgPostRadius(gaussians, (i + 1.0) / count) : 32.0;
    float radius = tgPostRadius(gaussians, (i + 0.5) / count);
    float3 share = tgPostShare(gaussians, outer * outer) - tgPostShare(gaussians, inner * inner);
    float area = kTgPi * (min(outer, 2.0 * radius - inner) * min(outer, 2.0 * radius - inner) - inner * inner);
    float3 here = tgPostReflectance(gaussians, radius * radius);
    return float4(min(share / max(here, 1e-9), 4.0 * area), radius);
}

// Squared radius of the first tap.
float tgPostFirst(TG_SAMPLER2D_PARAM(kernels), float row)
{
    float radius = TG_TEX2DLOD(kernels, float4(0.5 / kTgPostSamples, (row + 0.5) / kTgPostProfiles, 0.0, 0.0)).w;
    return radius * radius;
}

// light: light times grazing, and grazing; depth: z times grazing, and grazing; both with levels. uv: a pixel whose z is given;
// right, down: ways to the next pixels of size `pixel`. turn: of the pattern, 0 to 1.
float3 tgPostGather(TG_SAMPLER2D_PARAM(light), TG_SAMPLER2D_PARAM(depth), TG_SAMPLER2D_PARAM(kernels), float4 gaussians[6], float row,
    float count, TgPostView view, float2 uv, float2 pixel, float z, float3 right, float3 down, float turn, float fill)
{
    float3 here = tgPostPlace(view, uv, z);
    float3 normal = cross(right, down);
    float area = length(normal); // mm^2 of surface in the pixel
    normal /= max(area, 1e-12);
    float wide = length(right);
    float3 axisU = right / max(wide, 1e-9);
    float3 axisV = cross(normal, axisU);
    float2 rise = float2(dot(down, axisU), dot(down, axisV));
    float spread = area / (pixel.x * pixel.y);
    float4 centre = TG_TEX2DLOD(light, float4(uv, 0.0, 0.0));
    float3 own = centre.rgb / max(centre.a, 1e-6);
    float3 sum = float3(0.0, 0.0, 0.0);
    float3 total = float3(0.0, 0.0, 0.0);
    float inner = 0.0;
    float merged = kTgPi * tgPostFirst(TG_SAMPLER2D_ARG(kernels), row) < kTgPostOwn * area ? 1.0 : 0.0;
    [loop] for (float i = 0.0; i < count; i += 1.0)
    {
        float4 tap = TG_TEX2DLOD(kernels, float4((i + 0.5) / kTgPostSamples, (row + 0.5) / kTgPostProfiles, 0.0, 0.0));
        // Within a pixel: its own light.
        [branch] if (kTgPi * tap.w * tap.w < kTgPostOwn * area)
            inner = tap.w;
        else
        {
            // From the middle between the last tap within the pixel and the first one outside.
            inner = merged > 0.5 ? 0.5 * (inner + tap.w) : inner;
            merged = 0.0;
            float angle = 2.39996323 * i + 2.0 * kTgPi * turn;
            float2 way = tap.w * float2(cos(angle), sin(angle));
            float2 pixels;
            pixels.y = way.y / rise.y;
            pixels.x = (way.x - pixels.y * rise.x) / wide;
            float2 at = uv + pixels * pixel;
            float level = clamp(0.5 * log2(tap.x / area) - kTgPostFiner, 0.0, kTgPostCoarsest);
            float4 lit = TG_TEX2DLOD(light, float4(at, 0.0, level));
            float2 deep = TG_TEX2DLOD(depth, float4(at, 0.0, level)).xy;
            float there = deep.x / max(deep.y, 1e-6);
            float3 apart = tgPostPlace(view, at, there) - here;
            float bigger = tgPostSpread(view, there) / spread;
            float3 weight = tap.rgb * tgPostReflectance(gaussians, dot(apart, apart)) * bigger;
            sum += weight * lit.rgb;
            total += weight * lit.a;
        }
    }
    float3 mine = tgPostShare(gaussians, inner * inner);
    sum += mine * own;
    total += mine;
    return sum / max(total, 1e-6);
}

#endif
// SPDX-License-Identifier: MIT
