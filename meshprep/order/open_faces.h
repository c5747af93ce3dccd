#pragma once
// The faces still to draw, by how much of their surroundings is still to draw.

#include "meshprep/order/links.h"

#include <array>

namespace tegument::order {

/// Faces not drawn, in lists by their number of neighbours not drawn: linked both ways, so that a face changes lists in constant time.
class OpenFaces {
public:
    OpenFaces(std::span<const std::uint32_t> links) : nodes_(links.size() / 3) {
        heads_.fill(kNoLink);
        for (std::size_t f = nodes_.size(); f-- > 0;) {
            for (std::size_t side = 0; side < 3; ++side)
                nodes_[f].neighbours += links[3 * f + side] != kNoLink;
            insert(static_cast<std::uint32_t>(f));
        }
    }

    [[nodiscard]] bool open(std::uint32_t f) const { return nodes_[f].open; }
    [[nodiscard]] std::uint32_t fewestNeighbours() const {
        for (const std::uint32_t head : heads_)
            if (head != kNoLink) return head;
        return kNoLink;
    }
    [[nodiscard]] unsigned neighbours(std::uint32_t f) const { return nodes_[f].neighbours; }
    void closeWithNeighbours(std::uint32_t f, std::span<const std::uint32_t> links) {
        remove(f);
        nodes_[f].open = false;
        for (const std::uint32_t link : links.subspan(std::size_t{3} * f, 3))
            if (link != kNoLink && open(link / 3)) loseNeighbour(link / 3);
    }

private:
    struct Node {
        std::uint32_t before = kNoLink;
        std::uint32_t after = kNoLink;
        std::uint8_t neighbours = 0;
        bool open = true;
    };

    void loseNeighbour(std::uint32_t f) {
        remove(f);
        --nodes_[f].neighbours;
        insert(f);
    }
    void insert(std::uint32_t f) {
        std::uint32_t& head = heads_[nodes_[f].neighbours];
        nodes_[f].before = kNoLink;
        nodes_[f].after = head;
        if (head != kNoLink) nodes_[head].before = f;
        head = f;
    }
    void remove(std::uint32_t f) {
        const Node& node = nodes_[f];
        (node.before != kNoLink ? nodes_[node.before].after : heads_[node.neighbours]) = node.after;
        if (node.after != kNoLink) nodes_[node.after].before = node.before;
    }

    std::vector<Node> nodes_;
    std::array<std::uint32_t, 4> heads_{};
};

} // namespace tegument::order
