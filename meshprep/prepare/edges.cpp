#include "meshprep/prepare/edges.h"

#include "host/support/parallel.h"

#include <algorithm>

namespace tegument::prep {

EdgeTable::EdgeTable(const Surface& surface) : firstOfLow_(std::size_t{surface.pointCount} + 1, 0) {
    const auto ends = [&](std::uint32_t corner) { return std::pair(surface.pointAt(corner), surface.pointAt(nextCorner(corner))); };
    const auto count = static_cast<std::uint32_t>(surface.mesh.indices.size());
    for (std::uint32_t corner = 0; corner < count; ++corner)
        if (const auto [a, b] = ends(corner); a != b) ++firstOfLow_[std::min(a, b) + 1];
    for (std::size_t i = 1; i < firstOfLow_.size(); ++i)
        firstOfLow_[i] += firstOfLow_[i - 1];
    halfEdges_.resize(firstOfLow_.back());
    std::vector<std::uint32_t> next(firstOfLow_.begin(), firstOfLow_.end() - 1);
    for (std::uint32_t corner = 0; corner < count; ++corner)
        if (const auto [a, b] = ends(corner); a != b)
            halfEdges_[next[std::min(a, b)]++] = {.high = std::max(a, b), .corner = corner, .forwards = a < b};
    inChunks(surface.pointCount, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t low = first; low < last; ++low)
            std::sort(halfEdges_.begin() + firstOfLow_[low], halfEdges_.begin() + firstOfLow_[low + 1],
                      [](const HalfEdge& a, const HalfEdge& b) { return std::pair(a.high, a.corner) < std::pair(b.high, b.corner); });
    });
}

} // namespace tegument::prep
