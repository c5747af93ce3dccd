#pragma once
// What becomes of the distances between two surfaces: where they are greatest, and their mean.

#include "meshprep/prepare/near_surface.h"

namespace tegument::prep {

/// A point, or a triangle, far from the other surface.
struct DistancePeak {
    double apart = 0;
    std::uint32_t number = 0;
    glm::dvec3 at{};
    std::uint32_t nearest = 0; // corner of the other surface
};

/// What is further than this share of the greatest distance is worth mending.
inline constexpr double kPeak = 0.5;

/// From the farthest on, `most` of them; none within twice the distance of one before, for that is the same hill.
[[nodiscard]] std::vector<DistancePeak> summits(std::vector<DistancePeak> peaks, double reached, std::size_t most);

/// Of corners and centroids of the first surface from the second. `dear`: answers take long, so few are asked.
[[nodiscard]] double rootMeanSquare(const NearSurface& from, const NearSurface& to, bool dear);

} // namespace tegument::prep
