#include "meshprep/skin/link_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument {

namespace {

const LinkCell& cellIn(const LinkCells& cells, const LinkTreeCell& at) {
    return cells.at(at.level, at.x, at.y);
}

} // namespace

LinkTree::LinkTree(const LinkCells& cells, float extent) {
    const int top = kLinkLevels - 1;
    for (int i = 0; i < LinkCells::side(top) * LinkCells::side(top); ++i)
        collect(cells, top, i % LinkCells::side(top), i / LinkCells::side(top), extent);
    nodes_.reserve(2 * cells_.size());
    if (!cells_.empty()) build(cells, 0, static_cast<std::uint32_t>(cells_.size()));
}

void LinkTree::collect(const LinkCells& cells, int level, int x, int y, float extent) {
    const LinkCell& cell = cells.at(level, x, y);
    if (!(cell.area > 0)) return;
    if (level == 0 || std::numbers::sqrt2_v<float> * cell.radius <= extent) {
        cells_.push_back(
            {.level = static_cast<std::uint8_t>(level), .x = static_cast<std::uint16_t>(x), .y = static_cast<std::uint16_t>(y)});
        return;
    }
    for (int i = 0; i < 4; ++i)
        collect(cells, level - 1, 2 * x + i % 2, 2 * y + i / 2, extent);
}

void LinkTree::build(const LinkCells& cells, std::uint32_t first, std::uint32_t end) {
    Node node{.first = first, .end = end, .largest = first};
    glm::vec3 low(INFINITY), high(-INFINITY), sum(0);
    for (std::uint32_t i = first; i < end; ++i) {
        const LinkCell& cell = cellIn(cells, cells_[i]);
        node.area += cell.area;
        sum += cell.area * cell.place;
        low = glm::min(low, cell.place);
        high = glm::max(high, cell.place);
        if (cell.area > cellIn(cells, cells_[node.largest]).area) node.largest = i;
    }
    node.place = sum / node.area;
    for (std::uint32_t i = first; i < end; ++i) {
        const LinkCell& cell = cellIn(cells, cells_[i]);
        node.radius = std::max(node.radius, glm::length(cell.place - node.place) + cell.radius);
    }
    const std::size_t index = nodes_.size();
    nodes_.push_back(node);
    if (end - first == 1) return;
    const glm::vec3 size = high - low;
    const glm::length_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = first + (end - first) / 2;
    std::nth_element(
        cells_.begin() + first, cells_.begin() + middle, cells_.begin() + end,
        [&](const LinkTreeCell& a, const LinkTreeCell& b) { return cellIn(cells, a).place[axis] < cellIn(cells, b).place[axis]; });
    build(cells, first, middle);
    nodes_[index].second = static_cast<std::uint32_t>(nodes_.size());
    build(cells, middle, end);
    // Cells have moved since the largest was found.
    const std::uint32_t a = nodes_[index + 1].largest, b = nodes_[nodes_[index].second].largest;
    nodes_[index].largest = cellIn(cells, cells_[a]).area >= cellIn(cells, cells_[b]).area ? a : b;
}

} // namespace tegument
