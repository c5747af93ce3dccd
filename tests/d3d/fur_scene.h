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
[[nodiscard]] Result<void> writeFurRoots();

[[nodiscard]] Workspace furWorkspace();

} // namespace tegument::test
