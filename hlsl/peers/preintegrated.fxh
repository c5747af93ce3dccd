// Pre-integrated skin shading (Penner and Borshukov, Pre-integrated skin shading, GPU Pro 2, 2011; Penner, SIGGRAPH 2010): light scattered around a ring
// of the surface's own radius, in a table over N.L and curvature.
//   D(theta, rho) = integral of max(cos(theta + x / rho), 0) L(x) dx,   x along the ring, mm
// Corrected: L = the profile's marginal, sum of w_i N(0, v_i), over 10 mm to both sides, as NVIDIA FaceWorks (2014) tabulates it (in 200 steps).
// Printed: the listing of GPU Pro 2, see preintegratedPrinted. The table holds D - max(cos(theta), 0), which is small and has no edge to interpolate over.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SURFACE_NORMAL_FXH
#include "../surface/normal.fxh"
#endif
#ifndef TEGUMENT_PEERS_PREINTEGRATED_FXH
#define TEGUMENT_PEERS_PREINTEGRATED_FXH

// Texels over N.L = -1..1 (odd: one stands on 0) and over the curvature.
static const float2 kPreintegratedSize = float2(257.0, 65.0);
// Per mm: a radius of 2 mm, that of a nostril's wing.
static const float kPreintegratedSharpest = 0.5;
// A flat surface has no ring. 10 m.
static const float kPreintegratedFlattest = 1e-4;
// To one side; shader model 3 loops at most 255 times.
static const int kPreintegratedSteps = 200;
static const float kPreintegratedReach = 10.0;
// What the listing multiplies variances with.
static const float kPrintedVariance = 1.414;
// mm over which light reaches around the edge of a body.
static const float kOwnShadowReach = 10.0;
// N.L at which light grazes the surface.
static const float kEdgeOn = 0.1;

// Sum of weight * N(0, variance) of one Gaussian: rgb weights, w variance.
float3 preintegratedGaussian(float4 gaussian, float distance, float scale)
{
    float variance = max(gaussian.w * scale, 1e-6);
    return gaussian.rgb * (exp(-0.5 * distance * distance / variance) * rsqrt(2.0 * kPi * variance));
}

float3 preintegratedProfile(float4 gaussians[6], float distance, float scale)
{
    float3 sum = float3(0.0, 0.0, 0.0);
    [unroll] for (int i = 0; i < 6; i++)
        sum += preintegratedGaussian(gaussians[i], distance, scale);
    return sum;
}

// Light at both ends of an arc around the angle.
float preintegratedPair(float angle, float arc)
{
    return saturate(cos(angle + arc)) + saturate(cos(angle - arc));
}

// Midpoints of the steps, both sides at once; the profile is 1e-5 at the ends.
float3 preintegratedCorrected(float4 gaussians[6], float angle, float curvature)
{
    float3 sum = float3(0.0, 0.0, 0.0);
    float step = kPreintegratedReach / kPreintegratedSteps;
    [loop] for (int i = 0; i < kPreintegratedSteps; i++)
    {
        float x = (i + 0.5) * step;
        sum += preintegratedPair(angle, x * curvature) * step * preintegratedProfile(gaussians, x, 1.0);
    }
    return sum;
}

// The listing's integral: half a turn, chords 2 rho sin(x / 2), the radial profile's weights on a line, variances times 1.414, normalised. Its steps are
// laid where the profile is, instead of over the whole half turn.
float3 preintegratedPrinted(float4 gaussians[6], float angle, float curvature)
{
    float bent = max(curvature, kPreintegratedFlattest);
    float reach = min(2.0 * asin(min(0.5 * kPreintegratedReach * bent, 1.0)), 0.5 * kPi);
    float3 sum = float3(0.0, 0.0, 0.0);
    float3 total = float3(0.0, 0.0, 0.0);
    [loop] for (int i = 0; i < kPreintegratedSteps; i++)
    {
        float x = (i + 0.5) / kPreintegratedSteps * reach;
        float3 weight = preintegratedProfile(gaussians, 2.0 * sin(0.5 * x) / bent, kPrintedVariance);
        sum += preintegratedPair(angle, x) * weight;
        total += 2.0 * weight;
    }
    return sum / max(total, 1e-20);
}

// What a texel of the table holds. cosine = N.L.
float3 preintegratedTexel(float4 gaussians[6], float cosine, float curvature)
{
    float angle = acos(clamp(cosine, -1.0, 1.0));
    float3 light = kPeersAsPrinted ? preintegratedPrinted(gaussians, angle, curvature) : preintegratedCorrected(gaussians, angle, curvature);
    return light - saturate(cosine);
}

// N.L and curvature of a place in the table, and back.
float2 preintegratedArguments(float2 uv)
{
    float2 place = saturate((uv * kPreintegratedSize - 0.5) / (kPreintegratedSize - 1.0));
    return float2(place.x * 2.0 - 1.0, place.y * kPreintegratedSharpest);
}

float2 preintegratedCoordinate(float cosine, float curvature)
{
    float2 place = saturate(float2(0.5 * cosine + 0.5, curvature / kPreintegratedSharpest));
    return (place * (kPreintegratedSize - 1.0) + 0.5) / kPreintegratedSize;
}

// Per mm, from what neighbouring pixels see. Printed: lengths of the sums of changes. Corrected: mean curvature over the pixel's two directions, hollows 0.
float preintegratedCurvature(float3 normal, float3 world)
{
    float3 nx = ddx(normal);
    float3 ny = ddy(normal);
    float3 px = ddx(world);
    float3 py = ddy(world);
    float printed = length(abs(nx) + abs(ny)) / max(length(abs(px) + abs(py)), 1e-6);
    float corrected = (dot(nx, px) + dot(ny, py)) / max(dot(px, px) + dot(py, py), 1e-12);
    return kPeersAsPrinted ? printed : max(corrected, 0.0);
}

// A bump that is narrower than the diffusion does not show in it: each colour has a normal of its own between the mesh's and the map's. share = what is
// left of it.
float3 preintegratedCosines(float3 meshNormal, float3 normal, float3 toLight, float3 share)
{
    float3 red = safeNormalize(lerp(meshNormal, normal, share.r));
    float3 green = safeNormalize(lerp(meshNormal, normal, share.g));
    float3 blue = safeNormalize(lerp(meshNormal, normal, share.b));
    return float3(dot(red, toLight), dot(green, toLight), dot(blue, toLight));
}

// Light diffused around the ring, of each colour.
float3 preintegratedLight(SAMPLER2D_PARAM(table), float3 cosines, float curvature)
{
    float3 around = float3(tex2Dlod(table, float4(preintegratedCoordinate(cosines.r, curvature), 0.0, 0.0)).r,
                           tex2Dlod(table, float4(preintegratedCoordinate(cosines.g, curvature), 0.0, 0.0)).g,
                           tex2Dlod(table, float4(preintegratedCoordinate(cosines.b, curvature), 0.0, 0.0)).b);
    return max(saturate(cosines) + around, 0.0);
}

// mm by which the body's own front may lie before a point that has turned away from the light and yet counts as lit: the chord of its ring, and a quarter
// for what is not a ring. Without it the shadow map would cut off what the table has brought around. It begins before the terminator, where the map's
// texels lie edge-on.
float preintegratedTolerance(float cosine, float curvature)
{
    return min(2.5 * max(kEdgeOn - cosine, 0.0) / max(curvature, kPreintegratedFlattest), kOwnShadowReach);
}

#endif
