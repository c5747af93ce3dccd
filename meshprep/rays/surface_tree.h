#pragma once
// What a ray meets, and what lies near a point: Embree's tree over triangles or quads, in single precision.

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace tegument {

struct TreeOptions {
    std::size_t corners = 3; // of a face: 3 or 4
    bool watertight = false; // no ray slips through an edge that two faces share
    bool quick = false;      // soon built rather than soon searched: for few rays
    unsigned threads = 1;    // that build it: 1, or as many as there are
};

/// Along a ray, in lengths of its direction.
struct RayRange {
    float first = 0;
    float last = std::numeric_limits<float>::infinity();
};

struct RayHit {
    std::uint32_t face = 0;
    float distance = 0; // in lengths of the direction
};

class SurfaceTree {
public:
    /// Copies what it needs. `indices` holds the corners of all faces, each within `positions`.
    SurfaceTree(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, const TreeOptions& options);
    ~SurfaceTree();
    SurfaceTree(const SurfaceTree&) = delete;
    SurfaceTree& operator=(const SurfaceTree&) = delete;

    /// The first face within `range` along the ray, seen from either side. Safe to call from several threads, as all that follow.
    [[nodiscard]] std::optional<RayHit> nearest(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range = {}) const;

    [[nodiscard]] bool meetsAny(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range = {}) const;

    /// `visit(face)` for every face that comes nearer to `point` than `radius`, near boxes first, and perhaps for a few that do not. It
    /// returns the radius to go on with: the same, or a smaller one.
    template <class Visit>
    void visitNear(const glm::vec3& point, float radius, Visit visit) const {
        search(
            point, radius, [](void* own, std::uint32_t face) { return (*static_cast<Visit*>(own))(face); }, &visit);
    }

private:
    using Visitor = float (*)(void* own, std::uint32_t face);
    void search(const glm::vec3& point, float radius, Visitor visitor, void* own) const;

    struct State;
    std::unique_ptr<State> state_;
};

} // namespace tegument
