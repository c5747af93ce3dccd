// Passes of SkinPost over the buffers of an engine: gPostLight, gPostDepth, gPostAlbedo, gPostColor (post_frame.fxh says what they hold).
// Profiles and Kernels make tables, once; Prepare joins light and depth to maps with levels; Diffuse gathers, and writes the picture. With
// TEGUMENT_POST_HALF maps are of half resolution, pass Gather gathers there, and Diffuse adds what a pixel's own light leaves at the pixel.
#ifndef TEGUMENT_PASSES_POST_FXH
#define TEGUMENT_PASSES_POST_FXH

float gPostSamples < UI_SLIDER("Samples", 8.0, 64.0, 1.0) > = 24.0;
float gPostFrame < string UIName = "Frame"; float UIMin = 0.0; float UIMax = 1000000.0;
    string UIHelp = "from 1 on: noise that changes with it, for temporal antialiasing; 0: the same pattern at every pixel"; > = 0.0;
float4x4 gPostFromPicture < string UIName = "From the picture to view space";
    string UIHelp = "(u, v, depth as stored, 1) to view space, row vectors; all 0: of this project's projection"; > = {
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
float4 gPostTone[16] < string UIName = "Skins";
    string UIHelp = "of each profile: melanin, blood (0: gGaussianWeight or gMelanin), scale of its widths"; > = {
    POST_TONE, POST_TONE, POST_TONE, POST_TONE, POST_TONE, POST_TONE, POST_TONE, POST_TONE,
    POST_TONE, POST_TONE, POST_TONE, POST_TONE, POST_TONE, POST_TONE, POST_TONE, POST_TONE };

#if TEGUMENT_POST_HALF
#define POST_TARGET(format) float2 ViewportRatio = { 0.5, 0.5 }; int MipLevels = 0; string Format = format;
#else
#define POST_TARGET(format) float2 ViewportRatio = { 1.0, 1.0 }; int MipLevels = 0; string Format = format;
#endif
#define POST_TABLE(width) int Width = width; int Height = 16; int MipLevels = 1; string Format = "A16B16G16R16F";
Texture2D gPostProfilesMap : RENDERCOLORTARGET < POST_TABLE(8) >;
Texture2D gPostKernelsMap : RENDERCOLORTARGET < POST_TABLE(64) >;
Texture2D gPostAreaLightMap : RENDERCOLORTARGET < POST_TARGET("A16B16G16R16F") >;
Texture2D gPostAreaDepthMap : RENDERCOLORTARGET < POST_TARGET("G32R32F") >;
TG_SAMPLER2D(gPostProfiles, POINT, CLAMP);
TG_SAMPLER2D(gPostKernels, POINT, CLAMP);
TG_SAMPLER2D(gPostAreaLight, LINEAR, CLAMP);
TG_SAMPLER2D(gPostAreaDepth, LINEAR, CLAMP);
#if TEGUMENT_POST_HALF
Texture2D gPostGatheredMap : RENDERCOLORTARGET < float2 ViewportRatio = { 0.5, 0.5 }; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
TG_SAMPLER2D(gPostGathered, POINT, CLAMP);
#endif

float4 postGaussian(int k, float4 tone)
{
    float4 gaussian = profileGaussian(k);
    [branch] if (tone.x > 0.0)
        gaussian = float4(tgToneWeight(k, tone.x, tone.y) / tgToneAlbedo(gMapMelanin, gMapBlood), kTgToneVariance[k]);
    return float4(gaussian.rgb, gaussian.w * tone.z * tone.z);
}

float4 PostProfilesPS(TgQuadVarying input) : SV_Target0
{
    float i = floor(input.uv.x * kTgPostGaussians);
    float row = floor(input.uv.y * kTgPostProfiles);
    float4 tone = gPostTone[0];
    [unroll] for (int r = 1; r < 16; r++)
        tone = row == r ? gPostTone[r] : tone;
    float4 gaussian = float4(0.0, 0.0, 0.0, 1.0);
    [unroll] for (int k = 0; k < 6; k++)
        gaussian = i == k ? postGaussian(k, tone) : gaussian;
    return tgPostStored(gaussian);
}

float4 PostKernelsPS(TgQuadVarying input) : SV_Target0
{
    float4 gaussians[6];
    tgPostRead(TG_SAMPLER2D_ARG(gPostProfiles), floor(input.uv.y * kTgPostProfiles), gaussians);
    return tgPostTap(gaussians, floor(input.uv.x * kTgPostSamples), gPostSamples);
}

float4x4 postFromPicture()
{
    float4x4 m = gPostFromPicture;
    return dot(m[3], m[3]) + dot(m[2], m[2]) > 0.0 ? m : postFrameFromPicture();
}

// z of the engine's depth buffer, and the share of a pixel's area that counts.
float2 postDepth(float2 uv, float4x4 fromPicture)
{
    float depth = tex2Dlod(gPostDepth, float4(uv, 0.0, 0.0)).x;
    float mask = tex2Dlod(gPostLight, float4(uv, 0.0, 0.0)).a;
    return float2(tgPostUnproject(uv, depth, fromPicture, tgMillimetres(1.0)).z, tgPostCounts(mask));
}

struct PostPrepared
{
    float4 light : SV_Target0;
    float4 depth : SV_Target1;
};

#if TEGUMENT_POST_HALF
// Mean change of z over two pairs of pixels, of those that both count and lie on one surface.
float postPairs(float2 before, float2 after, float2 countsBefore, float2 countsAfter, float most)
{
    float2 change = after - before;
    float2 usable = step(1e-3, countsBefore) * step(1e-3, countsAfter) * step(abs(change), most);
    return dot(change, usable) / max(dot(usable, 1.0), 1.0);
}

// Means over the four pixels of a texel of the prepared maps.
PostPrepared PostPrepareHalfPS(TgQuadVarying input)
{
    float2 pixel = 0.5 / gViewportSize;
    float4x4 fromPicture = postFromPicture();
    TgPostView view = tgPostView(fromPicture, tgMillimetres(1.0));
    float3 light = float3(0.0, 0.0, 0.0);
    float4 z = float4(0.0, 0.0, 0.0, 0.0);
    float4 counts = float4(0.0, 0.0, 0.0, 0.0);
    [unroll] for (int i = 0; i < 4; i++)
    {
        float2 uv = input.uv + (float2(i % 2, i / 2) - 0.5) * pixel;
        float4 texel = tex2Dlod(gPostLight, float4(uv, 0.0, 0.0));
        z[i] = tgPostUnproject(uv, tex2Dlod(gPostDepth, float4(uv, 0.0, 0.0)).x, fromPicture, tgMillimetres(1.0)).z;
        counts[i] = tgPostCounts(texel.a);
        float3 albedo = tex2Dlod(gPostAlbedo, float4(uv, 0.0, 0.0)).rgb;
        light += counts[i] < 1.0 ? float3(0.0, 0.0, 0.0) : texel.rgb * tgIrradianceColour(albedo, gMix);
    }
    PostPrepared output;
    output.light = 0.0;
    output.depth = 0.0;
    float count = dot(counts, 1.0);
    [branch] if (count > 0.0)
    {
        float mean = dot(z, counts) / count;
        float most = kTgPostGrazing * sqrt(tgPostSpread(view, mean) * pixel.x * pixel.y);
        float2 slope = 2.0 * float2(postPairs(z.xz, z.yw, counts.xz, counts.yw, most), postPairs(z.xy, z.zw, counts.xy, counts.zw, most));
        float grazing = 0.25 * tgPostGrazing(view, input.uv, 2.0 * pixel, mean, slope);
        output.light = float4(light, count) * grazing;
        output.depth = float4(mean * count, count, 0.0, 0.0) * grazing;
    }
    return output;
}

#else
PostPrepared PostPreparePS(TgQuadVarying input)
{
    float2 uv = input.uv;
    float2 pixel = 1.0 / gViewportSize;
    float4x4 fromPicture = postFromPicture();
    float2 here = postDepth(uv, fromPicture);
    PostPrepared output;
    output.light = 0.0;
    output.depth = 0.0;
    [branch] if (here.y > 0.0)
    {
        TgPostView view = tgPostView(fromPicture, tgMillimetres(1.0));
        float2 u = float2(pixel.x, 0.0);
        float2 v = float2(0.0, pixel.y);
        float2 slope = float2(tgPostSlope(view, pixel, postDepth(uv - u, fromPicture), here.x, postDepth(uv + u, fromPicture)),
                              tgPostSlope(view, pixel, postDepth(uv - v, fromPicture), here.x, postDepth(uv + v, fromPicture)));
        float area = here.y * tgPostGrazing(view, uv, pixel, here.x, slope);
        float3 albedo = tex2Dlod(gPostAlbedo, float4(uv, 0.0, 0.0)).rgb;
        float3 light = tex2Dlod(gPostLight, float4(uv, 0.0, 0.0)).rgb * tgIrradianceColour(albedo, gMix);
        output.light = float4(here.y < 1.0 ? float3(0.0, 0.0, 0.0) : light * area, area);
        output.depth = float4(here.x * area, area, 0.0, 1.0);
    }
    return output;
}

#endif

// pixel: of the prepared maps.
TgPostDisc postDisc(TgPostView view, float2 uv, float2 pixel)
{
    float2 u = float2(pixel.x, 0.0);
    float2 v = float2(0.0, pixel.y);
    float z = tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv).x;
    float2 slope = float2(tgPostSlope(view, pixel, tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv - u), z,
                                      tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv + u)),
                          tgPostSlope(view, pixel, tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv - v), z,
                                      tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), uv + v)));
    TgPostDisc disc = tgPostDisc(view, uv, pixel, z, slope);
    disc.coarsest -= TEGUMENT_POST_HALF; // level 0 is level 1 of maps of the picture's resolution
    return disc;
}

