#pragma once
// The relief of a face, and where a surface that is seen from one side has one.

#include "meshprep/portrait/surface_samples.h"

namespace tegument {

struct FaceMatch {
    double likeness = -1;  // at most 1
    double millimetre = 1; // in the surface's unit
    glm::dvec3 nasion{0};
};

/// mm before the nasion, `across` mm from the middle and `above` mm above it: a formula, whose numbers
/// were fitted to the median of twelve heads.
[[nodiscard]] double faceRelief(double across, double above);

/// The best place and size in what is seen against `front`, symmetric about the plane through `middle`; `fine`: by smaller steps.
[[nodiscard]] FaceMatch matchFace(const std::vector<SurfaceSample>& samples, const glm::dvec3& middle, const glm::dvec3& up,
                                  const glm::dvec3& front, bool fine);

} // namespace tegument
