#pragma once
// Planes in which a surface mirrors itself.

#include "meshprep/portrait/surface_samples.h"

namespace tegument {

struct MirrorPlane {
    glm::dvec3 normal{1, 0, 0}; // unit
    glm::dvec3 point{0};
    double likeness = 0; // 1: one half is the other's mirror image; 0: it lies as far from it as a third of the surface's own size
};

/// The best plane, and up to two others that are nearly as good; at least one.
[[nodiscard]] std::vector<MirrorPlane> mirrorPlanes(const std::vector<SurfaceSample>& samples);

} // namespace tegument