float postTurn(float2 uv)
{
    return gPostFrame > 0.0 ? tgScreenNoise(floor(uv * gViewportSize) + kTgPostFrameStep * gPostFrame) : 0.0;
}

// light: a texel of the engine's. Light that enters at the pixel, and what diffusion makes of it, by strength.
float3 postEntering(float4 light, float3 albedo)
{
    return light.rgb * tgIrradianceColour(albedo, gMix);
}

float3 postLeaving(float4 light, float4 albedo, float3 diffused)
{
    float3 mixed = lerp(postEntering(light, albedo.rgb), diffused, tgPostStrength(light.a));
    return mixed * tgIrradianceColour(albedo.rgb, 1.0 - gMix) * albedo.a;
}

#if TEGUMENT_POST_HALF
// Largest of the four pixels around the middle of a texel.
float postMask(float2 uv)
{
    float2 aside = 0.25 / gViewportSize;
    float2 above = float2(tex2Dlod(gPostLight, float4(uv - aside, 0.0, 0.0)).a,
                          tex2Dlod(gPostLight, float4(uv.x + aside.x, uv.y - aside.y, 0.0, 0.0)).a);
    float2 below = float2(tex2Dlod(gPostLight, float4(uv.x - aside.x, uv.y + aside.y, 0.0, 0.0)).a,
                          tex2Dlod(gPostLight, float4(uv + aside, 0.0, 0.0)).a);
    float2 most = max(above, below);
    return max(most.x, most.y);
}

