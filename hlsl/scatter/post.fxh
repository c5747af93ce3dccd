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
// Coarsest level that samples read, of maps of the picture's resolution, and how much finer than their distance it is.
static const float kTgPostCoarsest = 6.0;
static const float kTgPostFiner = 1.0;
// Exponent of a Gaussian's weight in the share of samples that it gets: 1 leaves wide and faint ones too few.
static const float kTgPostEven = 0.4;
// Cosine and sine of pi (3 - sqrt 5), the angle from sample to sample.
static const float2 kTgPostTurn = float2(-0.73736888, 0.67549029);
// Pixels by which noise moves from frame to frame (Jimenez 2014).
static const float kTgPostFrameStep = 5.588238;
// Share of its area with which what covers skin counts: half of the skin below is dark.
static const float kTgPostCovered = 0.5;
// Samples within this share of a pixel's area are the pixel's own light.
static const float kTgPostOwn = 0.5;

// alpha of the light: 0 no skin; profile 0 to 15, strength 0 to 1.
float tgPostMask(float profile, float strength)
{
    return (profile + 0.0625 + 0.875 * saturate(strength)) / kTgPostProfiles;
}

// Of what covers skin, eyes, cloth, hair: dark skin to those around it.
static const float kTgPostCover = 0.001;

// With which share of its area a pixel counts: 1 for skin, less for what covers it.
float tgPostCounts(float mask)
{
    return mask > 2.0 * kTgPostCover ? 1.0 : mask > 0.0 ? kTgPostCovered : 0.0;
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

// Places by their z in view space: origin + z * ray, both linear in uv. z of the rays is 1, z of the origins 0.
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

// Change of z to the next pixel, by the nearer one of two neighbours; where none is near, 0. before, after: z, and above 0 where there is
// a surface.
float tgPostSlope(TgPostView view, float2 pixel, float2 before, float z, float2 after)
{
    float step = sqrt(tgPostSpread(view, z) * pixel.x * pixel.y);
    float2 way = float2(before.y > 0.0 ? z - before.x : 1e9, after.y > 0.0 ? after.x - z : 1e9);
    float change = abs(way.x) < abs(way.y) ? way.x : way.y;
    return abs(change) < kTgPostGrazing * step ? change : 0.0;
}

// Derivative of the place by pixels along the surface: of the ray, and of z along it. way: one pixel, in uv.
float3 tgPostTangent(TgPostView view, float2 uv, float2 way, float z, float slope)
{
    float3 origin = way.x * view.originU + way.y * view.originV;
    float3 aside = way.x * view.rayU + way.y * view.rayV;
    return origin + z * aside + slope * (view.ray + uv.x * view.rayU + uv.y * view.rayV);
}

// mm^2 of surface in a pixel over those of one that faces the eye. slope: of z to the right and down.
float tgPostGrazing(TgPostView view, float2 uv, float2 pixel, float z, float2 slope)
{
    float3 right = tgPostTangent(view, uv, float2(pixel.x, 0.0), z, slope.x);
    float3 down = tgPostTangent(view, uv, float2(0.0, pixel.y), z, slope.y);
    float facing = tgPostSpread(view, z) * pixel.x * pixel.y;
    return clamp(length(cross(right, down)) / max(facing, 1e-12), 1.0, kTgPostGrazing);
}

// z and whether there is skin, from the prepared map.
float2 tgPostZ(TG_SAMPLER2D_PARAM(depth), float2 uv)
{
    float2 texel = TG_TEX2DLOD(depth, float4(uv, 0.0, 0.0)).xy;
    return float2(texel.x / max(texel.y, 1e-6), step(1e-3, texel.y));
}

// Texel of the profiles' table, which halves can hold. gaussian: weight (RGB) and variance, mm^2.
float4 tgPostStored(float4 gaussian)
{
    float variance = max(gaussian.w, 2e-5);
    return float4(gaussian.rgb / (2.0 * kTgPi * variance), 0.5 * 1.44269504 / variance);
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

// Share of samples within a squared distance, by the strongest channel of each Gaussian.
float tgPostChance(float4 gaussians[6], float square)
{
    float2 sum = float2(0.0, 1e-9);
    [unroll] for (int i = 0; i < 6; i++)
    {
        float3 weight = gaussians[i].rgb * (4.53236014 / gaussians[i].w);
        float most = pow(max(max(weight.x, max(weight.y, weight.z)), 1e-9), kTgPostEven);
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

// The disc in the surface's plane at a pixel, over which samples are spread.
struct TgPostDisc
{
    float2 uv;
    float z;
    float2 ray;     // x and y of a step along the view, of z 1
    float3 steps;   // uv of a mm on the disc: u of the first axis, u and v of the second
    float area;     // mm^2 of surface in a pixel
    float share;    // pixel, in uv^2, over area
    float level;    // of a sample that stands for 1 mm^2
    float coarsest; // level that samples read
};

// pixel: its size, in uv; slope: of z to the next one to the right and down.
TgPostDisc tgPostDisc(TgPostView view, float2 uv, float2 pixel, float z, float2 slope)
{
    float3 right = tgPostTangent(view, uv, float2(pixel.x, 0.0), z, slope.x);
    float3 down = tgPostTangent(view, uv, float2(0.0, pixel.y), z, slope.y);
    float3 normal = cross(right, down);
    TgPostDisc disc;
    disc.uv = uv;
    disc.z = z;
    disc.ray = view.ray.xy + uv.x * view.rayU.xy + uv.y * view.rayV.xy;
    disc.area = max(length(normal), 1e-12);
    disc.share = pixel.x * pixel.y / disc.area;
    disc.level = -0.5 * log2(disc.area) - kTgPostFiner;
    disc.coarsest = kTgPostCoarsest;
    float wide = max(length(right), 1e-9);
    float high = disc.area / wide;
    disc.steps = float3(pixel.x / wide, -pixel.x * dot(down, right) / (wide * wide * high), pixel.y / high);
    return disc;
}

// Whether a sample of the table is the pixel's own light.
bool tgPostWithin(TgPostDisc disc, float4 tap)
{
    return kTgPi * tap.w * tap.w < kTgPostOwn * disc.area;
}

// Direction of the first sample. turn: of the pattern, 0 to 1.
float2 tgPostFirst(float turn)
{
    return float2(cos(2.0 * kTgPi * turn), sin(2.0 * kTgPi * turn));
}

// Direction of the next sample.
float2 tgPostNext(float2 way)
{
    return float2(way.x * kTgPostTurn.x - way.y * kTgPostTurn.y, way.x * kTgPostTurn.y + way.y * kTgPostTurn.x);
}

// Where the sample in this direction reads: uv, and the level that is as coarse as the samples are far apart.
float3 tgPostTarget(TgPostDisc disc, float4 tap, float2 way)
{
    float2 at = tap.w * way;
    float2 uv = disc.uv + float2(at.x * disc.steps.x + at.y * disc.steps.y, at.y * disc.steps.z);
    return float3(uv, floor(clamp(0.5 * log2(max(tap.x, 1e-9)) + disc.level, 0.0, disc.coarsest) + 0.5));
}

// The sum over the samples, and over their weights.
struct TgPostSum
{
    float3 light, weight;
    float inner; // radius of what is the pixel's own, mm
    bool outside;
};

// lit, deep: what the two maps hold at target.xy.
void tgPostAdd(inout TgPostSum sum, TgPostView view, TgPostDisc disc, float4 gaussians[6], float4 tap, float2 at, float4 lit, float2 deep)
{
    float there = deep.x / max(deep.y, 1e-6);
    float2 u = view.originU.xy + there * view.rayU.xy;
    float2 v = view.originV.xy + there * view.rayV.xy;
    float2 way = at - disc.uv;
    float deeper = there - disc.z;
    float3 apart = float3(way.x * u + way.y * v + deeper * disc.ray, deeper);
    float bigger = abs(u.x * v.y - u.y * v.x) * disc.share;
    float3 weight = tap.rgb * tgPostReflectance(gaussians, dot(apart, apart)) * bigger;
    sum.light += weight * lit.rgb;
    sum.weight += weight * lit.a;
    // From the middle between the last sample within the pixel and the first one outside.
    sum.inner = !sum.outside && sum.inner > 0.0 ? 0.5 * (sum.inner + tap.w) : sum.inner;
    sum.outside = true;
}

// own: light at the pixel itself.
float3 tgPostMean(TgPostSum sum, float4 gaussians[6], float3 own)
{
    float3 mine = tgPostShare(gaussians, sum.inner * sum.inner);
    return (sum.light + mine * own) / max(sum.weight + mine, 1e-6);
}

float4 tgPostTapOf(TG_SAMPLER2D_PARAM(kernels), float row, float i)
{
    return TG_TEX2DLOD(kernels, float4((i + 0.5) / kTgPostSamples, (row + 0.5) / kTgPostProfiles, 0.0, 0.0));
}

// light: light times grazing, and grazing; depth: z times grazing, and grazing; both with levels, LINEAR. turn: of the pattern, 0 to 1.
TgPostSum tgPostSums(TG_SAMPLER2D_PARAM(light), TG_SAMPLER2D_PARAM(depth), TG_SAMPLER2D_PARAM(kernels), float4 gaussians[6], float row,
    float count, TgPostView view, TgPostDisc disc, float turn)
{
    TgPostSum sum = (TgPostSum)0;
    float2 way = tgPostFirst(turn);
    [loop] for (float i = 0.0; i < count; i += 1.0)
    {
        float4 tap = tgPostTapOf(TG_SAMPLER2D_ARG(kernels), row, i);
        [branch] if (tgPostWithin(disc, tap))
            sum.inner = tap.w;
        else
        {
            float3 target = tgPostTarget(disc, tap, way);
            float4 lit = TG_TEX2DLOD(light, float4(target.xy, 0.0, target.z));
            float2 deep = TG_TEX2DLOD(depth, float4(target.xy, 0.0, target.z)).xy;
            tgPostAdd(sum, view, disc, gaussians, tap, target.xy, lit, deep);
        }
        way = tgPostNext(way);
    }
    return sum;
}

float3 tgPostGather(TG_SAMPLER2D_PARAM(light), TG_SAMPLER2D_PARAM(depth), TG_SAMPLER2D_PARAM(kernels), float4 gaussians[6], float row,
    float count, TgPostView view, TgPostDisc disc, float3 own, float turn)
{
    TgPostSum sum = tgPostSums(TG_SAMPLER2D_ARG(light), TG_SAMPLER2D_ARG(depth), TG_SAMPLER2D_ARG(kernels), gaussians, row, count, view,
                               disc, turn);
    return tgPostMean(sum, gaussians, own);
}

// What comes from beyond the pixel, and the squared radius within which light is the pixel's own, mm^2, plus 1.
float4 tgPostBeyond(TgPostSum sum, float4 gaussians[6])
{
    float square = sum.inner * sum.inner;
    return float4(sum.light / max(sum.weight, 1e-6) * (1.0 - tgPostShare(gaussians, square)), 1.0 + square);
}

#endif
// SPDX-License-Identifier: MIT
