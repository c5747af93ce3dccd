// Compute shaders of SkinPost: as its passes Gather and Diffuse, by tiles. What a tile and its border hold is read once into the group's
// memory; samples of the finest level within it are taken from there, all others from the maps. The last one writes the picture.
#ifndef TEGUMENT_PASSES_POST_COMPUTE_FXH
#define TEGUMENT_PASSES_POST_COMPUTE_FXH

#ifdef TEGUMENT_COMPUTE
TG_STORE_PICTURE(gPostPictureStore)

// Texels along a tile, beside it, and both.
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

void postFill(int2 first, uint inGroup, float2 texel)
{
    [loop] for (uint k = inGroup; k < POST_SIDE * POST_SIDE; k += POST_TILE * POST_TILE)
    {
        float2 uv = (float2(first + int2(k % POST_SIDE, k / POST_SIDE)) + 0.5) * texel;
        gPostTileLight[k] = tex2Dlod(gPostAreaLight, float4(uv, 0.0, 0.0));
        gPostTileDepth[k] = tex2Dlod(gPostAreaDepth, float4(uv, 0.0, 0.0)).xy;
    }
    GroupMemoryBarrierWithGroupSync();
}

// As tgPostSums. size: texels of the prepared maps.
TgPostSum postTiled(float4 gaussians[6], float row, TgPostView view, TgPostDisc disc, float turn, int2 first, float2 size)
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
    return sum;
}

#if TEGUMENT_POST_HALF
TG_STORE2D(gPostGatheredStore)

[numthreads(POST_TILE, POST_TILE, 1)]
void PostGatherTilesCS(uint3 tile : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint inGroup : SV_GroupIndex)
{
    float2 size = gViewportSize;
    int2 first = int2(tile.xy) * POST_TILE - POST_BORDER;
    postFill(first, inGroup, 1.0 / size);
    float2 uv = (float2(thread.xy) + 0.5) / size;
    float mask = postMask(uv);
    float4 beyond = float4(0.0, 0.0, 0.0, 0.0);
    [branch] if (tgPostCounts(mask) >= 1.0 && all(uv < 1.0))
    {
        TgPostView view = tgPostView(postFromPicture(), tgMillimetres(1.0));
        float row = tgPostProfile(mask);
        float4 gaussians[6];
        tgPostRead(TG_SAMPLER2D_ARG(gPostProfiles), row, gaussians);
        beyond = tgPostBeyond(postTiled(gaussians, row, view, postDisc(view, uv, 1.0 / size), postTurn(uv), first, size), gaussians);
    }
    gPostGatheredStore[thread.xy] = beyond;
}

[numthreads(8, 8, 1)]
void PostDiffuseTilesCS(uint3 thread : SV_DispatchThreadID)
{
    float2 uv = (float2(thread.xy) + 0.5) / gViewportSize;
    float4 colour = postPicture(uv);
    [branch] if (colour.a >= 0.5 && all(uv < 1.0))
        gPostPictureStore[thread.xy] = float4(colour.rgb, 1.0);
}
#else
[numthreads(POST_TILE, POST_TILE, 1)]
void PostDiffuseTilesCS(uint3 tile : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint inGroup : SV_GroupIndex)
{
    float2 size = gViewportSize;
    int2 first = int2(tile.xy) * POST_TILE - POST_BORDER;
    postFill(first, inGroup, 1.0 / size);
    float2 uv = (float2(thread.xy) + 0.5) / size;
    float4 colour = tex2Dlod(gPostColor, float4(uv, 0.0, 0.0));
    float4 light = tex2Dlod(gPostLight, float4(uv, 0.0, 0.0));
    [branch] if (tgPostCounts(light.a) >= 1.0)
    {
        TgPostView view = tgPostView(postFromPicture(), tgMillimetres(1.0));
        float row = tgPostProfile(light.a);
        float4 gaussians[6];
        tgPostRead(TG_SAMPLER2D_ARG(gPostProfiles), row, gaussians);
        float4 albedo = tex2Dlod(gPostAlbedo, float4(uv, 0.0, 0.0));
        TgPostSum sum = postTiled(gaussians, row, view, postDisc(view, uv, 1.0 / size), postTurn(uv), first, size);
        colour.rgb += postLeaving(light, albedo, tgPostMean(sum, gaussians, postEntering(light, albedo.rgb)));
    }
    [branch] if (colour.a >= 0.5 && all(uv < 1.0))
        gPostPictureStore[thread.xy] = float4(colour.rgb, 1.0);
}
#endif
#endif

#if TEGUMENT_POST_HALF
#define POST_TILES_SCRIPT "RenderColorTarget0=gPostGatheredMap; Pass=GatherTiles; RenderColorTarget0=; Pass=DiffuseTiles;"
#define POST_TILES_PASSES TG_COMPUTE_PASS(GatherTiles, PostGatherTilesCS, "gPostGatheredMap")
#else
#define POST_TILES_SCRIPT "RenderColorTarget0=; Pass=DiffuseTiles;"
#define POST_TILES_PASSES
#endif
#define POST_COMPUTE_SCRIPT POST_PREPARE_SCRIPT POST_TILES_SCRIPT
#define POST_COMPUTE_PASSES \
    POST_PREPARE_PASSES \
    POST_TILES_PASSES \
    pass DiffuseTiles < string Script = "Draw=Compute;"; string Threads = "gPostColorMap"; > \
    { \
        ComputeShader = compile cs_5_0 PostDiffuseTilesCS(); \
    }

#endif
// SPDX-License-Identifier: MIT
