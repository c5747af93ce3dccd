// One step of meshoptimizer's simplification, of all parts as one surface.

#include "meshprep/prepare/centre.h"
#include "meshprep/prepare/levels.h"
#include "meshprep/prepare/simplify.h"

#include <algorithm>

namespace tegument::prep {

namespace {

/// Along the longest side of a mesh. Both sides of a seam may differ in their last bits, as where sin(2 pi) is not 0: rounded they are one
/// place again, and move together.
constexpr float kQuickSteps = 65536;

} // namespace

std::vector<std::uint32_t> quickLevel(const Mesh& mesh, std::size_t triangles) {
    std::vector<glm::vec3> positions = atUnitSize(mesh.positions);
    for (glm::vec3& position : positions)
        position = glm::round(position * kQuickSteps) / kQuickSteps;
    std::vector<SimplifiedAttributes> attributes;
    for (std::size_t vertex = 0; vertex < mesh.normals.size(); ++vertex) {
        const glm::vec3& n = mesh.normals[vertex];
        const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[vertex];
        attributes.push_back({n.x, n.y, n.z, uv.x, uv.y});
    }
    return simplify({.from = mesh.indices,
                     .positions = positions,
                     .attributes = attributes,
                     .counted = mesh.uvs.empty() ? 3U : 5U,
                     .triangles = triangles},
                    kNormalWeights[0]);
}

} // namespace tegument::prep
