#pragma once
// Which triangle of a mesh each root of fur stands on.

#include "host/image/image.h"
#include "host/mesh/mesh.h"

#include <cstdint>
#include <vector>

namespace tegument::assets {

/// Of the roots that the texture holds, in their order; by the places of the mesh as it is. None where it holds no roots.
[[nodiscard]] std::vector<std::uint32_t> rootsOnMesh(const Mesh& mesh, const Image& roots);

} // namespace tegument::assets