float4 PostGatherPS(TgQuadVarying input) : SV_Target0
{
    float mask = postMask(input.uv);
    float4 beyond = float4(0.0, 0.0, 0.0, 0.0);
    [branch] if (tgPostCounts(mask) >= 1.0)
    {
        TgPostView view = tgPostView(postFromPicture(), tgMillimetres(1.0));
        float row = tgPostProfile(mask);
        float4 gaussians[6];
        tgPostRead(TG_SAMPLER2D_ARG(gPostProfiles), row, gaussians);
        TgPostDisc disc = postDisc(view, input.uv, 1.0 / gViewportSize);
        beyond = tgPostBeyond(tgPostSums(TG_SAMPLER2D_ARG(gPostAreaLight), TG_SAMPLER2D_ARG(gPostAreaDepth), TG_SAMPLER2D_ARG(gPostKernels),
                                         gaussians, row, gPostSamples, view, disc, postTurn(input.uv)), gaussians);
    }
    return beyond;
}

// Of what is gathered around the pixel, from texels on its surface; beside no such texel, the pixel's own light.
float3 postDiffused(float2 uv, float4 light, float3 own)
{
    float4x4 fromPicture = postFromPicture();
    TgPostView view = tgPostView(fromPicture, tgMillimetres(1.0));
    float2 pixel = 1.0 / max(floor(0.5 * gViewportSize), 1.0); // of the prepared maps
    float z = postDepth(uv, fromPicture).x;
    float most = kTgPostGrazing * sqrt(tgPostSpread(view, z) * pixel.x * pixel.y);
    float2 texel = uv / pixel - 0.5;
    float2 part = frac(texel);
    float2 corner = (floor(texel) + 0.5) * pixel;
    float4 sum = float4(0.0, 0.0, 0.0, 0.0);
    float weights = 1e-6;
    [unroll] for (int i = 0; i < 4; i++)
    {
        float2 at = corner + float2(i % 2, i / 2) * pixel;
        float4 beyond = tex2Dlod(gPostGathered, float4(at, 0.0, 0.0));
        float2 there = tgPostZ(TG_SAMPLER2D_ARG(gPostAreaDepth), at);
        float2 share = i == 0 ? 1.0 - part : i == 1 ? float2(part.x, 1.0 - part.y) : i == 2 ? float2(1.0 - part.x, part.y) : part;
        float weight = share.x * share.y * step(0.5, beyond.a) * (abs(there.x - z) < most ? 1.0 : 0.001);
        sum += weight * beyond;
        weights += weight;
    }
    sum /= weights;
    float4 gaussians[6];
    tgPostRead(TG_SAMPLER2D_ARG(gPostProfiles), tgPostProfile(light.a), gaussians);
    return weights > 1e-5 ? sum.rgb + tgPostShare(gaussians, max(sum.a - 1.0, 0.0)) * own : own;
}
#else
float3 postDiffused(float2 uv, float4 light, float3 own)
{
    TgPostView view = tgPostView(postFromPicture(), tgMillimetres(1.0));
    float row = tgPostProfile(light.a);
    float4 gaussians[6];
    tgPostRead(TG_SAMPLER2D_ARG(gPostProfiles), row, gaussians);
    TgPostDisc disc = postDisc(view, uv, 1.0 / gViewportSize);
    return tgPostGather(TG_SAMPLER2D_ARG(gPostAreaLight), TG_SAMPLER2D_ARG(gPostAreaDepth), TG_SAMPLER2D_ARG(gPostKernels), gaussians, row,
                        gPostSamples, view, disc, own, postTurn(uv));
}
#endif

