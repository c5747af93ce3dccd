#pragma once
// What a ray meets of round curves: uniform cubic B-splines with a radius at each control point, met by Embree in single precision.

#include "meshprep/rays/surface_tree.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace tegument {

struct CurveHit {
    std::uint32_t piece = 0;
    float along = 0;          // of the piece, 0 to 1
    float distance = 0;       // in lengths of the ray's direction
    glm::dvec3 normal{0};     // of the surface, outwards, unit
    glm::dvec3 axis{1, 0, 0}; // where the curve runs to there, unit
    double radius = 0;
};

class CurveTree {
public:
    /// `controls`: place and radius. A piece hangs on four that follow each other, from each of `starts` on. `threads` as TreeOptions.
    CurveTree(std::vector<glm::vec4> controls, std::span<const std::uint32_t> starts, unsigned threads = 1);
    ~CurveTree();
    CurveTree(const CurveTree&) = delete;
    CurveTree& operator=(const CurveTree&) = delete;

    /// The first piece within `range` along the ray. Safe to call from several threads, as the next.
    [[nodiscard]] std::optional<CurveHit> nearest(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range = {}) const;
    [[nodiscard]] bool meetsAny(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range = {}) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace tegument
