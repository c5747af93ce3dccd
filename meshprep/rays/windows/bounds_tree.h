#pragma once
// Inside meshprep/rays/windows: a tree over boxes, halved at the median of their middles. Embree does not build with MinGW-w64.

#include "meshprep/rays/box_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace tegument {

class BoundsTree {
public:
    explicit BoundsTree(std::vector<PieceBox> boxes) : boxes_(std::move(boxes)), pieces_(boxes_.size()) {
        std::iota(pieces_.begin(), pieces_.end(), 0U);
        if (!boxes_.empty()) build(0, pieces_.size());
    }

    /// `meet(piece)` for the pieces of boxes that `distance(box)` says are no further than `last`, near ones first; it returns the distance
    /// to go on with. An infinite distance: not at all.
    template <class Distance, class Meet>
    void walk(float last, const Distance& distance, const Meet& meet) const {
        struct Open {
            std::size_t node;
            float from;
        };
        std::array<Open, kDeepest> open{};
        std::size_t count = 0;
        const auto enter = [&](Open next) {
            if (reaches(next.from, last)) open[count++] = next;
        };
        if (!nodes_.empty()) enter({0, distance(nodes_[0].box)});
        while (count > 0) {
            const Open next = open[--count];
            if (next.from > last) continue;
            const Node& node = nodes_[next.node];
            for (std::size_t i = 0; i < node.pieces; ++i)
                if (const std::uint32_t piece = pieces_[node.first + i]; reaches(distance(boxes_[piece]), last))
                    last = std::min(last, meet(piece));
            if (node.pieces > 0) continue;
            Open near{next.node + 1, distance(nodes_[next.node + 1].box)};
            Open far{node.first, distance(nodes_[node.first].box)};
            if (far.from < near.from) std::swap(near, far);
            enter(far);
            enter(near);
        }
    }

private:
    static constexpr std::size_t kDeepest = 128; // 2^32 boxes halved down to a few, and as many again
    static constexpr std::size_t kLeaf = 4;

    struct Node {
        PieceBox box;
        std::size_t first = 0;  // piece; of an inner node the second child: the first one follows it
        std::size_t pieces = 0; // 0: an inner node
    };

    static bool reaches(float distance, float last) { return distance <= last && !std::isinf(distance); }

    void build(std::size_t first, std::size_t end) {
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        Node node{.box = {glm::vec3(kInfinity), glm::vec3(-kInfinity)}};
        PieceBox middles = node.box;
        const auto middle = [&](std::uint32_t piece) { return boxes_[piece].low * 0.5F + boxes_[piece].high * 0.5F; };
        for (std::size_t i = first; i < end; ++i) {
            node.box = {glm::min(node.box.low, boxes_[pieces_[i]].low), glm::max(node.box.high, boxes_[pieces_[i]].high)};
            middles = {glm::min(middles.low, middle(pieces_[i])), glm::max(middles.high, middle(pieces_[i]))};
        }
        const std::size_t own = nodes_.size();
        nodes_.push_back(node);
        if (end - first <= kLeaf) {
            nodes_[own].first = first;
            nodes_[own].pieces = end - first;
            return;
        }
        const glm::vec3 size = middles.high - middles.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t half = first + (end - first) / 2;
        const auto at = [&](std::size_t place) { return pieces_.begin() + static_cast<std::ptrdiff_t>(place); };
        std::nth_element(at(first), at(half), at(end),
                         [&](std::uint32_t a, std::uint32_t b) { return std::pair(middle(a)[axis], a) < std::pair(middle(b)[axis], b); });
        build(first, half);
        nodes_[own].first = nodes_.size();
        build(half, end);
    }

    std::vector<PieceBox> boxes_;
    std::vector<std::uint32_t> pieces_;
    std::vector<Node> nodes_;
};

/// Where a ray enters a box, in lengths of its direction; infinite where it does not after `first`. Errs towards the ray's side.
inline float entry(const PieceBox& box, const glm::vec3& origin, const glm::vec3& direction, float first) {
    constexpr float kSlack = 1 + 8 * std::numeric_limits<float>::epsilon(); // of three roundings
    float enters = first;
    float leaves = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const float low = box.low[axis] - origin[axis];
        const float high = box.high[axis] - origin[axis];
        if (direction[axis] == 0) {
            if (low > 0 || high < 0) return std::numeric_limits<float>::infinity();
            continue;
        }
        const auto [near, far] = std::minmax({low / direction[axis], high / direction[axis]});
        enters = std::max(enters, near > 0 ? near / kSlack : near * kSlack);
        leaves = std::min(leaves, far > 0 ? far * kSlack : far / kSlack);
    }
    return enters <= leaves ? enters : std::numeric_limits<float>::infinity();
}

} // namespace tegument
