#pragma once
// The weights of a list of links: sources are texels of a pyramid, wide and overlapping, and are so weighed that their sum is nearest to a
// given function over the surface.

#include "meshprep/skin/link_cells.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tegument {

/// A cell of the hierarchy: its texel of the pyramid.
struct LinkSource {
    int level = 0;
    int x = 0;
    int y = 0;
};

/// What the sources of a list gather from: cells of their own level, three along each side, as far as these lie on charts. Made once for a
/// list, for any function.
class LinkFit {
public:
    LinkFit(const LinkCells& cells, std::span<const LinkSource> sources);

    /// Cells that sources gather from, each once.
    [[nodiscard]] const std::vector<LinkSource>& nodes() const { return nodes_; }

    /// Improves weights towards the least squares over the surface between what the sources send, spread as they gather it, and a function:
    /// `means`, its mean over each node, 1/mm^2. No weight falls below 0. `weights`: one for each source.
    void improve(std::span<const float> means, std::span<float> weights) const;

private:
    struct Share {
        std::uint32_t source = 0;
        std::uint32_t node = 0;
        float share = 0;
    };
    void gather(const LinkCells& cells, std::span<const LinkSource> sources);
    void findOverlaps(const LinkCells& cells);

    std::size_t count_ = 0;
    std::vector<LinkSource> nodes_;
    std::vector<std::uint32_t> keys_; // of the nodes, ascending
    std::vector<Share> shares_;       // what sources take of nodes, 1 in all of each source; by nodes
    std::vector<std::size_t> ends_;   // where those of each node end
    std::vector<float> overlap_;      // source by source: the integral of the product of the two, 1/mm^2
};

} // namespace tegument
