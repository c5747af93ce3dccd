#include "host/scene/placement.h"

#include <glm/gtc/constants.hpp>

#include <array>
#include <cassert>
#include <cmath>

namespace tegument {

namespace {

/// Counter-clockwise about an axis. Multiples of 90 degrees are exact: a head turned by 180 degrees keeps its floats but for their signs.
glm::dmat4 turned(glm::length_t axis, double degrees) {
    const double quarters = degrees / 90;
    double sine = std::sin(glm::radians(degrees));
    double cosine = std::cos(glm::radians(degrees));
    if (quarters == std::round(quarters)) {
        sine = std::round(sine);
        cosine = std::round(cosine);
    }
    glm::dmat4 m(1);
    const glm::length_t a = (axis + 1) % 3;
    const glm::length_t b = (axis + 2) % 3;
    m[a][a] = cosine;
    m[a][b] = sine; // row a: where the axis a goes
    m[b][a] = -sine;
    m[b][b] = cosine;
    return m;
}

glm::vec3 placed(const glm::dmat4& world, const glm::vec3& p) {
    return glm::vec3(transformPoint(world, glm::dvec3(p)));
}

/// From all vertices where they stand.
Bounds boundsOfPlaced(std::span<const PlacedMesh> meshes) {
    Mesh all;
    for (const PlacedMesh& object : meshes) {
        const glm::dmat4 world = worldMatrix(object.placement);
        for (const glm::vec3& p : object.mesh->positions)
            all.positions.push_back(placed(world, p));
    }
    computeBounds(all);
    return all.bounds;
}

} // namespace

glm::dmat4 worldMatrix(const Placement& placement) {
    glm::dmat4 m(1);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        m[axis][axis] = static_cast<double>(placement.scale[axis]);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        m = turned(axis, static_cast<double>(placement.rotation[axis])) * m; // GLM's b * a is "first a, then b" on row vectors
    m[3] = glm::dvec4(glm::dvec3(placement.position), 1);
    return m;
}

bool isMirrored(const Placement& placement) {
    return placement.scale.x * placement.scale.y * placement.scale.z < 0;
}

bool isEvenlyScaled(const Placement& placement) {
    const glm::vec3 lengths = glm::abs(placement.scale);
    return lengths.x == lengths.y && lengths.y == lengths.z;
}

glm::dvec3 transformPoint(const glm::dmat4& m, const glm::dvec3& p) {
    return glm::dvec3(m * glm::dvec4(p, 1));
}

Bounds placedBounds(const Mesh& mesh, const Placement& placement) {
    if (placement == Placement{}) return mesh.bounds;
    const glm::dmat4 world = worldMatrix(placement);
    if (!isEvenlyScaled(placement)) return boundsOfPlaced(std::array{PlacedMesh{&mesh, placement}});
    Bounds bounds{.minimum = glm::vec3(INFINITY),
                  .maximum = glm::vec3(-INFINITY),
                  .centre = placed(world, mesh.bounds.centre),
                  .radius = mesh.bounds.radius * std::abs(placement.scale.x)};
    for (const glm::vec3& position : mesh.positions) {
        const glm::vec3 p = placed(world, position);
        bounds.minimum = glm::min(bounds.minimum, p);
        bounds.maximum = glm::max(bounds.maximum, p);
    }
    return bounds;
}

Bounds boundsOfAll(std::span<const PlacedMesh> meshes) {
    assert(!meshes.empty());
    if (meshes.size() == 1) return placedBounds(*meshes.front().mesh, meshes.front().placement);
    return boundsOfPlaced(meshes);
}

} // namespace tegument
