#pragma once
// What tells one surface from another, whatever the unit, place and triangles of its file: roots made for one are of no use on another.

#include "host/mesh/mesh.h"

#include <optional>

namespace tegument {

/// In units of the mesh's minimal ball, from its centre, along the mesh's axes.
struct SurfaceFigures {
    glm::dvec3 middle{0}; // of the area
    double area = 0;
    glm::dvec3 spread{0}; // mean squares of the distance from the centre, over the area
};

[[nodiscard]] SurfaceFigures surfaceFigures(const Mesh& mesh);

/// Why roots that were made for `made` cannot be used on `drawn`; nothing where they can.
[[nodiscard]] std::optional<std::string> whyNotSame(const SurfaceFigures& made, const SurfaceFigures& drawn);

} // namespace tegument
