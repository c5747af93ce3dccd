#pragma once
// Meshes whose curvature, area and distances are known.

#include "host/mesh/triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tegument::testing_roots {

inline Mesh finished(Mesh mesh) {
    mesh.parts = {{.name = "all", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

/// A sphere cut by longitude and latitude: long thin triangles at the poles, some of no area. Seen from outside, or from inside.
inline Mesh ball(double radius, int rows = 64, bool inside = false) {
    Mesh mesh;
    const int columns = 2 * rows;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const double theta = std::numbers::pi * j / rows;
            const double phi = 2 * std::numbers::pi * i / columns;
            const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
            mesh.positions.emplace_back(radius * n);
            mesh.normals.emplace_back(inside ? -n : n);
        }
    addGrid(mesh.indices, static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), inside ? "adcabd" : "acdadb");
    return finished(std::move(mesh));
}

/// A square plate of side 100 at height z, cut into 2 x 2 x 10 x 10 triangles of different sizes, looking up or down, with texture
/// coordinates.
inline void addPlate(Mesh& mesh, double z, bool down = false) {
    constexpr int kCuts = 10;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= kCuts; ++j)
        for (int i = 0; i <= kCuts; ++i) {
            const double x = std::pow(static_cast<double>(i) / kCuts, 2); // a hundred times as many triangles on one side
            const double y = static_cast<double>(j) / kCuts;
            mesh.positions.emplace_back(100 * x, 100 * y, z);
            mesh.normals.emplace_back(0, 0, down ? -1 : 1);
            mesh.uvs.emplace_back(x, 1 - y);
            mesh.tangents.emplace_back(1, 0, 0, 1);
        }
    addGrid(mesh.indices, kCuts, kCuts, down ? "adbacd" : "abdadc", first);
}

inline Mesh plate() {
    Mesh mesh;
    addPlate(mesh, 0);
    return finished(std::move(mesh));
}

} // namespace tegument::testing_roots
