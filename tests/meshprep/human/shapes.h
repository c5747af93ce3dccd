#pragma once
// Small meshes of quads with known answers.

#include "meshprep/human/quad_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tegument::shapes {

/// A cube around the origin, normals outwards; every face is a chart of its own.
inline QuadMesh cube(float half) {
    QuadMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back((i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half);
    const std::array<std::array<std::uint32_t, 4>, 6> faces = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& face : faces) {
        const auto first = static_cast<std::uint32_t>(mesh.uvs.size());
        mesh.uvs.insert(mesh.uvs.end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        mesh.quads.push_back({.position = face, .uv = {first, first + 1, first + 2, first + 3}});
    }
    return mesh;
}

/// n x n unit squares in the plane z = 0, facing +z, texture coordinates equal to x and y.
inline QuadMesh grid(std::uint32_t n) {
    QuadMesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x) {
            mesh.positions.emplace_back(x, y, 0);
            mesh.uvs.emplace_back(x, y);
        }
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t first = y * (n + 1) + x;
            const std::array<std::uint32_t, 4> corners = {first, first + 1, first + n + 2, first + n + 1};
            mesh.quads.push_back({.position = corners, .uv = corners});
        }
    return mesh;
}

/// Adds `other` to `mesh` as it is.
inline void append(QuadMesh& mesh, const QuadMesh& other) {
    const auto positions = static_cast<std::uint32_t>(mesh.positions.size());
    const auto uvs = static_cast<std::uint32_t>(mesh.uvs.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    mesh.uvs.insert(mesh.uvs.end(), other.uvs.begin(), other.uvs.end());
    for (Quad quad : other.quads) {
        for (std::size_t c = 0; c < 4; ++c) {
            quad.position[c] += positions;
            quad.uv[c] += uvs;
        }
        mesh.quads.push_back(quad);
    }
}

} // namespace tegument::shapes
