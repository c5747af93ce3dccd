// Pass DiffuseTiles of SkinPost: as Diffuse, by tiles. What a tile and its border hold is read once into the group's memory; samples of the
// finest level within it are taken from there, all others from the maps. Pass Compose writes the picture.
#ifndef TEGUMENT_PASSES_POST_COMPUTE_FXH
#define TEGUMENT_PASSES_POST_COMPUTE_FXH

Texture2D gPostDiffusedMap : RENDERCOLORTARGET < PICTURE_TARGET("A32B32G32R32F") >;
TG_SAMPLER2D(gPostDiffused, POINT, CLAMP);

float4 PostComposePS(TgQuadVarying input) : SV_Target0
{
    float4 colour = tex2Dlod(gPostColor, float4(input.uv, 0.0, 0.0));
    clip(colour.a - 0.5);
    float4 light = tex2Dlod(gPostLight, float4(input.uv, 0.0, 0.0));
    float3 diffused = tex2Dlod(gPostDiffused, float4(input.uv, 0.0, 0.0)).rgb;
    if (tgPostCounts(light.a) >= 1.0)
        colour.rgb += postLeaving(light, tex2Dlod(gPostAlbedo, float4(input.uv, 0.0, 0.0)), diffused);
    return float4(colour.rgb, 1.0);
}

#ifdef TEGUMENT_COMPUTE
TG_STORE2D(gPostDiffusedStore)

// Pixels along a tile, beside it, and both.
#define POST_TILE 16
#define POST_BORDER 4
#define POST_SIDE 24
groupshared float4 gPostTileLight[POST_SIDE * POST_SIDE];
groupshared float2 gPostTileDepth[POST_SIDE * POST_SIDE];

// Of a tile whose first texel, border included, is `first`: at a place in texels, as a look-up with LINEAR has it.
void postTile(float2 at, int2 first, out float4 light, out float2 depth)
{
    float2 texel = at - 0.5;
    float2 part = frac(texel);
    int2 corner = int2(floor(texel)) - first;
    int i = corner.y * POST_SIDE + corner.x;
    light = lerp(lerp(gPostTileLight[i], gPostTileLight[i + 1], part.x),
                 lerp(gPostTileLight[i + POST_SIDE], gPostTileLight[i + POST_SIDE + 1], part.x), part.y);
    depth = lerp(lerp(gPostTileDepth[i], gPostTileDepth[i + 1], part.x),
                 lerp(gPostTileDepth[i + POST_SIDE], gPostTileDepth[i + POST_SIDE + 1], part.x), part.y);
}

void postFill(int2 first, uint inGroup, float2 pixel)
{
    [loop] for (uint k = inGroup; k < POST_SIDE * POST_SIDE; k += POST_TILE * POST_TILE)
    {
        float2 uv = (float2(first + int2(k % POST_SIDE, k / POST_SIDE)) + 0.5) * pixel;
        gPostTileLight[k] = tex2Dlod(gPostAreaLight, float4(uv, 0.0, 0.0));
        gPostTileDepth[k] = tex2Dlod(gPostAreaDepth, float4(uv, 0.0, 0.0)).xy;
    }
    GroupMemoryBarrierWithGroupSync();
}

// size: texels of the prepared maps.
float3 postTiled(float4 gaussians[6], float row, TgPostView view, TgPostDisc disc, float3 own, float turn, int2 first, float2 size)
{
    TgPostSum sum = (TgPostSum)0;
    float2 way = tgPostFirst(turn);
    [loop] for (float i = 0.0; i < gPostSamples; i += 1.0)
    {
        float4 tap = tgPostTapOf(TG_SAMPLER2D_ARG(gPostKernels), row, i);
        [branch] if (tgPostWithin(disc, tap))
            sum.inner = tap.w;
        else
        {
            float3 target = tgPostTarget(disc, tap, way);
            float2 place = target.xy * size - first;
            float4 lit;
            float2 deep;
            [branch] if (target.z <= 0.0 && all(place > 0.5) && all(place < POST_SIDE - 1.0))
                postTile(target.xy * size, first, lit, deep);
            else
            {
                lit = tex2Dlod(gPostAreaLight, float4(target.xy, 0.0, target.z));
                deep = tex2Dlod(gPostAreaDepth, float4(target.xy, 0.0, target.z)).xy;
            }
            tgPostAdd(sum, view, disc, gaussians, tap, target.xy, lit, deep);
        }
        way = tgPostNext(way);
    }
    return tgPostMean(sum, gaussians, own);
}

[numthreads(POST_TILE, POST_TILE, 1)]
void PostDiffuseTilesCS(uint3 tile : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint inGroup : SV_GroupIndex)
{
    float2 size = gViewportSize / kPostScale;
    // The middle of a tile in the prepared maps lies in the middle of what is kept.
    int2 first = int2(floor((float2(tile.xy) * POST_TILE) / kPostScale)) - POST_BORDER;
    postFill(first, inGroup, 1.0 / size);
    float2 uv = (float2(thread.xy) + 0.5) / gViewportSize;
    float4 light = tex2Dlod(gPostLight, float4(uv, 0.0, 0.0));
    float3 diffused = float3(0.0, 0.0, 0.0);
    [branch] if (tgPostCounts(light.a) >= 1.0 && all(uv < 1.0))
    {
        TgPostView view = tgPostView(postFromPicture(), tgMillimetres(1.0));
        float row = tgPostProfile(light.a);
        float4 gaussians[6];
        tgPostRead(TG_SAMPLER2D_ARG(gPostProfiles), row, gaussians);
        float3 own = postEntering(light, tex2Dlod(gPostAlbedo, float4(uv, 0.0, 0.0)).rgb);
        diffused = postTiled(gaussians, row, view, postDisc(view, uv, 1.0 / size), own, postTurn(uv), first, size);
    }
    gPostDiffusedStore[thread.xy] = float4(diffused, 1.0);
}
#endif

#define POST_COMPUTE_SCRIPT POST_PREPARE_SCRIPT "RenderColorTarget0=gPostDiffusedMap; Pass=DiffuseTiles; RenderColorTarget0=; Pass=Compose;"
#define POST_COMPUTE_PASSES \
    POST_PREPARE_PASSES \
    TG_COMPUTE_PASS(DiffuseTiles, PostDiffuseTilesCS, "gPostDiffusedMap") \
    TG_OVER_PASS(Compose, TgQuadVS, PostComposePS, TG_STATE_BUFFER)

#endif
// SPDX-License-Identifier: MIT
