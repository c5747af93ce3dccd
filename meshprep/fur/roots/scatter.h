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

/// Random places, taken in a random order, each if it is nearer than the distance to none taken before; discs are larger where the density
/// is less. Points that look to opposite sides (normals more than 90 degrees apart) do not see each other, so that both sides of a thin
/// sheet have their own. Stops after kTriesPerRoot tries per wanted root. In the order of the triangles; the same for any number of
/// threads.
[[nodiscard]] std::vector<SurfacePoint> scatterRoots(const FurSurface& surface, const ScatterOptions& options);

inline constexpr std::size_t kTriesPerRoot = 64;

} // namespace tegument
