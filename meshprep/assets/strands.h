#pragma once
// Strands of fur and hair as ribbons of a mesh, grown where an effect draws them; and bodies that bend, with their strands.

#include "meshprep/assets/generators.h"
#include "meshprep/assets/scene.h"
#include "meshprep/fur/roots/root_texture.h"

#include <filesystem>

namespace tegument::assets {

/// Roots from a file for this mesh. TG4055: they were made for another one.
[[nodiscard]] Result<Image> loadRoots(const std::string& file, const Mesh& mesh);

/// Roots beside a mesh with strands that are curves: the mesh of `tegument fur import`. Nothing for others.
[[nodiscard]] std::optional<RootHeader> curvesBeside(const std::filesystem::path& meshFile);

/// Gives meshes the part "strands" where a pass of the effect draws it and they have none: from the roots that the scene names, or that
/// are made for them (generators.h). A mesh with strands gets the roots of its name that lie beside it, where nothing names others.
/// `meshFile`: of a scene of one mesh.
[[nodiscard]] Result<void> growStrands(const Effect& effect, const RunOptions& options, Scene& scene,
                                       const std::filesystem::path& meshFile);

/// Bends the scene's mesh, which has its strands, as Scene::pose says, and gives the effect the pose of its roots. TG8047 an effect whose
/// strands do not bend.
[[nodiscard]] Result<void> poseStrands(const Effect& effect, const RunOptions& options, Scene& scene);

/// A pose of the mesh: its own file, of the same triangles (TG8048).
[[nodiscard]] Result<Mesh> readPose(const std::string& file, const Mesh& rest, MeshOptions load);

} // namespace tegument::assets
