#pragma once
// Shapes whose light is known in closed form.

#include "host/mesh/triangles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tegument::reference {

/// A square in the plane z = `height`, from -half to half, of cells x cells x 2 triangles; inner vertices moved aside, so that no edge
/// follows an axis. Faces up; uv over the whole.
inline Mesh plane(float half, std::uint32_t cells, float height = 0) {
    Mesh mesh;
    for (std::uint32_t y = 0; y <= cells; ++y)
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const bool inner = x > 0 && y > 0 && x < cells && y < cells;
            const auto u = static_cast<float>(x) + (inner ? 0.3F * std::sin(12.9F * static_cast<float>(x + 7 * y)) : 0);
            const auto v = static_cast<float>(y) + (inner ? 0.3F * std::cos(8.7F * static_cast<float>(3 * x + y)) : 0);
            const glm::vec2 uv = glm::vec2(u, v) / static_cast<float>(cells);
            mesh.positions.emplace_back(half * (2 * uv.x - 1), half * (2 * uv.y - 1), height);
            mesh.normals.emplace_back(0, 0, 1);
            mesh.tangents.emplace_back(1, 0, 0, 1);
            mesh.uvs.push_back(uv);
        }
    addGrid(mesh.indices, cells, cells, "abcbdc");
    return mesh;
}

/// Both, in one mesh.
inline Mesh joined(Mesh a, const Mesh& b) {
    const auto offset = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
    a.tangents.insert(a.tangents.end(), b.tangents.begin(), b.tangents.end());
    a.uvs.insert(a.uvs.end(), b.uvs.begin(), b.uvs.end());
    for (const std::uint32_t index : b.indices)
        a.indices.push_back(index + offset);
    return a;
}

/// An octahedron whose edges are halved `levels` times, every vertex on the sphere; (0, 0, 1) is one.
inline Mesh sphereMesh(float radius, int levels) {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
            if (fresh) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
            return at->second;
        };
        const std::vector<std::uint32_t> coarse = std::exchange(mesh.indices, {});
        for (std::size_t t = 0; t < coarse.size(); t += 3) {
            const std::uint32_t a = coarse[t], b = coarse[t + 1], c = coarse[t + 2];
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const std::uint32_t corner : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca})
                mesh.indices.push_back(corner);
        }
    }
    mesh.normals = mesh.positions;
    for (glm::vec3& position : mesh.positions)
        position *= radius;
    return mesh;
}

} // namespace tegument::reference
