#pragma once
// Vertices shared where all that is kept of them is equal, and put in the order in which the triangles ask for them.

#include "meshprep/prepare/surface.h"

#include <span>
#include <vector>

namespace tegument::prep {

/// Joins vertices of one place with equal normals and texture coordinates (0.0 and -0.0 are equal), so that seams of texture coordinates
/// survive. Gives how many went. Call after the normals are made.
std::size_t weldVertices(Surface& surface);

/// Numbers vertices in the order of their first use. Gives how many moved. `others`: further lists of the same vertices, which follow.
std::size_t orderVertices(Mesh& mesh, std::span<std::vector<std::uint32_t>* const> others = {});

} // namespace tegument::prep
