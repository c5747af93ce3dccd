#pragma once
// Meshes to order: generated ones by name, any file by path.

#include "host/support/result.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace tegument::testing_order {

struct Triangles {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] std::size_t faces() const { return indices.size() / 3; }
};

/// "sphere", "terrain", with ":N" for another detail than that of a million triangles; otherwise a mesh file, packed (.gz, .xz) or not.
/// Vertices of one place are one (0 = -0); triangles without area by their places and vertices of no triangle are left out.
[[nodiscard]] Result<Triangles> loadTriangles(const std::string& what);

/// Vertices, triangles and first corners in random order; seed 0: as they are.
[[nodiscard]] Triangles shuffled(const Triangles& mesh, std::uint32_t seed);

} // namespace tegument::testing_order
