#pragma once
// A mesh on which every technique of the skin has something to show.

#include "host/mesh/triangles.h"
#include "tests/run/fixture.h"

#include <cmath>

namespace tegument::test {

inline Image blankImage(int size) {
    return {.width = size, .height = size, .channels = 4, .pixels = std::vector<float>(static_cast<std::size_t>(4 * size * size), 1.0F)};
}

/// A bent sheet, 80 x 80 mm, waves of 6 mm: it shades itself, and has slopes in both directions.
inline Mesh sheet() {
    constexpr int kSide = 32;
    Mesh mesh;
    mesh.name = "sheet";
    for (int y = 0; y <= kSide; ++y)
        for (int x = 0; x <= kSide; ++x) {
            const glm::vec2 uv = glm::vec2(x, y) / static_cast<float>(kSide);
            mesh.positions.emplace_back(80 * uv.x - 40, 40 - 80 * uv.y, 6 * std::sin(9 * uv.x) * std::cos(7 * uv.y) - 30 * uv.x * uv.x);
            mesh.uvs.push_back(0.02F + 0.96F * uv);
        }
    addGrid(mesh.indices, kSide, kSide, "acbbcd");
    mesh.parts = {{.name = "sheet", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeNormals(mesh);
    computeTangents(mesh);
    computeBounds(mesh);
    return mesh;
}

/// Waves, so that tangents matter.
inline Image relief() {
    Image image = blankImage(64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::vec3 normal =
                glm::normalize(glm::vec3(0.4F * std::sin(0.5F * static_cast<float>(x)), 0.3F * std::sin(0.4F * static_cast<float>(y)), 1));
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = 0.5F + 0.5F * normal[c];
        }
    return image;
}

inline Mesh reliefSheet() {
    Mesh mesh = sheet();
    mesh.textures = {{.role = "normal", .image = relief()}};
    return mesh;
}

} // namespace tegument::test
