#pragma once
// Inside host/mesh only: what of a glTF file moves its meshes.

#include "host/mesh/gltf_document.h"
#include "host/mesh/motion.h"

#include <functional>
#include <span>

namespace tegument::meshfile {

/// Nodes, skins and animations, without runs; null where nothing moves: no animation, and no skin or morph target of a mesh that is drawn.
/// `nodes`: those that draw. An animation that cannot be read is left out with a warning (TG5331); other faults are errors.
[[nodiscard]] Result<std::shared_ptr<Motion>> readMotion(const GltfDocument& document, std::span<const std::size_t> nodes, Mesh& warnings);

/// The joints, weights and morph targets of a run, whose other fields are set; `floats` reads an attribute of the primitive.
[[nodiscard]] std::optional<Error> readRun(const GltfDocument& document, const GltfValue& mesh, const GltfValue& primitive,
                                           const std::function<Result<std::vector<float>>(const std::string& name)>& floats,
                                           const Motion& motion, MotionRun& run, Mesh& warnings);

/// Fills `kinds` when all runs are there.
void findKinds(Motion& motion);

} // namespace tegument::meshfile
