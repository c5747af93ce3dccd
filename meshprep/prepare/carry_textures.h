#pragma once
// Textures that lie by one set of charts, drawn anew for another.

#include "host/mesh/mesh.h"

namespace tegument::prep {

/// Gives `mesh` the textures of `before`: the same triangles in the same order, with other texture coordinates. Both have normals and
/// tangents. Squares of about twice as many texels, since charts are neither as large nor as level as they were; colours run on beyond the
/// charts. Gives texels along each side of the largest; 0: there were none.
int carryTextures(const Mesh& before, Mesh& mesh);

} // namespace tegument::prep
