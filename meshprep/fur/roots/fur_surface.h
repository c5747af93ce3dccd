#pragma once
// The surface on which fur grows, brought to unit size, and points on it evenly by area.
// What tells one surface from another, whatever the unit, place and triangles of its file: roots made for one are of no use on another.

#include "host/mesh/mesh.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tegument {

/// A point of a triangle. In the unit space of its FurSurface.
struct SurfacePoint {
    glm::vec3 position{0};
    glm::vec3 normal{0, 0, 1}; // the mesh's, interpolated, unit: that along which shells are moved
    std::uint32_t triangle = 0;
    glm::vec2 barycentric{0}; // weights of the second and the third corner
};

/// The mesh's minimal ball is the unit ball here, so that meshes of any size are alike.
class FurSurface {
public:
    /// `mesh` must outlive this.
    explicit FurSurface(const Mesh& mesh);

    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    [[nodiscard]] const std::vector<glm::vec3>& positions() const { return positions_; }
    [[nodiscard]] double area() const { return cumulative_.empty() ? 0 : cumulative_.back(); }
    [[nodiscard]] double radius() const { return radius_; } // of the ball, in the mesh's lengths
    [[nodiscard]] glm::vec3 toMesh(const glm::vec3& unit) const { return glm::vec3(centre_ + glm::dvec3(unit) * radius_); }
    /// Direction from the ball's centre, in units of its radius.
    [[nodiscard]] const glm::dvec3& centre() const { return centre_; }

    /// barycentric: weights of the second and the third corner.
    [[nodiscard]] SurfacePoint at(std::uint32_t triangle, const glm::vec2& barycentric) const;
    /// Three numbers in [0, 1) to a point, evenly by area.
    [[nodiscard]] SurfacePoint point(const glm::dvec3& uniform) const;

private:
    void addAreas();
    [[nodiscard]] std::uint32_t triangleAt(double area) const;

    const Mesh& mesh_;
    glm::dvec3 centre_{0};
    double radius_ = 1;
    std::vector<glm::vec3> positions_;
    std::vector<double> cumulative_;   // area up to and with each triangle
    std::vector<std::uint32_t> guide_; // the triangle at each k-th part of the area: where to start looking
};

/// Three numbers in [0, 1) for a counter: the noise from which everything about roots is taken.
[[nodiscard]] glm::dvec3 rootNoise(std::uint64_t counter, std::uint32_t seed);

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
