#pragma once
// The cells of a surface by where they lie in space. Cells of an atlas of a few charts reach only as far as their charts; one of thousands
// of charts has cells that hold pieces from everywhere, and finding the near ones through the map would visit all of them.

#include "meshprep/skin/link_cells.h"

namespace tegument {

struct LinkTreeCell {
    std::uint8_t level = 0;
    std::uint16_t x = 0;
    std::uint16_t y = 0;
};

class LinkTree {
public:
    /// A ball that holds cells. Nodes stand in order: the first half of a node's cells is the next node.
    struct Node {
        glm::vec3 place{0};
        float radius = 0;
        float area = 0;
        std::uint32_t first = 0; // of cells()
        std::uint32_t end = 0;
        std::uint32_t largest = 0; // the cell with the most area
        std::uint32_t second = 0;  // the node of the second half; 0 for one cell
    };

    /// Of the largest cells of at most this extent, and those of the finest level.
    LinkTree(const LinkCells& cells, float extent);

    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<LinkTreeCell>& cells() const { return cells_; }

private:
    void collect(const LinkCells& cells, int level, int x, int y, float extent);
    void build(const LinkCells& cells, std::uint32_t first, std::uint32_t end);

    std::vector<LinkTreeCell> cells_;
    std::vector<Node> nodes_;
};

} // namespace tegument
