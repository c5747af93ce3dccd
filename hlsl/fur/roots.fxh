// Roots in a texture (`tegument fur roots` writes it, docs/fur.md "Roots"): RGBA32F, kFurRootsWidth texels wide, addressed by whole numbers. A grid of bricks of cells leads
// from a place to the list of the roots near it; 0 means none.
#ifndef TEGUMENT_FUR_ROOTS_FXH
#define TEGUMENT_FUR_ROOTS_FXH

static const float kFurRootsWidth = 4096.0;

// Where texel number `index` is. Powers of two and whole numbers below 2^24: exact.
float2 furTexel(float index, float rows)
{
    float row = index / kFurRootsWidth;
    return float2(frac(row) + 0.5 / kFurRootsWidth, (floor(row) + 0.5) / rows);
}

// Number `q` (0 to 3) of four.
float furPick(float4 four, float q)
{
    return dot(four, saturate(1.0 - abs(q - float4(0.0, 1.0, 2.0, 3.0))));
}

// Number of a cell among all of a box of them. count: along each axis.
float furCellNumber(float3 cell, float3 count)
{
    return cell.x + count.x * (cell.y + count.y * cell.z);
}

// Number `index` of a table that begins at texel `first`, four to a texel.
float furTable(SAMPLER2D_PARAM(roots), float rows, float first, float index)
{
    float texel = floor(index * 0.25);
    return furPick(tex2Dlod(roots, float4(furTexel(first + texel, rows), 0.0, 0.0)), index - 4.0 * texel);
}

// Address of the list of roots near a place; beyond the grid that of its nearest cell. origin: of the grid, and its cells' side; bricks: along each axis, and cells
// along a brick's side; rows: of the texture, and address of the table of bricks.
float furRootList(SAMPLER2D_PARAM(roots), float3 place, float4 origin, float4 bricks, float2 rows)
{
    float3 cell = clamp(floor((place - origin.xyz) / origin.w), 0.0, bricks.w * bricks.xyz - 1.0);
    float3 brick = floor((cell + 0.5) / bricks.w);
    float table = tex2Dlod(roots, float4(furTexel(rows.y + furCellNumber(brick, bricks.xyz), rows.x), 0.0, 0.0)).x;
    float list = furTable(SAMPLER2D_ARG(roots), rows.x, table, furCellNumber(cell - bricks.w * brick, bricks.www));
    return table > 0.0 ? list : 0.0;
}

#endif
