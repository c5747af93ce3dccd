#pragma once
// What effects of fur are drawn on: a small mesh whose parts shadow each other, maps with strands in them, few layers.

#include "tests/d3d/cases.h"

namespace tegument::test {

/// By the effect's name.
[[nodiscard]] bool drawsFur(const Case& drawn);

inline constexpr const char* kFurMeshFile = "fur.bin";

/// A torus, tilted.
[[nodiscard]] Mesh furMesh();

/// The maps as files in the folder of the drawings.
[[nodiscard]] Result<void> writeFurMaps();

/// Roots on the torus, likewise.
/// Makes roots for the mesh and gives it strands on them, which those who do not bend them draw as points.
[[nodiscard]] Result<void> writeFurRoots(Mesh& mesh);

[[nodiscard]] Workspace furWorkspace();

} // namespace tegument::test
