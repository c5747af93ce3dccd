// The texture of roots (`tegument fur roots`), and what each shader reads of its first row.
#ifndef TEGUMENT_PASSES_FUR_ROOTS_TEXTURE_FXH
#define TEGUMENT_PASSES_FUR_ROOTS_TEXTURE_FXH

// The first row of the texture, as far as each pixel needs it.
struct FurRootGrid
{
    float4 origin; // mm, mesh space; side of a cell, mm
    float4 bricks; // along each axis; cells along a brick's side
    float2 rows;   // of the texture; address of the table of bricks
};

float4 furRootsHeader(float index)
{
    return tex2Dlod(gFurRoots, float4((index + 0.5) / kTgFurRootsWidth, 0.0, 0.0, 0.0));
}

FurRootGrid furRootGrid()
{
    FurRootGrid grid;
    grid.origin = furRootsHeader(0.0);
    grid.bricks = furRootsHeader(1.0);
    grid.rows = furRootsHeader(2.0).xy;
    return grid;
}

// A root's texels lie side by side in one row.
float4 furRootTexel(float2 texel, float number)
{
    return tex2Dlod(gFurRoots, float4(texel.x + number / kTgFurRootsWidth, texel.y, 0.0, 0.0));
}

#endif
// SPDX-License-Identifier: MIT
