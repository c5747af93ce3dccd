// Strands without data (docs/design/fur-layers.md): space is a lattice of cubes, each holds one point at a random place, and a point grows
// a strand where a surface passes nearer than rho. A cut through the lattice meets 2 rho / cell^3 points per area whatever its direction,
// so strands stand in proportion to area without texture coordinates, seams or preparation.
//   The random numbers are residues modulo a prime, whole numbers below 2^22 throughout: floats hold them exactly, and every target makes
//   the same strands.
#ifndef TEGUMENT_FUR_CELLS_FXH
#define TEGUMENT_FUR_CELLS_FXH

static const float kTgFurPrime = 1019.0;

// v modulo the prime, v whole, |v| < 2^22. The half keeps the rounded quotient off whole numbers: it errs by 2.5e-4 at most, the half is
// 4.9e-4.
float3 tgFurResidue(float3 v)
{
    return v - kTgFurPrime * floor((v + 0.5) * (1.0 / kTgFurPrime));
}

// One round: a linear mixture, then products, which no linear pattern of cells survives. v: residues. The factors are any with no common
// structure.
float3 tgFurMixed(float3 v)
{
    float3 mixture = tgFurResidue(v * float3(431.0, 797.0, 163.0) + v.yzx * float3(577.0, 281.0, 907.0) + float3(101.0, 389.0, 733.0));
    return tgFurResidue(mixture.yzx * mixture.zxy + mixture * 613.0);
}

// Random residues of a cell: uniform, and of neighbours uncorrelated (held by a test over a million cells). cell: whole numbers, |cell| <
// 2400, below which the sums of products stay below 2^22.
float3 tgFurCellResidue(float3 cell)
{
    return tgFurMixed(tgFurMixed(cell));
}

// In (0, 1).
float3 tgFurUnit(float3 residue)
{
    return (residue + 0.5) * (1.0 / kTgFurPrime);
}

// How tall the strand of a point at this distance from the surface is, share of its own length: full within three quarters of rho, none at
// rho, so that nothing ends abruptly where a curved surface leaves a point.
float tgFurNearness(float distance, float rho)
{
    return saturate(4.0 - 4.0 * abs(distance) / rho);
}

// Smooth wave between -1 and 1 of period 1: a triangle bent by 3 t^2 - 2 t^3, where a sine takes shader model 3 three times as long.
float3 tgFurWave(float3 x)
{
    float3 t = abs(2.0 * frac(x) - 1.0);
    return t * t * (6.0 - 4.0 * t) - 1.0;
}

// Tufts: where a look-up goes so that neighbouring strands lean together; waves across waves, so that no lattice shows. position: in sizes
// of a tuft.
float3 tgFurTuft(float3 position)
{
    return tgFurWave(position.yzx * 0.31 + 0.4 * tgFurWave(position.zxy * 0.19));
}

#endif
// SPDX-License-Identifier: MIT
