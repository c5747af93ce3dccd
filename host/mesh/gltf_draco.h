#pragma once
// Inside host/mesh only: KHR_draco_mesh_compression.

#include "host/mesh/gltf_document.h"

namespace tegument::meshfile {

/// A primitive as Draco holds it.
struct DracoMesh {
    struct Values {
        std::size_t components = 0;
        std::vector<float> numbers; // normalised integers as 0 to 1, or -1 to 1
    };
    std::size_t vertices = 0;
    std::vector<std::uint32_t> corners; // of triangles, each below `vertices`
    std::map<std::string, Values> attributes;
};

/// What the primitive's extension holds. TG5302 where Draco cannot decode it or an attribute is missing, TG5310 too large.
[[nodiscard]] Result<DracoMesh> readDraco(const GltfDocument& document, const GltfValue& primitive);

} // namespace tegument::meshfile
