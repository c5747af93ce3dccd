#pragma once
// The edges of any triangle mesh, manifold or not: linear time and memory whatever its valences.

#include "meshprep/prepare/surface.h"

#include <algorithm>
#include <span>

namespace tegument::prep {

/// One side of a triangle, from `corner` to the next corner of the same triangle.
struct HalfEdge {
    std::uint32_t high = 0;   // the end with the larger point number
    std::uint32_t corner = 0; // where the side starts, counted through all triangles
    bool forwards = false;    // starts at the end with the smaller point number

    [[nodiscard]] std::uint32_t triangle() const { return corner / 3; }
};

[[nodiscard]] inline std::uint32_t nextCorner(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Half edges ordered by both their points. Sides of no length (equal points) are left out.
class EdgeTable {
public:
    explicit EdgeTable(const Surface& surface);

    /// `visit(std::span<const HalfEdge>)`: all triangles' sides along one edge, in the triangles' order.
    template <class Visit>
    void forEach(Visit visit) const {
        for (std::size_t low = 0; low + 1 < firstOfLow_.size(); ++low)
            for (std::size_t i = firstOfLow_[low]; i < firstOfLow_[low + 1];) {
                std::size_t end = i + 1;
                while (end < firstOfLow_[low + 1] && halfEdges_[end].high == halfEdges_[i].high)
                    ++end;
                visit(std::span(&halfEdges_[i], end - i));
                i = end;
            }
    }

private:
    std::vector<std::uint32_t> firstOfLow_; // into halfEdges_, by the smaller point
    std::vector<HalfEdge> halfEdges_;
};

} // namespace tegument::prep
