#pragma once
// Inside lab/bench: a piece of surface given by a formula, with its chart.

#include "host/mesh/triangles.h"

#include <functional>

namespace tegument::bench {

/// s and t run from 0 to 1.
struct Patch {
    std::function<glm::dvec3(double s, double t)> position;
    std::function<glm::dvec3(double s, double t)> normal; // outwards, unit
    std::function<glm::dvec2(double s, double t)> uv;
    int columns = 1; // quads along s
    int rows = 1;
};

/// Triangles are counter-clockwise seen from where the normal points.
inline void addPatch(Mesh& mesh, const Patch& patch) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= patch.rows; ++j)
        for (int i = 0; i <= patch.columns; ++i) {
            const double s = static_cast<double>(i) / patch.columns;
            const double t = static_cast<double>(j) / patch.rows;
            mesh.positions.emplace_back(patch.position(s, t));
            mesh.normals.emplace_back(patch.normal(s, t));
            mesh.uvs.emplace_back(patch.uv(s, t));
        }
    constexpr double kStep = 1e-3;
    const glm::dvec3 middle = patch.position(0.5, 0.5);
    const glm::dvec3 facing = glm::cross(patch.position(0.5 + kStep, 0.5) - middle, patch.position(0.5, 0.5 + kStep) - middle);
    const bool flip = glm::dot(facing, patch.normal(0.5, 0.5)) < 0;
    addGrid(mesh.indices, static_cast<std::uint32_t>(patch.columns), static_cast<std::uint32_t>(patch.rows), flip ? "acdadb" : "abdadc",
            first);
}

[[nodiscard]] inline std::function<glm::dvec2(double, double)> rectangle(const glm::dvec2& corner, const glm::dvec2& size) {
    return [=](double s, double t) { return corner + size * glm::dvec2(s, t); };
}

[[nodiscard]] inline std::function<glm::dvec2(double, double)> square(const glm::dvec2& corner, double side) {
    return rectangle(corner, glm::dvec2(side));
}

} // namespace tegument::bench
