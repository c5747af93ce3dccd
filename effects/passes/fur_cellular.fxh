// Technique Cellular: strands where points of a lattice lie near the skin.
#ifndef TEGUMENT_PASSES_FUR_CELLULAR_FXH
#define TEGUMENT_PASSES_FUR_CELLULAR_FXH

static const float kFurRho = 0.5;           // points that far from the skin still grow a strand, cells
static const float kFurCellDensity = 0.875; // strands per square of a cell: 2 rho, less the shortening near the slab's faces

// The strands of all cells that hold points near enough to the piece.
float4 furCells(float4 met, FurSweep sweep, FurPiece piece)
{
    float3 extent = kFurRho * abs(sweep.normal) + piece.reach * sqrt(saturate(1.0 - sweep.normal * sweep.normal));
    float3 middle = piece.begin + 0.5 * piece.along;
    float3 low = floor(middle - extent);
    float3 high = floor(middle + extent);
    float slab = kFurRho + 0.5 * dot(abs(sweep.normal), 1.0);
    float3 cell = low;
    [loop] for (int i = 0; i < 250 && cell.z <= high.z; i++)
    {
        [branch] if (abs(dot(middle - cell - 0.5, sweep.normal)) < slab)
        {
            float3 residue = tgFurCellResidue(cell);
            float3 root = piece.begin - cell - tgFurUnit(residue);
            float distance = dot(root, sweep.normal);
            root -= sweep.normal * distance;
            float3 away = root + 0.5 * piece.along;
            [branch] if (abs(distance) < kFurRho && dot(away, away) < piece.reach * piece.reach)
            {
                float3 random = tgFurUnit(tgFurMixed(residue));
                float share = max(lerp(gFurShortest, 1.0, random.y) * tgFurNearness(distance, kFurRho), 0.01);
                [branch] if (share > piece.low)
                    met = furMeet(met, sweep, piece, root, share, gFurRadius, 1.0, random);
            }
        }
        cell.x += 1.0;
        cell = cell.x > high.x ? float3(low.x, cell.y + 1.0, cell.z) : cell;
        cell = cell.y > high.y ? float3(low.x, low.y, cell.z + 1.0) : cell;
    }
    return met;
}

StrandsVarying cellularVarying(TgVertexInput input, float layer, float round)
{
    FurGrowth growth;
    growth.spacing = gFurSpacing * gMeshRadius;
    growth.place = furPlace(input) / growth.spacing; // near 0, where cells are numbered exactly
    growth.lean = 0.0;
    growth.density = 1.0;
    growth.shortest = gFurShortest;
    growth.data = 1.0;
    return strandsVarying(input, layer, growth, round);
}

StrandsVarying CellularVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return cellularVarying(input, TG_LAYER_INDEX(gFurLayer), kFurNear);
}

StrandsVarying CellularBehindVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return cellularVarying(input, TG_LAYER_INDEX(gFurLayer), kFurBehind);
}

StrandsVarying CellularEndVS(TgVertexInput input)
{
    StrandsVarying output = cellularVarying(input, gFurLayers - 1.0, kFurNear);
    output.position = furEndPosition(output.position);
    return output;
}

float4 CellularPS(TG_PIXEL_INPUT(StrandsVarying, input)) : SV_Target0
{
    FurSweep sweep = furSweep(input, TG_PIXEL_CENTRE(input));
    FurPiece piece = furFirstPiece();
    float4 met = 0.0;
    // Each turn takes the next place on the way, and from the second on the piece between it and the last one.
    [loop] for (int i = 0; i <= sweep.steps && met.x < kFurOpaque; i++)
    {
        piece = furNextPiece(piece, sweep, i);
        [branch] if (i > 0)
            met = furCells(met, sweep, piece);
    }
    return furStrandColor(input, sweep, piece, met, kFurCellDensity);
}

#endif
// SPDX-License-Identifier: MIT
