#pragma once
// A surface that is asked for its nearest point, by a tree of boxes in single precision: within the unit cube.

#include "meshprep/prepare/near_tree.h"
#include "meshprep/prepare/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tegument::prep {

inline constexpr std::uint32_t kNoHint = UINT32_MAX;

struct NearestTriangle {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
    bool exact = true; // else another triangle may be nearer

    /// That some point is so far, for sure.
    [[nodiscard]] double reached() const { return exact && std::isfinite(distance) ? distance : 0; }
};

/// Triangles that are looked at for one point. A surface needs 8 on average and 70 at most; where thousands of triangles cross one another
/// each point lies in the boxes of half of them.
inline constexpr unsigned kMostVisits = 256;

class NearSurface {
public:
    NearSurface(const std::vector<glm::dvec3>& points, std::span<const std::uint32_t> triangles)
        : points_(points), triangles_(triangles), tree_(points, triangles) {}

    [[nodiscard]] const std::vector<glm::dvec3>& points() const { return points_; }
    [[nodiscard]] std::span<const std::uint32_t> corners() const { return triangles_; }
    [[nodiscard]] std::size_t size() const { return triangles_.size() / 3; }
    [[nodiscard]] std::array<glm::dvec3, 3> triangle(std::size_t i) const {
        const std::uint32_t* t = &triangles_[3 * i];
        return {points_[t[0]], points_[t[1]], points_[t[2]]};
    }

    /// All triangles, neighbours near one another.
    [[nodiscard]] std::span<const std::uint32_t> alongCurve() const { return tree_.alongCurve(); }

    /// `hint`: a triangle that is probably near. What is no further than `enough` will do.
    [[nodiscard]] NearestTriangle nearest(const glm::dvec3& point, std::uint32_t hint = kNoHint, double enough = 0) const {
        NearestTriangle found;
        float radius = std::numeric_limits<float>::infinity();
        const auto take = [&](std::uint32_t triangle) {
            const double apart = distanceTo(triangle, point);
            if (!(apart < found.distance) || !found.exact)
                return; // not a number where two corners are equal: such a triangle is a side of others
            found = {.distance = apart, .triangle = triangle, .exact = true};
            radius = apart <= enough ? 0 : std::nextafter(static_cast<float>(apart), 1e30f);
        };
        if (hint != kNoHint) take(hint);
        if (found.distance <= enough) return found;
        unsigned visits = 0;
        tree_.visitNear(glm::vec3(point), radius, [&](std::uint32_t triangle) {
            if (++visits > kMostVisits) return radius; // boxes that hold the point go on being visited
            take(triangle);
            if (visits == kMostVisits && radius > 0) {
                found.exact = found.distance <= enough;
                radius = 0;
            }
            return radius;
        });
        return found;
    }

    [[nodiscard]] double distanceTo(std::uint32_t triangle, const glm::dvec3& point) const {
        const std::uint32_t* t = &triangles_[3 * std::size_t{triangle}];
        return glm::distance(nearestOnTriangle(point, points_[t[0]], points_[t[1]], points_[t[2]]), point);
    }

    [[nodiscard]] std::uint32_t nearestCorner(std::uint32_t triangle, const glm::dvec3& point) const {
        return *std::ranges::min_element(corners().subspan(3 * std::size_t{triangle}, 3), {},
                                         [&](std::uint32_t corner) { return glm::distance(points_[corner], point); });
    }

private:
    const std::vector<glm::dvec3>& points_;
    std::span<const std::uint32_t> triangles_;
    NearTree tree_;
};

} // namespace tegument::prep
