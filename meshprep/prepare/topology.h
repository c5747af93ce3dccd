#pragma once
// How the triangles hang together: what a report says about it, and the fans round each place.

#include "host/support/disjoint_sets.h"
#include "meshprep/prepare/edges.h"

namespace tegument::prep {

struct Topology {
    std::size_t boundaryEdges = 0; // of one triangle
    std::size_t crowdedEdges = 0;  // of more than two
    std::size_t opposedEdges = 0;  // of two triangles that are seen from opposite sides
    std::size_t bowTies = 0;       // places where more than one fan of triangles meets
    std::size_t backToBackPairs = 0;
    std::size_t flatTriangles = 0; // three places on one line
    std::size_t components = 0;    // joined by places
};

/// Corners of one fan: triangles round one place that are joined by edges and seen from one side. Triangles back to back are not joined,
/// so that the two sheets of a doubled surface stay apart.
[[nodiscard]] DisjointSets cornerFans(const Surface& surface, const EdgeTable& edges, const std::vector<std::uint32_t>& backToBack);

[[nodiscard]] Topology examine(const Surface& surface);

struct Oriented {
    std::size_t turned = 0;     // triangles that were seen from the other side than most of their component
    std::size_t doubles = 0;    // left out: of triangles back to back one, where most of the mesh is so
    std::size_t turnedOver = 0; // then, of shells and open parts that faced inwards
    std::size_t shells = 0;     // so many of these are closed
};

/// Makes the triangles face outwards: those that differ from their component's majority are turned, then each closed shell that is inside
/// out, and what is open, as one, where it faces inwards.
Oriented orient(Surface& surface);

/// How many closed shells are inside out, where neighbours agree on their sides.
[[nodiscard]] std::size_t shellsInsideOut(Surface surface);

} // namespace tegument::prep