// The engine's picture with the light that leaves the skin.
float4 postPicture(float2 uv)
{
    float4 colour = tex2Dlod(gPostColor, float4(uv, 0.0, 0.0));
    float4 light = tex2Dlod(gPostLight, float4(uv, 0.0, 0.0));
    [branch] if (tgPostCounts(light.a) >= 1.0)
    {
        float4 albedo = tex2Dlod(gPostAlbedo, float4(uv, 0.0, 0.0));
        colour.rgb += postLeaving(light, albedo, postDiffused(uv, light, postEntering(light, albedo.rgb)));
    }
    return colour;
}

float4 PostDiffusePS(TgQuadVarying input) : SV_Target0
{
    float4 colour = postPicture(input.uv);
    clip(colour.a - 0.5);
    return float4(colour.rgb, 1.0);
}

#define POST_PREPARE_SCRIPT \
    "RenderColorTarget0=gPostProfilesMap; Pass=Profiles;" \
    "RenderColorTarget0=gPostKernelsMap; Pass=Kernels;" \
    "RenderColorTarget0=gPostAreaLightMap; RenderColorTarget1=gPostAreaDepthMap; Pass=Prepare; RenderColorTarget1=;"
#define POST_PREPARE_PASSES \
    TG_QUAD_PASS(Profiles, TgQuadVS, PostProfilesPS, TG_STATE_BUFFER) \
    TG_QUAD_PASS(Kernels, TgQuadVS, PostKernelsPS, TG_STATE_BUFFER) \
    TG_QUAD_PASS(Prepare, TgQuadVS, PostPreparePS, TG_STATE_BUFFER)
#if TEGUMENT_POST_HALF
#define POST_GATHER_SCRIPT "RenderColorTarget0=gPostGatheredMap; Pass=Gather;"
#define POST_GATHER_PASS TG_QUAD_PASS(Gather, TgQuadVS, PostGatherPS, TG_STATE_BUFFER)
#define PostPreparePS PostPrepareHalfPS
#else
#define POST_GATHER_SCRIPT
#define POST_GATHER_PASS
#endif
#define POST_SCRIPT POST_PREPARE_SCRIPT POST_GATHER_SCRIPT "RenderColorTarget0=; Pass=Diffuse;"
#define POST_PASSES \
    POST_PREPARE_PASSES \
    POST_GATHER_PASS \
    TG_OVER_PASS(Diffuse, TgQuadVS, PostDiffusePS, TG_STATE_BUFFER)

#endif
// SPDX-License-Identifier: MIT
