#pragma once
// An independent judge of how triangles hang together: OpenMesh's half-edges, which take a triangle only where the result is a 2-manifold
// but for bow ties. Our own figures come from a table of edges (meshprep/prepare/topology.h).

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tegument::testing_prep {

struct HalfEdgeFigures {
    std::size_t refused = 0; // triangles that would give an edge a third one, or meet a neighbour from its other side
    std::size_t boundaryEdges = 0;
    std::size_t boundaryLoops = 0;
    std::size_t bowTies = 0;
    std::size_t components = 0; // joined by places
    std::ptrdiff_t euler = 0;   // places - edges + triangles; bow ties count once

    /// Handles of all components together, where nothing is refused and there is no bow tie.
    [[nodiscard]] std::ptrdiff_t genus() const {
        return (2 * static_cast<std::ptrdiff_t>(components) - euler - static_cast<std::ptrdiff_t>(boundaryLoops)) / 2;
    }
};

/// `places` are of each corner; equal numbers are one place.
[[nodiscard]] HalfEdgeFigures judge(std::span<const std::uint32_t> places, std::size_t count);

/// OpenMesh's own simplification by quadrics, down to about `target` triangles.
[[nodiscard]] std::vector<std::uint32_t> simplifyElsewhere(std::span<const std::uint32_t> indices, const std::vector<glm::vec3>& positions,
                                                           std::size_t target);

} // namespace tegument::testing_prep
