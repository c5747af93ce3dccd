#include "meshprep/prepare/centre.h"

#include <algorithm>
#include <limits>

namespace tegument::prep {

namespace {

/// Half of the box's diagonal, rounded up: every vertex is inside, most far inside (19 to 73 % of air on real meshes).
/// The middle is a sum of floats: where doubles are rounded to floats and used as doubles again, GCC 12 for x86-64 may leave out the
/// rounding.
void boundByBox(Bounds& bounds) {
    const glm::dvec3 low(bounds.minimum);
    const glm::dvec3 high(bounds.maximum);
    bounds.centre = 0.5f * bounds.minimum + 0.5f * bounds.maximum;
    const double radius = std::max(glm::distance(high, glm::dvec3(bounds.centre)), glm::distance(low, glm::dvec3(bounds.centre)));
    bounds.radius = std::nextafter(static_cast<float>(radius), std::numeric_limits<float>::max());
}

} // namespace

Centring centre(Surface& surface, CentreMode mode) {
    Mesh& mesh = surface.mesh;
    computeBounds(mesh);
    Centring result{.minimalRadius = mesh.bounds.radius};
    if (mode == CentreMode::Box) boundByBox(mesh.bounds);
    result.radius = mesh.bounds.radius; // of the ball as asked for
    result.place = mesh.origin;
    if (mode == CentreMode::None) return result;
    const glm::dvec3 from(mesh.bounds.centre);
    result.moved = glm::dvec3(0) - (mesh.origin + from); // not -0
    if (result.place != glm::dvec3(0)) result.place = mesh.origin + from;
    mesh.origin = glm::dvec3(0); // the place is told from now on
    mesh.motionRoot[3] += glm::dvec4(result.moved, 0);
    if (from == glm::dvec3(0)) return result;
    for (glm::vec3& position : mesh.positions) {
        const glm::vec3 moved(glm::dvec3(position) - from);
        result.vertices += moved != position;
        position = moved;
        // moving rounds, so that a vertex on the ball may now be just outside
        mesh.bounds.radius = std::max(
            mesh.bounds.radius, std::nextafter(static_cast<float>(glm::length(glm::dvec3(moved))), std::numeric_limits<float>::max()));
    }
    mesh.bounds.minimum = glm::vec3(glm::dvec3(mesh.bounds.minimum) - from);
    mesh.bounds.maximum = glm::vec3(glm::dvec3(mesh.bounds.maximum) - from);
    mesh.bounds.centre = glm::vec3(0);
    return result;
}

} // namespace tegument::prep
