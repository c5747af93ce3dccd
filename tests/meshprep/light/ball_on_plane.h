#pragma once
// A plane over its whole map, and a ball that hides light from it.

#include "host/mesh/triangles.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tegument::test {

/// A square of side 200 mm in y = 0 that faces up, over the whole map.
inline Mesh plane() {
    Mesh mesh;
    mesh.name = "plane";
    for (int i = 0; i < 4; ++i) {
        const glm::vec2 corner(i & 1, i >> 1);
        mesh.positions.emplace_back(200.0F * (corner.x - 0.5F), 0.0F, 200.0F * (corner.y - 0.5F));
        mesh.normals.emplace_back(0, 1, 0);
        mesh.tangents.emplace_back(1, 0, 0, 1);
        mesh.uvs.push_back(corner);
    }
    mesh.indices = {0, 2, 1, 1, 2, 3};
    mesh.parts = {{.name = "plane", .firstIndex = 0, .indexCount = 6}};
    mesh.bounds = {.minimum = {-100, 0, -100}, .maximum = {100, 0, 100}, .centre = {0, 0, 0}, .radius = 142};
    return mesh;
}

/// Without texture coordinates in the square: it hides, and is not baked. `inwards` turns it over.
inline void addBall(Mesh& mesh, glm::vec3 centre, float radius, bool baked) {
    constexpr double kHalfTurn = std::numbers::pi;
    constexpr int kRows = 64;
    constexpr int kColumns = 128;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int y = 0; y <= kRows; ++y)
        for (int x = 0; x <= kColumns; ++x) {
            const double down = kHalfTurn * y / kRows;
            const double around = 2 * kHalfTurn * x / kColumns;
            const glm::vec3 d(std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around));
            mesh.positions.push_back(centre + radius * d);
            mesh.normals.push_back(baked ? -d : d);
            mesh.tangents.emplace_back(std::sin(around), 0, -std::cos(around), 1);
            mesh.uvs.push_back(baked ? glm::vec2(x, y) / glm::vec2(kColumns, kRows) : glm::vec2(-5));
        }
    addGrid(mesh.indices, kColumns, kRows, "abcbdc", first);
}

} // namespace tegument::test
