#include "host/mesh/gltf_draco.h"

#include "host/support/windows/left_out.h"

namespace tegument::meshfile {

Result<DracoMesh> readDraco(const GltfDocument&, const GltfValue&) {
    return leftOut("meshes compressed by Draco (KHR_draco_mesh_compression)");
}

} // namespace tegument::meshfile
