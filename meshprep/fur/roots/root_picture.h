#pragma once
// Roots to look at: the mesh from the front, the right and above, with its strands drawn as lines.

#include "meshprep/fur/roots/roots.h"

namespace tegument {

/// Three views of `side` x `side` pixels, without perspective. A strand is as long as a coat of `furLength` radii makes it; the more its
/// limit shortens it, the redder it is.
[[nodiscard]] Image drawRoots(const Mesh& mesh, const RootSet& set, double furLength, int side);

} // namespace tegument
