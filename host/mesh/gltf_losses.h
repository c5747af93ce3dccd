#pragma once
// Inside host/mesh only: what a glTF file holds and a mesh cannot.

#include "host/mesh/gltf_document.h"

namespace tegument::meshfile {

/// One warning (TG5331) for each kind of thing that goes: morph targets, skins, animations, copies that were drawn by one mesh ...
/// `meshes`: the mesh of each draw.
void warnOfLosses(const GltfDocument& document, const std::vector<std::size_t>& meshes, Mesh& mesh);

} // namespace tegument::meshfile
