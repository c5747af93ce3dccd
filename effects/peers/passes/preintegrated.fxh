// Pass Final of pre-integrated shading.
#ifndef TEGUMENT_PEERS_PASSES_PREINTEGRATED_FXH
#define TEGUMENT_PEERS_PASSES_PREINTEGRATED_FXH

float3 gBumpShare < UI_COLOUR("Bumps left in each colour") float UIMin = 0.0; float UIMax = 1.0;
    string UIHelp = "what diffusion leaves of a wave of 1 mm, the size of pores"; > = { 0.247, 0.536, 0.705 };
float gPenumbraRadius < UI_SLIDER("Reach at shadow edges", 0.1, 20.0, 0.1) string UIHelp = "mm"; > = 5.0;

Texture2D gPreintegratedMap < string Producer = "PreintegratedTable.fx/gPreintegratedMap"; string ResourceName = "preintegrated.dds"; >;
TG_SAMPLER2D(gPreintegrated, LINEAR, CLAMP);

// mm in the unit of the shadow map's depth.
float inDepth(float length)
{
    return kTgDepthInMillimetres ? length : length / max(tgMillimetres(gLightFar - gLightNear), 1.0);
}

// Share of light within gPenumbraRadius on the surface.
float lightAround(LitPoint p, float tolerance, float2 pixel)
{
    float3 side = tgSafeNormalize(cross(p.meshNormal, abs(dot(p.meshNormal, p.axisY)) < 0.9 ? p.axisY : p.axisX));
    float3 axisU = tgPenumbraAxis(gPenumbraRadius * side, p.axisX, p.axisY, p.toLight, p.footprint);
    float3 axisV = tgPenumbraAxis(gPenumbraRadius * cross(p.meshNormal, side), p.axisX, p.axisY, p.toLight, p.footprint);
    axisU.z = inDepth(axisU.z);
    axisV.z = inDepth(axisV.z);
    return tgPenumbraShare(TG_SAMPLER2D_ARG(gShadow), p.lightUv, p.depth - tolerance, axisU, axisV, inDepth(gPenumbraRadius),
                         tgScreenNoise(pixel));
}

// Shadow without the body's own horizon, which the table has scattered light across. Sharp: as in Main.fx.
float3 receivedLight(LitPoint p, float curvature, float2 pixel, bool penumbra)
{
    float2 slope = tgShadowSlope(p.meshNormal, p.axisX, p.axisY, p.toLight, p.footprint);
    float tolerance = gShadowTolerance + inDepth(tgPreintegratedTolerance(dot(p.meshNormal, p.toLight), curvature));
    float sharp = tgShadowTest(TG_SAMPLER2D_ARG(gShadow), p.lightUv, p.depth, tolerance, slope);
    if (!penumbra)
        return float3(sharp, sharp, sharp);
    float share = lightAround(p, tolerance + abs(slope.x) + abs(slope.y), pixel);
    return tgPenumbraShadow(gGaussianWeight, sharp, share, gPenumbraRadius);
}

float4 preintegrated(SurfaceVarying input, bool penumbra)
{
    LitPoint p = peerPoint(input);
    p.shadow = surfaceShadow(TG_SAMPLER2D_ARG(gShadow), p);
    float curvature = tgPreintegratedCurvature(p.meshNormal, tgMillimetres(input.world));
    float3 cosines = tgPreintegratedCosines(p.meshNormal, p.normal, p.toLight, gBumpShare);
    float4 clip = mul(float4(input.world, 1.0), gViewProjection);
    float3 received = receivedLight(p, curvature, clip.xy / clip.w * gViewportSize * 0.5, penumbra);
    float3 around = tgPreintegratedLight(TG_SAMPLER2D_ARG(gPreintegrated), cosines, curvature);
    float3 entering = tgIrradianceColour(p.albedo, gMix) * p.light * around * received * diffuseShare(p.cosine);
    return peerRadiance(input, p, WITH_MORE_LIGHT_HERE(entering, moreEntering(p)));
}

float4 PreintegratedPS(SurfaceVarying input) : SV_Target0
{
    return preintegrated(input, false);
}

float4 PreintegratedPenumbraPS(SurfaceVarying input) : SV_Target0
{
    return preintegrated(input, true);
}

#if TEGUMENT_LIGHT_BY_LIGHT
// The table scatters the workspace's light alone.
LitShare PreintegratedShare(SurfaceVarying input)
{
    return skinShare(peerPoint(input), 1.0);
}
#endif
LIGHTS(Preintegrated, SurfaceVarying)

#endif
// SPDX-License-Identifier: MIT
