#pragma once
// Roots on a surface: random points evenly by area of which no two are closer than a distance (Poisson discs), as seed 004 wants it for its
// texture: N = density * area, "controle de vizinhanca".

#include "meshprep/fur/roots/strata.h"

namespace tegument {

/// Side of the cubes among which roots are shared out, in spacings at full density.
inline constexpr double kStratum = 4;

struct ScatterOptions {
    std::size_t wanted = 0;
    float distance = 0; // least, in the surface's unit space
    float stratum = 0;  // side of those cubes; 0: kStratum mean spacings
    std::uint32_t seed = 1;
    unsigned threads = 0;
    DensityAt density; // none: 1 everywhere. Called by several threads
};

struct ScatteredRoots {
    std::vector<SurfacePoint> points; // in the order of their triangles
    float distance = 0;               // that was kept
};

/// Random places, taken in a random order, each if it is nearer than the distance to none taken before; discs are larger where the density
/// is less. Points that look to opposite sides (normals more than 90 degrees apart) do not see each other, so that both sides of a thin
/// sheet have their own. Random discs alone would vary in number more than they need to, and stand denser where the surface is smooth than
/// where it is rough: so the surface is divided into strata, each of which takes its share of the roots and no more. What finds no room in
/// a stratum is placed in its surroundings, and where these have none, on surfaces rougher than their roots are apart, the distance
/// shrinks. The same for any number of threads.
[[nodiscard]] ScatteredRoots scatterRoots(const FurSurface& surface, const ScatterOptions& options);

} // namespace tegument
