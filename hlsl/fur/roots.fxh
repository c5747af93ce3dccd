// Roots in a texture (`tegument fur roots` writes it, docs/design/fur.md "Roots"): RGBA32F, kTgFurRootsWidth texels wide, addressed by
// whole numbers. A grid of bricks of cells leads from a place to the list of the roots near it; 0 means none.
#ifndef TEGUMENT_PLATFORM_FXH
#include "../platform.fxh"
#endif
#ifndef TEGUMENT_FUR_ROOTS_FXH
#define TEGUMENT_FUR_ROOTS_FXH

static const float kTgFurRootsWidth = 4096.0;

// A place of the mesh that is drawn, where the roots' mesh has it: whatever the unit of either, and wherever a world matrix has put it.
// fromCentre: of the bounding ball, along the mesh's own axes; radius: of that ball, in the same unit; ball: centre and radius of the
// roots' mesh, mm.
float3 tgFurRootPlace(float3 fromCentre, float radius, float4 ball)
{
    return ball.xyz + fromCentre * (ball.w / max(radius, 1e-20));
}

// Where texel number `index` is. Powers of two and whole numbers below 2^24: exact, but for the quotient by the rows, which stays in the
// row's middle.
float2 tgFurTexel(float index, float rows)
{
    float row = index / kTgFurRootsWidth;
    float column = frac(row);
    return float2(column + 0.5 / kTgFurRootsWidth, (row - column) * (1.0 / rows) + 0.5 / rows);
}

// Number `q` (0 to 3) of four.
float tgFurPick(float4 four, float q)
{
    return dot(four, saturate(1.0 - abs(q - float4(0.0, 1.0, 2.0, 3.0))));
}

// Number of a cell among all of a box of them. count: along each axis.
float tgFurCellNumber(float3 cell, float3 count)
{
    return cell.x + count.x * (cell.y + count.y * cell.z);
}

// Number `index` of a table that begins at texel `first`, four to a texel.
float tgFurTable(TG_SAMPLER2D_PARAM(roots), float rows, float first, float index)
{
    float texel = floor(index * 0.25);
    return tgFurPick(TG_TEX2DLOD(roots, float4(tgFurTexel(first + texel, rows), 0.0, 0.0)), index - 4.0 * texel);
}

// A brick of cells, and where in it a place lies.
struct TgFurBrick
{
    float address; // of its table in the texture, 0: none
    float3 cell;   // whole numbers
    float3 place;  // cells from its corner
};

// The brick around a place; beyond the grid that of its nearest cell. origin: of the grid, and its cells' side; bricks: along each axis,
// and cells along a brick's side; rows: of the texture, and address of the table of bricks.
TgFurBrick tgFurBrick(TG_SAMPLER2D_PARAM(roots), float3 place, float4 origin, float4 bricks, float2 rows)
{
    TgFurBrick brick;
    float3 cells = clamp((place - origin.xyz) / origin.w, 0.0, bricks.w * bricks.xyz - 0.5);
    brick.cell = floor(cells);
    float3 number = floor((brick.cell + 0.5) / bricks.w);
    brick.address = TG_TEX2DLOD(roots, float4(tgFurTexel(rows.y + tgFurCellNumber(number, bricks.xyz), rows.x), 0.0, 0.0)).x;
    brick.cell -= bricks.w * number;
    brick.place = cells - bricks.w * number;
    return brick;
}

// Address of the list of roots near a place.
float tgFurRootList(TG_SAMPLER2D_PARAM(roots), float3 place, float4 origin, float4 bricks, float2 rows)
{
    TgFurBrick brick = tgFurBrick(TG_SAMPLER2D_ARG(roots), place, origin, bricks, rows);
    float list = tgFurTable(TG_SAMPLER2D_ARG(roots), rows.x, brick.address, tgFurCellNumber(brick.cell, bricks.www));
    return brick.address > 0.0 ? list : 0.0;
}

// Lean of the coat around a place and its share of the full density of strands: between the nodes of the brick, `between` cells apart,
// which follow its table of cells.
float4 tgFurRootCoat(TG_SAMPLER2D_PARAM(roots), float3 place, float4 origin, float4 bricks, float2 rows, float between)
{
    TgFurBrick brick = tgFurBrick(TG_SAMPLER2D_ARG(roots), place, origin, bricks, rows);
    float nodes = bricks.w / between + 1.0;
    float first = brick.address + 0.25 * bricks.w * bricks.w * bricks.w;
    float3 within = brick.place / between;
    float3 low = min(floor(within), nodes - 2.0);
    float4 sum = 0.0;
    [loop] for (float corner = 0.0; corner < 8.0; corner += 1.0)
    {
        float3 node = low + step(0.5, frac(corner * float3(0.5, 0.25, 0.125))); // its three bits
        float3 weight = 1.0 - abs(within - node);
        sum += weight.x * weight.y * weight.z
            * TG_TEX2DLOD(roots, float4(tgFurTexel(first + tgFurCellNumber(node, float3(nodes, nodes, nodes)), rows.x), 0.0, 0.0));
    }
    return brick.address > 0.0 ? sum : float4(0.0, 0.0, 0.0, 0.0);
}

#endif
// SPDX-License-Identifier: MIT
