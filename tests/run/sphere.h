#pragma once
// A body with texture coordinates, for effects as a whole.

#include "host/mesh/mesh.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tegument::test {

/// A sphere of 80 mm with one chart; a seam at u = 0, poles of many vertices.
inline Mesh sphere() {
    constexpr int kRings = 24;
    constexpr int kSectors = 48;
    Mesh mesh;
    mesh.name = "sphere";
    for (int ring = 0; ring <= kRings; ++ring)
        for (int sector = 0; sector <= kSectors; ++sector) {
            const float theta = std::numbers::pi_v<float> * static_cast<float>(ring) / kRings;
            const float phi = 2 * std::numbers::pi_v<float> * static_cast<float>(sector) / kSectors;
            const glm::vec3 normal(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            mesh.positions.push_back(80.0F * normal);
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(std::cos(phi), 0, -std::sin(phi), 1);
            mesh.uvs.emplace_back(static_cast<float>(sector) / kSectors, static_cast<float>(ring) / kRings);
        }
    for (std::uint32_t ring = 0; ring < kRings; ++ring)
        for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
            const std::uint32_t a = ring * (kSectors + 1) + sector;
            const std::uint32_t b = a + kSectors + 1;
            for (const std::uint32_t index : {a, b, a + 1, a + 1, b, b + 1})
                mesh.indices.push_back(index);
        }
    mesh.parts = {{.name = "sphere", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

} // namespace tegument::test
