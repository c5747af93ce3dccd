#include "meshprep/prepare/near_surface.h"

#include <algorithm>
#include <bit>

namespace tegument::prep {

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// More than what points of the unit cube lose when they become floats.
constexpr float kRounded = 1e-7f;

struct Keyed {
    std::uint32_t key = 0;
    std::uint32_t triangle = 0;
};

/// Ten bits, two zeros between each and the next.
std::uint32_t spreadOut(std::uint32_t bits) {
    bits = (bits | bits << 16u) & 0x030000FFu;
    bits = (bits | bits << 8u) & 0x0300F00Fu;
    bits = (bits | bits << 4u) & 0x030C30C3u;
    return (bits | bits << 2u) & 0x09249249u;
}

/// Along the curve that visits the cells of a grid octant by octant (G. M. Morton, 1966).
std::uint32_t placeOnCurve(const glm::dvec3& point) {
    const glm::uvec3 cell(glm::clamp(point, 0.0, 1.0) * 1023.0);
    return spreadOut(cell.x) | spreadOut(cell.y) << 1u | spreadOut(cell.z) << 2u;
}

/// By digits, from the last one on.
void sortByKey(std::vector<Keyed>& list) {
    constexpr unsigned kBits = 10;
    constexpr std::uint32_t kMask = (1u << kBits) - 1;
    std::vector<Keyed> sorted(list.size());
    for (unsigned shift = 0; shift < 3 * kBits; shift += kBits) {
        std::array<std::uint32_t, kMask + 2> first{};
        for (const Keyed& item : list)
            ++first[(item.key >> shift & kMask) + 1];
        for (std::size_t i = 1; i < first.size(); ++i)
            first[i] += first[i - 1];
        for (const Keyed& item : list)
            sorted[first[item.key >> shift & kMask]++] = item;
        list.swap(sorted);
    }
}

std::vector<Keyed> alongTheCurve(std::span<const glm::dvec3> points, std::span<const std::uint32_t> triangles) {
    std::vector<Keyed> list(triangles.size() / 3);
    for (std::uint32_t i = 0; i < list.size(); ++i) {
        const std::uint32_t* t = &triangles[3 * std::size_t{i}];
        list[i] = {.key = placeOnCurve((points[t[0]] + points[t[1]] + points[t[2]]) / 3.0), .triangle = i};
    }
    sortByKey(list);
    return list;
}

struct Box {
    glm::vec3 low{kFar};
    glm::vec3 high{-kFar};
};

struct Slice {
    std::uint32_t first = 0;
    std::uint32_t last = 0; // behind the slice

    [[nodiscard]] std::uint32_t count() const { return last - first; }
};

} // namespace

/// From the top down: a slice of triangles along the curve is cut where the first bit of their places changes.
class NearTree::Builder {
public:
    Builder(NearTree& tree, std::span<const glm::dvec3> points, std::span<const std::uint32_t> triangles)
        : tree_(tree), points_(points), corners_(triangles), list_(alongTheCurve(points, triangles)) {}

    void build() {
        tree_.triangles_.reserve(list_.size());
        for (const Keyed& item : list_)
            tree_.triangles_.push_back(item.triangle);
        tree_.nodes_.reserve(list_.size() / 6);
        Box all;
        tree_.root_ = part({.first = 0, .last = static_cast<std::uint32_t>(list_.size())}, all);
    }

private:
    std::uint32_t part(const Slice& slice, Box& box) {
        if (slice.count() > kMostInLeaf) return node(slice, box);
        for (std::uint32_t i = slice.first; i < slice.last; ++i)
            for (const std::uint32_t corner : corners_.subspan(3 * std::size_t{list_[i].triangle}, 3)) {
                const glm::vec3 point(points_[corner]);
                box.low = glm::min(box.low, point - kRounded);
                box.high = glm::max(box.high, point + kRounded);
            }
        return kLeaf | (slice.count() - 1) << 29u | slice.first;
    }

    std::uint32_t node(const Slice& slice, Box& box) {
        const auto number = static_cast<std::uint32_t>(tree_.nodes_.size());
        tree_.nodes_.emplace_back();
        std::array<Slice, kWide> slices{slice};
        const std::size_t count = cutUp(slices);
        for (std::size_t i = 0; i < kWide; ++i) {
            Box own;
            const std::uint32_t inside = i < count ? part(slices[i], own) : 0;
            Node& node = tree_.nodes_[number]; // parts add nodes
            node.inside[i] = inside;
            for (int axis = 0; axis < 3; ++axis) {
                node.low[static_cast<std::size_t>(axis)][i] = own.low[axis];
                node.high[static_cast<std::size_t>(axis)][i] = own.high[axis];
            }
            box.low = glm::min(box.low, own.low);
            box.high = glm::max(box.high, own.high);
        }
        return number;
    }

    /// The longest slice again and again.
    std::size_t cutUp(std::array<Slice, kWide>& slices) const {
        std::size_t count = 1;
        while (count < kWide) {
            Slice& longest = *std::max_element(slices.begin(), slices.begin() + static_cast<std::ptrdiff_t>(count),
                                               [](const Slice& a, const Slice& b) { return a.count() < b.count(); });
            if (longest.count() <= kMostInLeaf) break;
            const std::uint32_t middle = cutOf(longest);
            slices[count++] = {.first = middle, .last = longest.last};
            longest.last = middle;
        }
        return count;
    }

    [[nodiscard]] std::uint32_t cutOf(const Slice& slice) const {
        const std::uint32_t differ = list_[slice.first].key ^ list_[slice.last - 1].key;
        if (differ == 0) return slice.first + slice.count() / 2;
        const std::uint32_t bit = std::bit_floor(differ);
        const auto behind = std::partition_point(list_.begin() + slice.first, list_.begin() + slice.last,
                                                 [&](const Keyed& item) { return (item.key & bit) == 0; });
        return static_cast<std::uint32_t>(behind - list_.begin());
    }

    NearTree& tree_;
    std::span<const glm::dvec3> points_;
    std::span<const std::uint32_t> corners_;
    std::vector<Keyed> list_;
};

NearTree::NearTree(std::span<const glm::dvec3> points, std::span<const std::uint32_t> triangles) {
    if (!triangles.empty()) Builder(*this, points, triangles).build();
}

} // namespace tegument::prep
