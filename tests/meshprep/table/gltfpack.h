#pragma once
// gltfpack (npm) as its users call it.

#include "host/mesh/mesh.h"

#include <filesystem>
#include <optional>

namespace tegument::testing_prep {

struct Packed {
    Mesh mesh;
    double seconds = 0; // of the program, with its start
};

/// The mesh after `gltfpack -noq`, with `-si share` where the share of triangles is below 1. `tools`: a folder with node_modules/gltfpack.
[[nodiscard]] std::optional<Packed> packedBy(const std::filesystem::path& tools, const Mesh& mesh, double share);

} // namespace tegument::testing_prep
