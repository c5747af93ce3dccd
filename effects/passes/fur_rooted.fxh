// Technique Roots: strands whose roots `tegument fur roots` has placed.
#ifndef TEGUMENT_PASSES_FUR_ROOTED_FXH
#define TEGUMENT_PASSES_FUR_ROOTED_FXH

static const float kFurMostRoots = 64.0; // of a list: what is nearer than the reach of one cell

// The strands of the list.
float4 furRoots(float4 met, FurSweep sweep, FurPiece piece, FurRootGrid grid, float3 data, float list)
{
    float last = list > 0.0 ? kFurMostRoots : -1.0;
    [loop] for (float i = 0.0; i <= last; i += 1.0)
    {
        float entry = tgFurTable(TG_SAMPLER2D_ARG(gFurRoots), grid.rows.x, list, i);
        last = entry < 0.0 ? i + 3.0 : last;
        float2 texel = tgFurTexel(abs(entry), grid.rows.x);
        float4 place = furRootTexel(texel, 0.0);
        float3 root = piece.begin - place.xyz * data.x;
        root -= sweep.normal * dot(root, sweep.normal);
        float3 away = root + 0.5 * piece.along;
        [branch] if (abs(entry) > 0.0 && dot(away, away) < piece.reach * piece.reach)
        {
            float4 up = furRootTexel(texel, 1.0);
            float4 lean = furRootTexel(texel, 2.0);
            // Roots of an opposite sheet look the other way.
            float share = max(min(dot(up.xyz, sweep.normal), up.w * abs(data.z)), 0.01);
            met = furMeet(met, sweep, piece, root, share, place.w * data.y, dot(lean.xyz, sweep.normal),
                          frac(lean.w * float3(1.0, 256.0, 65536.0)));
        }
    }
    return met;
}

// The roots' mesh has the unit that it was prepared in, and stands where it stood then: the balls of both tell how this one came from it.
StrandsVarying rootsVarying(TgVertexInput input, float layer, float round)
{
    FurRootGrid grid = furRootGrid();
    float4 ball = furRootsHeader(4.0);
    float3 place = tgFurRootPlace(furPlace(input), gMeshRadius, ball);
    float4 coat = tgFurRootCoat(TG_SAMPLER2D_ARG(gFurRoots), place, grid.origin, grid.bricks, grid.rows, furRootsHeader(6.0).y);
    float4 strands = furRootsHeader(3.0);
    FurGrowth growth;
    float spacing = rsqrt(max(strands.w, 1e-10)); // mm
    growth.place = place / spacing;
    growth.lean = coat.xyz - input.normal * dot(coat.xyz, input.normal);
    growth.density = coat.w;
    growth.spacing = spacing * (gMeshRadius / max(ball.w, 1e-10));
    growth.shortest = furRootsHeader(5.0).x;
    growth.data = float3(1.0 / spacing, gFurRadius / strands.y, 1.0 / max(gFurLength * ball.w, 1e-20));
    return strandsVarying(input, layer, growth, round);
}

StrandsVarying RootsVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return rootsVarying(input, TG_LAYER_INDEX(gFurLayer), kFurNear);
}

StrandsVarying RootsBehindVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return rootsVarying(input, TG_LAYER_INDEX(gFurLayer), kFurBehind);
}

StrandsVarying RootsEndVS(TgVertexInput input)
{
    StrandsVarying output = rootsVarying(input, gFurLayers - 1.0, kFurNear);
    output.position = furEndPosition(output.position);
    return output;
}

float4 RootsPS(TG_PIXEL_INPUT(StrandsVarying, input)) : SV_Target0
{
    FurRootGrid grid = furRootGrid();
    FurSweep sweep = furSweep(input, TG_PIXEL_CENTRE(input));
    FurPiece piece = furFirstPiece();
    float4 met = 0.0;
    // As in CellularPS.
    [loop] for (int i = 0; i <= sweep.steps; i++)
    {
        piece = furNextPiece(piece, sweep, i);
        float3 middle = (piece.begin + 0.5 * piece.along) / strandsData(input).x;
        [branch] if (i > 0)
        {
            float list = tgFurRootList(TG_SAMPLER2D_ARG(gFurRoots), middle, grid.origin, grid.bricks, grid.rows);
            met = furRoots(met, sweep, piece, grid, strandsData(input), list);
        }
    }
    return furStrandColor(input, sweep, piece, met, 1.0);
}

#endif
// SPDX-License-Identifier: MIT
