#pragma once
// Points of a mesh in double precision: attributes interpolated, charts unwrapped, rays cast.

#include "host/mesh/mesh.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace tegument {
class SurfaceTree;
}

namespace tegument::reference {

/// A place on a triangle; weights sum to 1.
struct Place {
    std::uint32_t triangle = 0;
    glm::dvec3 weights{0};
};

/// Interpolated attributes, not normalised: as a rasteriser hands them to a pixel shader.
struct SurfacePoint {
    Place place;
    glm::dvec3 position{0}; // mm
    glm::dvec3 normal{0};
    glm::dvec4 tangent{0};
    glm::dvec2 uv{0};
};
[[nodiscard]] SurfacePoint interpolate(const Mesh& mesh, const Place& place);

/// Where the round surface stands that the normals mean, at or outside of the flat triangle: the point by the planes through its corners,
/// as far as it lies below them (Hanika 2021, "Hacking the Shadow Terminator"). Of a mesh without normals, the point.
[[nodiscard]] glm::dvec3 outsideFacet(const Mesh& mesh, const SurfacePoint& point);

/// Of the flat triangle, counter-clockwise; zero where it is degenerate.
[[nodiscard]] glm::dvec3 faceNormal(const Mesh& mesh, std::uint32_t triangle);

/// dP/du and dP/dv of a triangle, mm per unit of uv: the columns of its Jacobian, from its edges.
struct Jacobian {
    glm::dvec3 alongU{0};
    glm::dvec3 alongV{0};
};
/// None where the triangle has no area in texture space.
[[nodiscard]] std::optional<Jacobian> jacobian(const Mesh& mesh, std::uint32_t triangle);

/// The mesh drawn into its own texture space: per texel the place that covers its centre, row 0 at v = 0. Of overlapping triangles the
/// last.
struct Unwrapped {
    int size = 0;
    std::vector<std::optional<Place>> texels;

    [[nodiscard]] const std::optional<Place>& at(int x, int y) const {
        return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
    }
};
[[nodiscard]] Unwrapped unwrap(const Mesh& mesh, int size);

struct Hit {
    Place place;
    double distance = 0; // mm along the unit direction
};

/// Nearest intersections. Embree finds the triangle in 32-bit floats; place and distance are then computed in double precision.
class RayScene {
public:
    explicit RayScene(const Mesh& mesh);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// `direction`: unit. Triangles are seen from both sides.
    [[nodiscard]] std::optional<Hit> nearest(const glm::dvec3& origin, const glm::dvec3& direction) const;

    /// Whether light at `light` reaches `point` of the surface: nothing nearer than `slack` mm before it on the way.
    [[nodiscard]] bool reaches(const glm::dvec3& light, const glm::dvec3& point, double slack) const;

    /// Triangles that come nearer than `radius`, in rising order, and perhaps a few that do not.
    [[nodiscard]] std::vector<std::uint32_t> around(const glm::dvec3& centre, double radius) const;

    /// mm from a place to the nearest triangle, where that is less than `most`; else `most`.
    [[nodiscard]] double distance(const glm::dvec3& place, double most) const;

    [[nodiscard]] const Mesh& mesh() const { return mesh_; }

private:
    const Mesh& mesh_;
    std::unique_ptr<const SurfaceTree> tree_;
};

} // namespace tegument::reference
