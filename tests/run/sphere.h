#pragma once
// A body with texture coordinates, for effects as a whole.

#include "host/mesh/triangles.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tegument::test {

/// A ball with one chart; a seam at u = 0, poles of many vertices.
inline Mesh sphere(float radius = 80, int rings = 24, int sectors = 48) {
    Mesh mesh;
    mesh.name = "sphere";
    for (int ring = 0; ring <= rings; ++ring)
        for (int sector = 0; sector <= sectors; ++sector) {
            const float theta = std::numbers::pi_v<float> * static_cast<float>(ring) / static_cast<float>(rings);
            const float phi = 2 * std::numbers::pi_v<float> * static_cast<float>(sector) / static_cast<float>(sectors);
            const glm::vec3 normal(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            mesh.positions.push_back(radius * normal);
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(std::cos(phi), 0, -std::sin(phi), 1);
            mesh.uvs.emplace_back(static_cast<float>(sector) / static_cast<float>(sectors),
                                  static_cast<float>(ring) / static_cast<float>(rings));
        }
    addGrid(mesh.indices, static_cast<std::uint32_t>(sectors), static_cast<std::uint32_t>(rings), "acbbcd");
    mesh.parts = {{.name = "sphere", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

} // namespace tegument::test
