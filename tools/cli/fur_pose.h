#pragma once
// tegument fur pose: where a body that bends takes the roots of its strands; and the same for a scene with --pose.

#include "tools/cli/commands.h"
#include "tools/cli/scene.h"

namespace tegument::app {

void addFurPose(CLI::App& fur, Action& action);

/// Bends the scene's mesh, which has its strands, as Scene::pose says, and gives the effect the pose of its roots. TG8047 an effect whose
/// strands do not bend.
[[nodiscard]] Result<void> poseStrands(const Effect& effect, const RunOptions& options, Scene& scene);

/// A pose of the mesh: its own file, of the same triangles (TG8048).
[[nodiscard]] Result<Mesh> readPose(const std::string& file, const Mesh& rest, MeshOptions load);

} // namespace tegument::app
