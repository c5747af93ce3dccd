// Passes Profiles, Kernels, Prepare and Diffuse of SkinPost, over the buffers of an engine (gPostLight, gPostDepth, gPostAlbedo, gPostColor).
#ifndef TEGUMENT_PASSES_POST_FXH
#define TEGUMENT_PASSES_POST_FXH

float gPostSamples < UI_SLIDER("Samples", 8.0, 64.0, 1.0) > = 24.0;
float gPostTurn < UI_SLIDER("Turn from pixel to pixel", 0.0, 1.0, 0.01)
    string UIHelp = "0: the same pattern everywhere; 1 with gPostFrame: for temporal antialiasing"; > = 0.0;
float gPostFrame < string UIName = "Frame"; string UIHelp = "number of the frame: turns the pattern from frame to frame"; > = 0.0;
float gPostFill < string UIWidget = "None"; > = 0.0;

Texture2D gPostProfilesMap : RENDERCOLORTARGET < int Width = 8; int Height = 16; int MipLevels = 1; string Format = "A32B32G32R32F"; >;
Texture2D gPostKernelsMap : RENDERCOLORTARGET < int Width = 64; int Height = 16; int MipLevels = 1; string Format = "A32B32G32R32F"; >;
Texture2D gPostAreaLightMap : RENDERCOLORTARGET < float2 ViewportRatio = { 1.0, 1.0 }; int MipLevels = 0; string Format = "A16B16G16R16F"; >;
Texture2D gPostAreaDepthMap : RENDERCOLORTARGET < float2 ViewportRatio = { 1.0, 1.0 }; int MipLevels = 0; string Format = "G32R32F"; >;
TG_SAMPLER2D(gPostProfiles, POINT, CLAMP);
TG_SAMPLER2D(gPostKernels, POINT, CLAMP);
TG_SAMPLER2D(gPostAreaLight, LINEAR, CLAMP);
TG_SAMPLER2D(gPostAreaDepth, LINEAR, CLAMP);

float4 PostProfilesPS(QuadVarying input) : SV_Target0
{
    float i = floor(input.uv.x * kTgPostGaussians);
    float4 gaussian = float4(0.0, 0.0, 0.0, 1.0);
    [unroll] for (int k = 0; k < 6; k++)
        gaussian = i == k ? profileGaussian(k) : gaussian;
    return float4(gaussian.rgb / (2.0 * kTgPi * gaussian.w), 0.5 * 1.44269504 / gaussian.w);
}

float4 PostKernelsPS(QuadVarying input) : SV_Target0
{
    float4 gaussians[6];
    tgPostRead(TG_SAMPLER2D_ARG(gPostProfiles), floor(input.uv.y * kTgPostProfiles), gaussians);
    return tgPostTap(gaussians, floor(input.uv.x * kTgPostSamples), gPostSamples);
}

float2 depthAt(float2 uv, float4x4 fromPicture)
{
    float depth = tex2Dlod(gPostDepth, float4(uv, 0.0, 0.0)).x;
    float mask = tex2Dlod(gPostLight, float4(uv, 0.0, 0.0)).a;
    return float2(tgPostUnproject(uv, depth, fromPicture, tgMillimetres(1.0)).z, step(1e-3, mask));
}

struct PostPrepared
{
    float4 light : SV_Target0;
    float4 depth : SV_Target1;
};

