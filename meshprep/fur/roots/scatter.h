#pragma once
// Roots on a surface: random points evenly by area of which no two are closer than a distance (Poisson discs), as seed 004 wants it for its
// texture: N = density * area, "controle de vizinhanca".

#include "meshprep/fur/roots/fur_surface.h"

#include <functional>
#include <optional>

namespace tegument {

struct ScatterOptions {
    std::size_t wanted = 0;
    float distance = 0; // least, in the surface's unit space
    std::uint32_t seed = 1;
    unsigned threads = 0;
    std::function<double(const SurfacePoint&)> density; // share of the full density, 0..1; none: 1 everywhere. Called by several threads
};

struct ScatteredRoots {
    std::vector<SurfacePoint> points; // in the order of their triangles
    float distance = 0;               // that was kept
};

/// Random places, taken in a random order, each if it is nearer than the distance to none taken before; discs are larger where the density
/// is less. Points that look to opposite sides (normals more than 90 degrees apart) do not see each other, so that both sides of a thin
/// sheet have their own. Where a surface is rougher than its roots are apart, it has more area than room for such discs: after
/// kTriesAtFullDistance tries per wanted root the distance shrinks. After kTriesPerRoot it is over. The same for any number of threads.
[[nodiscard]] ScatteredRoots scatterRoots(const FurSurface& surface, const ScatterOptions& options);

inline constexpr std::size_t kTriesAtFullDistance = 24; // smooth surfaces need ten for 0.72 spacings
inline constexpr std::size_t kTriesPerRoot = 64;

} // namespace tegument
