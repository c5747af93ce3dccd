#include "meshprep/rays/surface_tree.h"

#include "meshprep/rays/windows/bounds_tree.h"

#include <algorithm>
#include <cassert>

namespace tegument {

struct SurfaceTree::State {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    std::size_t corners;
    BoundsTree tree;

    [[nodiscard]] const glm::vec3& corner(std::uint32_t face, std::size_t number) const {
        return positions[indices[face * corners + number]];
    }
};

namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

std::vector<PieceBox> boxesOf(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, std::size_t corners) {
    std::vector<PieceBox> boxes(indices.size() / corners);
    for (std::size_t face = 0; face < boxes.size(); ++face) {
        boxes[face] = {positions[indices[face * corners]], positions[indices[face * corners]]};
        for (std::size_t i = 1; i < corners; ++i) {
            const glm::vec3& point = positions[indices[face * corners + i]];
            boxes[face] = {glm::min(boxes[face].low, point), glm::max(boxes[face].high, point)};
        }
    }
    return boxes;
}

/// Moeller and Trumbore 1997, in double precision; the slack closes the edges that two triangles share.
float meet(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::dvec3& origin, const glm::dvec3& direction) {
    constexpr double kSlack = 1e-12;
    const glm::dvec3 first = glm::dvec3(b) - glm::dvec3(a);
    const glm::dvec3 second = glm::dvec3(c) - glm::dvec3(a);
    const glm::dvec3 across = glm::cross(direction, second);
    const double area = glm::dot(first, across);
    if (area == 0) return kNone;
    const glm::dvec3 from = origin - glm::dvec3(a);
    const double u = glm::dot(from, across) / area;
    const glm::dvec3 turned = glm::cross(from, first);
    const double v = glm::dot(direction, turned) / area;
    if (u < -kSlack || v < -kSlack || u + v > 1 + kSlack) return kNone;
    return static_cast<float>(glm::dot(second, turned) / area);
}

/// A hit outside of the range: none.
float within(float distance, const RayRange& range) {
    return distance >= range.first && distance <= range.last ? distance : kNone;
}

} // namespace

SurfaceTree::SurfaceTree(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, const TreeOptions& options)
    : state_(new State{.positions = {positions.begin(), positions.end()},
                       .indices = {indices.begin(), indices.end()},
                       .corners = options.corners,
                       .tree = BoundsTree(boxesOf(positions, indices, options.corners))}) {
    assert(options.corners == 3 || options.corners == 4);
}

SurfaceTree::~SurfaceTree() = default;

std::optional<RayHit> SurfaceTree::nearest(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range) const {
    RayHit hit{.face = 0, .distance = kNone};
    const auto take = [&](std::uint32_t face) {
        const auto corner = [&](std::size_t i) { return state_->corner(face, i); };
        float distance = within(meet(corner(0), corner(1), corner(state_->corners - 1), origin, direction), range);
        if (state_->corners == 4) distance = std::min(distance, within(meet(corner(2), corner(3), corner(1), origin, direction), range));
        if (distance < hit.distance) hit = {.face = face, .distance = distance};
        return hit.distance;
    };
    state_->tree.walk(
        range.last, [&](const PieceBox& box) { return entry(box, origin, direction, range.first); }, take);
    return std::isinf(hit.distance) ? std::nullopt : std::optional(hit);
}

bool SurfaceTree::meetsAny(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range) const {
    return nearest(origin, direction, range).has_value();
}

void SurfaceTree::search(const glm::vec3& point, float radius, Visitor visitor, void* own) const {
    const auto distance = [&](const PieceBox& box) {
        return glm::length(glm::max(glm::max(box.low - point, point - box.high), glm::vec3(0)));
    };
    state_->tree.walk(radius, distance, [&](std::uint32_t face) { return visitor(own, face); });
}

} // namespace tegument
