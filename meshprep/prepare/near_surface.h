#pragma once
// A surface that is asked for its nearest point, by a tree of boxes in single precision: within the unit cube.
// A tree of boxes round triangles, for what lies near a point. Built soon, along a curve through space: a million triangles take a tenth
// of a second, a third of what Embree's quickest tree takes.
// The point of a triangle that is nearest to a point: after C. Ericson, Real-Time Collision Detection (2005), 5.1.5. Inline, for loops
// over millions of them.

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tegument::prep {

[[nodiscard]] inline glm::dvec3 nearestOnTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const double d1 = glm::dot(ab, p - a);
    const double d2 = glm::dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = glm::dot(ab, p - b);
    const double d4 = glm::dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const double d5 = glm::dot(ab, p - c);
    const double d6 = glm::dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}

class NearTree {
public:
    /// Points that triangles name lie in the unit cube. Of single precision: what is asked is answered within 1e-6.
    NearTree(std::span<const glm::dvec3> points, std::span<const std::uint32_t> triangles);

    /// `visit(triangle)` for every triangle that comes nearer to `point` than `radius`, near boxes first, and perhaps for a few that do
    /// not. It returns the radius to go on with: the same, or a smaller one; 0 ends it. Safe to call from several threads.
    template <class Visit>
    void visitNear(const glm::vec3& point, float radius, Visit visit) const;

    /// All of them, neighbours near one another: what is asked in this order finds what it needs where the last question left it.
    [[nodiscard]] std::span<const std::uint32_t> alongCurve() const { return triangles_; }

private:
    static constexpr std::size_t kWide = 4;           // boxes of a node
    static constexpr std::size_t kMostInLeaf = 4;     // triangles
    static constexpr std::size_t kDeepest = 30 + 32;  // splits by a bit of the place on the curve, then by number
    static constexpr std::uint32_t kLeaf = 1u << 31u; // then two bits for the number of triangles less one, then the first one's

    /// Four boxes, side by side for the processor's vectors; one that is not there is infinitely far.
    struct Node {
        std::array<std::array<float, kWide>, 3> low;
        std::array<std::array<float, kWide>, 3> high;
        std::array<std::uint32_t, kWide> inside; // a node, or a leaf

        /// Squared distances of all boxes from a point.
        [[nodiscard]] std::array<float, kWide> apart(const glm::vec3& point) const;
    };

    struct Near {
        float apart; // squared
        std::uint32_t what;
    };
    /// Room for all that wait: three boxes beside each on the way down, and the last four.
    using Waiting = std::array<Near, (kWide - 1) * kDeepest + 1>;

    class Builder;

    std::vector<std::uint32_t> triangles_; // along the curve
    std::vector<Node> nodes_;
    std::uint32_t root_ = 0;
};

template <class Visit>
void NearTree::visitNear(const glm::vec3& point, float radius, Visit visit) const {
    if (triangles_.empty()) return;
    Waiting waiting;
    std::size_t count = 0;
    waiting[count++] = {.apart = 0, .what = root_};
    while (count > 0) {
        const Near next = waiting[--count];
        if (next.apart >= radius * radius) continue;
        if ((next.what & kLeaf) != 0) {
            const std::uint32_t first = next.what & ((kLeaf >> 2u) - 1);
            const std::uint32_t last = first + (next.what >> 29u & 3u);
            for (std::uint32_t i = first; i <= last && radius > 0; ++i)
                radius = visit(triangles_[i]);
            continue;
        }
        const Node& node = nodes_[next.what];
        const std::array<float, kWide> apart = node.apart(point);
        const std::size_t bottom = count;
        for (std::size_t i = 0; i < kWide; ++i) { // the nearest last, which is taken first
            if (!(apart[i] < radius * radius)) continue;
            std::size_t at = count++;
            for (; at > bottom && waiting[at - 1].apart < apart[i]; --at)
                waiting[at] = waiting[at - 1];
            waiting[at] = {.apart = apart[i], .what = node.inside[i]};
        }
    }
}

inline std::array<float, NearTree::kWide> NearTree::Node::apart(const glm::vec3& point) const {
    std::array<float, kWide> squared{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        for (std::size_t i = 0; i < kWide; ++i) {
            const float outside = std::max(std::max(low[a][i] - point[axis], point[axis] - high[a][i]), 0.0f);
            squared[i] += outside * outside;
        }
    }
    return squared;
}

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
