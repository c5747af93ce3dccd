#pragma once
// Where the middle of a mesh is and how far it reaches.
// For algorithms that work in single precision: their squares and reciprocals neither vanish nor overflow at unit size.

#include "host/mesh/extent.h"
#include "meshprep/prepare/surface.h"

#include <cmath>

namespace tegument::prep {

enum class CentreMode {
    Ball, // the minimal bounding ball
    Box,  // the source document's: middle of the bounding box, radius half of its diagonal
    None  // stay where it is; bounded by the minimal ball
};

struct Centring {
    glm::dvec3 moved{0};      // added to every position of the file, mm
    glm::dvec3 place{0};      // where the positions of a mesh count from that lies too far out for floats; 0 for others
    double radius = 0;        // of the ball that was asked for
    double minimalRadius = 0; // of the minimal one
    std::size_t vertices = 0; // that moved
};

/// Moves the centre to the origin, and fills `mesh.bounds`.
Centring centre(Surface& surface, CentreMode mode);

/// Positions moved into the unit box, of which they fill more than half; sizes of up to 3e38 and down to 1e-45 come out alike. Scaled by a
/// power of two, so that whoever scales them again rounds as if they had not been: a simplifier gives what it gives to its other users.
[[nodiscard]] inline std::vector<glm::vec3> atUnitSize(const std::vector<glm::vec3>& positions) {
    const Extent extent = extentOf(positions);
    int exponent = 0;
    (void)std::frexp(extent.longest, &exponent);
    const double scale = std::ldexp(1.0, -exponent);
    std::vector<glm::vec3> scaled;
    scaled.reserve(positions.size());
    for (const glm::vec3& p : positions)
        scaled.emplace_back((glm::dvec3(p) - extent.low) * scale);
    return scaled;
}

} // namespace tegument::prep
