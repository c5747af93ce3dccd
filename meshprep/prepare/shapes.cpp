#include "meshprep/prepare/shapes.h"

#include "host/mesh/triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tegument::prep {

namespace {

Mesh named(const char* name) {
    Mesh mesh;
    mesh.name = name;
    return mesh;
}

void addSoupTriangle(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    for (const glm::vec3& p : {a, b, c}) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(glm::vec3(p));
    }
}

Mesh makeCube() {
    Mesh mesh = named("cube");
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 normal(0);
            glm::vec3 u(0);
            glm::vec3 v(0);
            normal[axis] = side;
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = side;
            addSoupTriangle(mesh, normal - u - v, normal + u - v, normal + u + v);
            addSoupTriangle(mesh, normal - u - v, normal + u + v, normal - u + v);
        }
    return mesh;
}

Mesh makeTorus() {
    constexpr int kRings = 16;
    constexpr int kSides = 12;
    Mesh mesh = named("torus");
    const auto at = [](int ring, int side) {
        const double a = 2 * std::numbers::pi * (ring % kRings) / kRings;
        const double b = 2 * std::numbers::pi * (side % kSides) / kSides;
        const double r = 1 + 0.4 * std::cos(b);
        return glm::vec3(r * std::cos(a), 0.4 * std::sin(b), r * std::sin(a));
    };
    for (int ring = 0; ring < kRings; ++ring)
        for (int side = 0; side < kSides; ++side) {
            addSoupTriangle(mesh, at(ring, side), at(ring, side + 1), at(ring + 1, side + 1));
            addSoupTriangle(mesh, at(ring, side), at(ring + 1, side + 1), at(ring + 1, side));
        }
    return mesh;
}

/// A 32-bit finaliser (C. Wellons, hash prospector, 2018).
std::uint32_t mixed(std::uint32_t x) {
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

/// Value noise on the integer lattice, 0 to 1, smooth by t^2 (3 - 2t).
float noise(const glm::vec3& p) {
    const glm::vec3 floor = glm::floor(p);
    const auto x = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor.x));
    const auto y = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor.y));
    const auto z = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor.z));
    glm::vec3 t = p - floor;
    t = t * t * (3.0f - 2.0f * t);
    const auto value = [&](std::uint32_t dx, std::uint32_t dy, std::uint32_t dz) {
        const std::uint32_t hash = mixed((x + dx) * 73856093u ^ (y + dy) * 19349663u ^ (z + dz) * 83492791u);
        return static_cast<float>(hash) * (1.0f / 4294967296.0f);
    };
    const auto blend = [](float a, float b, float s) { return a + (b - a) * s; };
    const auto plane = [&](std::uint32_t dz) {
        return blend(blend(value(0, 0, dz), value(1, 0, dz), t.x), blend(value(0, 1, dz), value(1, 1, dz), t.x), t.y);
    };
    return blend(plane(0), plane(1), t.z);
}

/// Five octaves of it.
float roughness(glm::vec3 p) {
    float sum = 0;
    float amplitude = 0.5f;
    for (int octave = 0; octave < 5; ++octave) {
        sum += amplitude * noise(p);
        p = p * 2.03f + glm::vec3(1.7f, 9.2f, 3.1f);
        amplitude *= 0.5f;
    }
    return sum;
}

glm::vec3 displaced(const glm::vec3& p) {
    return p * (1 + 0.35f * (roughness(p * 2.5f + glm::vec3(5)) - 0.5f) + 0.02f * (noise(p * 200.0f) - 0.5f));
}

constexpr std::array<std::array<int, 3>, 20> kIcosahedron = {
    {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
     {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

glm::dvec3 icosahedronCorner(int i) {
    const double t = static_cast<double>((1 + std::sqrt(5.0f)) / 2);
    const double sign = i % 2 == 0 ? -1 : 1;
    const double height = i % 4 < 2 ? t : -t;
    if (i < 4) return {sign, height, 0};
    if (i < 8) return {0, sign, height};
    return {height, 0, sign};
}

/// Weights sum to the detail. The corners are added in the order of their numbers, so that a point on an edge comes out the same from both
/// its faces.
glm::vec3 onSphere(const std::array<int, 3>& face, const std::array<int, 3>& weights) {
    std::array<std::pair<int, int>, 3> terms{};
    for (std::size_t i = 0; i < 3; ++i)
        terms[i] = {face[i], weights[i]};
    std::ranges::sort(terms);
    glm::dvec3 sum(0);
    for (const auto& [corner, weight] : terms)
        sum += static_cast<double>(weight) * icosahedronCorner(corner);
    return glm::vec3(sum / std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z));
}

Mesh makeSphere(int detail) {
    Mesh mesh = named("sphere");
    for (const auto& face : kIcosahedron) {
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        for (int row = 0; row <= detail; ++row)
            for (int column = 0; column <= row; ++column)
                mesh.positions.push_back(displaced(onSphere(face, {detail - row, row - column, column})));
        const auto at = [&](int row, int column) { return base + static_cast<std::uint32_t>(row * (row + 1) / 2 + column); };
        for (int row = 0; row < detail; ++row)
            for (int column = 0; column <= row; ++column) {
                mesh.indices.insert(mesh.indices.end(), {at(row, column), at(row + 1, column), at(row + 1, column + 1)});
                if (column < row) mesh.indices.insert(mesh.indices.end(), {at(row, column), at(row + 1, column + 1), at(row, column + 1)});
            }
    }
    return mesh;
}

Mesh makeTerrain(int detail) {
    Mesh mesh = named("terrain");
    const auto size = static_cast<float>(detail);
    for (int y = 0; y <= detail; ++y)
        for (int x = 0; x <= detail; ++x) {
            glm::vec3 p(static_cast<float>(x) / size, 0, static_cast<float>(y) / size);
            p.y = 0.2f * roughness(p * 8.0f);
            mesh.positions.push_back(p);
        }
    addGrid(mesh.indices, static_cast<std::uint32_t>(detail), static_cast<std::uint32_t>(detail), "acbbcd");
    return mesh;
}

} // namespace

Mesh makeShape(Shape shape, int detail) {
    Mesh mesh;
    switch (shape) {
    case Shape::Cube: mesh = makeCube(); break;
    case Shape::Torus: mesh = makeTorus(); break;
    case Shape::Sphere: mesh = makeSphere(detail > 0 ? detail : kSphereDetail); break;
    case Shape::Terrain: mesh = makeTerrain(detail > 0 ? detail : kTerrainDetail); break;
    }
    mesh.parts.push_back({.name = mesh.name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())});
    return mesh;
}

} // namespace tegument::prep
