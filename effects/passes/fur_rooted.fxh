// Technique Roots: strands whose roots `tegument fur roots` has placed.
#ifndef TEGUMENT_PASSES_FUR_ROOTED_FXH
#define TEGUMENT_PASSES_FUR_ROOTED_FXH

Texture2D gFurRootsMap < float4 Fallback = { 0.0, 0.0, 0.0, 0.0 }; string UIName = "Roots"; string UIHelp = "from tegument fur roots, made from this mesh"; >;
SAMPLER2D(gFurRoots, POINT, CLAMP);

static const float kFurMostRoots = 64.0; // of a list: what is nearer than the reach of one cell

// The first row of the texture.
struct FurRootGrid
{
    float4 origin; // mm, mesh space; side of a cell, mm
    float4 bricks; // along each axis; cells along a brick's side
    float2 rows;   // of the texture; address of the table of bricks
    float spacing; // mm
    float radius;  // greatest of a root, mm
    float shortest; // strand, share of the longest
    float3 centre; // of the mesh's ball
};

float4 furRootsHeader(float index)
{
    return tex2Dlod(gFurRoots, float4((index + 0.5) / kFurRootsWidth, 0.0, 0.0, 0.0));
}

FurRootGrid furRootGrid()
{
    float4 strands = furRootsHeader(3.0);
    FurRootGrid grid;
    grid.origin = furRootsHeader(0.0);
    grid.bricks = furRootsHeader(1.0);
    grid.rows = furRootsHeader(2.0).xy;
    grid.spacing = rsqrt(max(strands.w, 1e-10));
    grid.radius = strands.y;
    grid.shortest = furRootsHeader(5.0).x;
    grid.centre = furRootsHeader(4.0).xyz;
    return grid;
}

// A root's texels lie side by side in one row.
float4 furRootTexel(float2 texel, float number)
{
    return tex2Dlod(gFurRoots, float4(texel.x + number / kFurRootsWidth, texel.y, 0.0, 0.0));
}

// The strands of the list.
float4 furRoots(float4 met, FurSweep sweep, FurPiece piece, FurRootGrid grid, float list)
{
    float last = list > 0.0 ? kFurMostRoots : -1.0;
    [loop] for (float i = 0.0; i <= last; i += 1.0)
    {
        float entry = furTable(SAMPLER2D_ARG(gFurRoots), grid.rows.x, list, i);
        last = entry < 0.0 ? i + 3.0 : last;
        float2 texel = furTexel(abs(entry), grid.rows.x);
        float4 place = furRootTexel(texel, 0.0);
        float3 root = piece.begin - (place.xyz - grid.centre) / grid.spacing;
        root -= sweep.normal * dot(root, sweep.normal);
        float3 away = root + 0.5 * piece.along;
        [branch] if (abs(entry) > 0.0 && dot(away, away) < piece.reach * piece.reach)
        {
            float4 up = furRootTexel(texel, 1.0);
            float4 lean = furRootTexel(texel, 2.0);
            // Roots of an opposite sheet look the other way.
            float share = max(min(dot(up.xyz, sweep.normal), up.w * (1.0 / (gFurLength * gMeshRadius))), 0.01);
            met = furMeet(met, sweep, piece, root, share, gFurRadius * place.w / grid.radius, dot(lean.xyz, sweep.normal), frac(lean.w * float3(1.0, 256.0, 65536.0)));
        }
    }
    return met;
}

// The lean of the first root near a vertex: combed fur leans evenly, so it serves the strands around.
StrandsVarying RootsVS(LAYER_INPUT(FurInput, input))
{
    FurRootGrid grid = furRootGrid();
    float list = furRootList(SAMPLER2D_ARG(gFurRoots), input.position, grid.origin, grid.bricks, grid.rows);
    float root = abs(furTable(SAMPLER2D_ARG(gFurRoots), grid.rows.x, list, 0.0));
    float3 lean = furRootTexel(furTexel(root, grid.rows.x), 2.0).xyz;
    lean -= input.normal * dot(lean, input.normal); // without its curl
    return strandsVarying(input, LAYER_INDEX(gFurLayer), list > 0.0 ? lean : float3(0.0, 0.0, 0.0), list > 0.0 ? 1.0 : 0.0);
}

float4 RootsPS(StrandsVarying input) : SV_Target0
{
    FurRootGrid grid = furRootGrid();
    FurSweep sweep = furSweep(input, grid.spacing);
    FurPiece piece = furFirstPiece();
    float4 met = 0.0;
    // As in CellularPS.
    [loop] for (int i = 0; i <= sweep.steps; i++)
    {
        piece = furNextPiece(piece, sweep, i * sweep.step);
        float3 middle = (piece.begin + 0.5 * piece.along) * grid.spacing + grid.centre;
        [branch] if (i > 0)
        {
            float list = furRootList(SAMPLER2D_ARG(gFurRoots), middle, grid.origin, grid.bricks, grid.rows);
            met = furRoots(met, sweep, piece, grid, list);
        }
    }
    return furStrandColor(input, sweep, piece, met, 1.0, grid.shortest);
}

#endif
