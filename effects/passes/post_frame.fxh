// Pass Frame: what an engine's own frame holds before SkinPost, drawn by this project's light. gPostLightMap: light that crosses into skin,
// without colour, alpha tgPostMask. gPostDepthMap: depth as a depth buffer holds it. gPostAlbedoMap: colour, alpha the share of light that
// leaves towards the eye. gPostColorMap: the engine's picture: reflection, and all that is no skin; alpha 1 where the mesh is.
#ifndef TEGUMENT_PASSES_POST_FRAME_FXH
#define TEGUMENT_PASSES_POST_FRAME_FXH

float4x4 gProjection : PROJECTION < string UIWidget = "None"; >;

float gPostProfile < UI_SLIDER("Profile", 0.0, 15.0, 1.0) string UIHelp = "row of gPostTone, of all skin of this mesh"; > = 0.0;
float gPostStrength < UI_SLIDER("Strength of diffusion", 0.0, 1.0, 0.01) > = 1.0;

#define POST_TONE { 0.0, 0.0, 1.0, 0.0 }

Texture2D gPostLightMap : RENDERCOLORTARGET < PICTURE_TARGET("A16B16G16R16F") >;
Texture2D gPostDepthMap : RENDERCOLORTARGET < PICTURE_TARGET("R32F") >;
Texture2D gPostAlbedoMap : RENDERCOLORTARGET < PICTURE_TARGET("A16B16G16R16F") >;
Texture2D gPostColorMap : RENDERCOLORTARGET < PICTURE_TARGET("A16B16G16R16F") >;
Texture2D gPostTestMap : RENDERDEPTHSTENCILTARGET < PICTURE_DEPTH >;
TG_SAMPLER2D(gPostLight, POINT, CLAMP);
TG_SAMPLER2D(gPostDepth, POINT, CLAMP);
TG_SAMPLER2D(gPostAlbedo, POINT, CLAMP);
TG_SAMPLER2D(gPostColor, POINT, CLAMP);

#define POST_FRAME_SCRIPT \
    LAMPS_SCRIPT SHADOW_MAP_SCRIPT \
    "RenderColorTarget0=gPostLightMap; RenderColorTarget1=gPostDepthMap; RenderColorTarget2=gPostAlbedoMap;" \
    "RenderColorTarget3=gPostColorMap; RenderDepthStencilTarget=gPostTestMap; Clear=Color; Clear=Depth; Pass=Frame;" \
    "RenderColorTarget1=; RenderColorTarget2=; RenderColorTarget3=; RenderDepthStencilTarget=;"
#define POST_FRAME_PASSES \
    LAMPS_PASSES \
    PLANAR_SHADOW_PASS \
    TG_MESH_PASS(Frame, SurfaceVS, PostFramePS, TG_STATE_SOLID)

struct PostFrame
{
    float4 light : SV_Target0;
    float4 depth : SV_Target1;
    float4 albedo : SV_Target2;
    float4 colour : SV_Target3;
};

float postFrameShadow(LitPoint p, float3 facet)
{
    float own = tgShadowPlanarHorizon(dot(p.meshNormal, p.toLight));
    float2 slope = tgShadowPlanarSlope(facet, p.axisX, p.axisY, p.toLight, tgLightRays(), p.footprint);
    float bend = facetBend(p, slope);
    p.meshNormal = facet;
    PlanarPlace at = planarPlace(p, slope, kTgPlanarTexel);
    TgShadowTaps taps = tgShadowTapsOfTexels(at.uv);
    float lit = own * tgShadowTapped(TG_SAMPLER2D_ARG(gShadow), at.uv, at.depth - bend, slope, taps);
    return ownVisibility(p.world, p.meshNormal, lit);
}

PostFrame PostFramePS(SurfaceVarying input)
{
    LitPoint p = surfacePoint(input);
    p.depth = planarDepth(input.lightClip, input.world);
    p.footprint = tgShadowFootprint(input.lightClip.w, tgLightSpread());
    p.shadow = postFrameShadow(p, facetNormal(p, ddx(input.world), ddy(input.world)));
    float4 colour = tex2D(gSkin, input.uv);
    float3 toEye = tgSafeNormalize(gCameraPosition - input.world);
    float skin = step(0.5, colour.a);
    PostFrame output;
    float4 clip = mul(float4(input.world, 1.0), gViewProjection);
    float3 entering = skin * tgIrradianceBounded(enteringLight(p), kTgLargestHalf);
    output.light = float4(entering, skin > 0.0 ? tgPostMask(gPostProfile, gPostStrength) : kTgPostCover);
    output.depth = float4(clip.z / clip.w, 0.0, 0.0, 1.0);
    output.albedo = float4(colour.rgb, diffuseShare(dot(p.normal, toEye)));
    p.albedo = colour.rgb;
    p.scatters = colour.a;
    output.colour = float4((1.0 - skin) * plainLight(p) + mirroredLight(p, toEye), 1.0);
    return output;
}

// From (u, v, depth, 1) of the picture to view space: what an engine multiplies once for a frame.
float4x4 postFrameFromPicture()
{
    float4x4 p = gProjection;
    float across = p[2][2] * p[3][3] - p[3][2] * p[2][3];
    float4 inverse = float4(p[3][3], -p[2][3], -p[3][2], p[2][2]) / across; // of the rows and columns of z and w
    float2 scale = float2(2.0 / p[0][0], -2.0 / p[1][1]);
    float2 left = float2(-1.0 / p[0][0], 1.0 / p[1][1]);
    // x = (clip.x - z p20 - w p30) / p00, where z and w come of the depth and 1.
    float2 z = -float2(p[2][0], p[2][1]) / float2(p[0][0], p[1][1]);
    float2 w = -float2(p[3][0], p[3][1]) / float2(p[0][0], p[1][1]);
    return float4x4(scale.x, 0.0, 0.0, 0.0,
                    0.0, scale.y, 0.0, 0.0,
                    inverse.x * z.x + inverse.y * w.x, inverse.x * z.y + inverse.y * w.y, inverse.x, inverse.y,
                    left.x + inverse.z * z.x + inverse.w * w.x, left.y + inverse.z * z.y + inverse.w * w.y, inverse.z, inverse.w);
}

#endif
// SPDX-License-Identifier: MIT