PostPrepared PostPreparePS(QuadVarying input)
{
    float2 uv = input.uv;
    float2 pixel = 1.0 / gViewportSize;
    float4x4 fromPicture = frameFromPicture();
    TgPostView view = tgPostView(fromPicture, tgMillimetres(1.0));
    float2 here = depthAt(uv, fromPicture);
    PostPrepared output;
    output.light = 0.0;
    output.depth = 0.0;
    [branch] if (here.y > 0.0)
    {
        float2 across = float2(pixel.x, 0.0);
        float2 along = float2(0.0, pixel.y);
        float step = sqrt(tgPostSpread(view, here.x) * pixel.x * pixel.y);
        float2 slope = float2(
            tgPostSlope(depthAt(uv - across, fromPicture), here.x, depthAt(uv + across, fromPicture), step),
            tgPostSlope(depthAt(uv - along, fromPicture), here.x, depthAt(uv + along, fromPicture), step));
        float area = tgPostGrazing(view, here.x, pixel, tgPostTangent(view, uv, here.x, across, slope.x),
                                   tgPostTangent(view, uv, here.x, along, slope.y));
        float3 light = tex2Dlod(gPostLight, float4(uv, 0.0, 0.0)).rgb;
        float3 albedo = tex2Dlod(gPostAlbedo, float4(uv, 0.0, 0.0)).rgb;
        output.light = float4(light * tgIrradianceColour(albedo, gMix) * area, area);
        output.depth = float4(here.x * area, area, 0.0, 1.0);
    }
    return output;
}

float4 PostDiffusePS(QuadVarying input) : SV_Target0
{
    float2 uv = input.uv;
    float4 colour = tex2Dlod(gPostColor, float4(uv, 0.0, 0.0));
    clip(colour.a - 0.5);
    float2 pixel = 1.0 / gViewportSize;
    float4 albedo = tex2Dlod(gPostAlbedo, float4(uv, 0.0, 0.0));
    float4 light = tex2Dlod(gPostLight, float4(uv, 0.0, 0.0));
    float3 diffused = 0.0;
    [branch] if (light.a > 0.0)
    {
        TgPostView view = tgPostView(frameFromPicture(), tgMillimetres(1.0));
        float row = tgPostProfile(light.a);
        float4 gaussians[6];
        tgPostRead(TG_SAMPLER2D_ARG(gPostProfiles), row, gaussians);
        float2 across = float2(pixel.x, 0.0);
        float2 along = float2(0.0, pixel.y);
        float z = tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv).x;
        float step = sqrt(tgPostSpread(view, z) * pixel.x * pixel.y);
        float2 slope = float2(
            tgPostSlope(tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv - across), z, tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv + across), step),
            tgPostSlope(tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv - along), z, tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv + along), step));
        float turn = gPostTurn * tgScreenNoise(floor(uv * gViewportSize) + 5.588238 * gPostFrame);
        diffused = tgPostGather(TG_SAMPLER2D_ARG(gPostAreaLight), TG_SAMPLER2D_ARG(gPostAreaDepth), TG_SAMPLER2D_ARG(gPostKernels), gaussians,
                                row, gPostSamples, view, uv, pixel, z, tgPostTangent(view, uv, z, across, slope.x),
                                tgPostTangent(view, uv, z, along, slope.y), turn, gPostFill);
        float3 own = light.rgb * tgIrradianceColour(albedo.rgb, gMix);
        diffused = lerp(own, diffused, tgPostStrength(light.a)) * tgIrradianceColour(albedo.rgb, 1.0 - gMix) * albedo.a;
    }
    return float4(colour.rgb + diffused, 1.0);
}

#define POST_SCRIPT \
    "RenderColorTarget0=gPostProfilesMap; Pass=Profiles;" \
    "RenderColorTarget0=gPostKernelsMap; Pass=Kernels;" \
    "RenderColorTarget0=gPostAreaLightMap; RenderColorTarget1=gPostAreaDepthMap; Pass=Prepare;" \
    "RenderColorTarget0=; RenderColorTarget1=; Pass=Diffuse;"
#define POST_PASSES \
    TG_QUAD_PASS(Profiles, QuadVS, PostProfilesPS, TG_STATE_BUFFER) \
    TG_QUAD_PASS(Kernels, QuadVS, PostKernelsPS, TG_STATE_BUFFER) \
    TG_QUAD_PASS(Prepare, QuadVS, PostPreparePS, TG_STATE_BUFFER) \
    TG_OVER_PASS(Diffuse, QuadVS, PostDiffusePS, TG_STATE_BUFFER)

#endif
// SPDX-License-Identifier: MIT
