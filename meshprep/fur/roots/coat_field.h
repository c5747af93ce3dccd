#pragma once
// Lean and density of the coat at any place, from samples on the surface: what vertices of shells need, which lie between roots.

#include "meshprep/fur/roots/point_grid.h"

#include <span>

namespace tegument {

/// A point of the surface, mm, mesh space.
struct CoatSample {
    glm::vec3 position{0};
    glm::vec3 normal{0, 0, 1};
    glm::vec3 lean{0};
    float density = 1; // share of the full density, 0..1
};

/// Moving least squares: at each place the linear function that fits the samples around best, near ones counting more (D. Levin, The
/// approximation power of moving least-squares, 1998). A mean alone would be wrong beside the surface, where grids have most of their
/// nodes.
class CoatField {
public:
    /// `samples` must outlive this. Those farther than `radius` do not count.
    CoatField(std::span<const CoatSample> samples, float radius);

    /// Lean and density; (0, 0, 0, 0) where no sample is near. No lean is longer than the longest of a sample.
    [[nodiscard]] glm::vec4 at(const glm::vec3& place) const;

private:
    std::span<const CoatSample> samples_;
    float radius_;
    float longest_ = 0;
    PointGrid grid_;
};

} // namespace tegument
