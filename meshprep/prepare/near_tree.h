#pragma once
// A tree of boxes round triangles, for what lies near a point. Built soon, along a curve through space: a million triangles take a tenth
// of a second, a third of what Embree's quickest tree takes.

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tegument::prep {

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

} // namespace tegument::prep
