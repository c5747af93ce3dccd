#pragma once
// A large mesh as pieces whose indices have 16 bits.

#include "meshprep/write/glb.h"

#include <span>

namespace tegument::prep {

struct Chunks {
    std::size_t count = 0;      // of the full mesh
    std::size_t duplicates = 0; // vertices that more than one of its pieces uses, counted once less
};

/// Cuts the parts of the mesh, and of its levels, into runs of triangles with at most 65,535 vertices, in the order in which they are
/// drawn. Each run becomes a part with vertices of its own.
Chunks cutIntoChunks(Mesh& mesh, std::span<MeshLevel* const> levels);

} // namespace tegument::prep
