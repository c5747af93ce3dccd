#include "meshprep/prepare/vertex_format.h"

#include "meshprep/write/glb.h"

#include <glm/gtc/packing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::prep {

namespace {

constexpr double kMostHalf = 65504;

double angleDegrees(const glm::vec3& a, const glm::vec3& b) {
    const glm::dvec3 u(a);
    const glm::dvec3 v(b);
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)) * 180 / std::numbers::pi;
}

float half(float value) {
    return glm::unpackHalf1x16(glm::packHalf1x16(value));
}

float snorm(float value) {
    return static_cast<float>(fromSnorm16(toSnorm16(value)));
}

float unorm(float value) {
    return value >= 0 && value <= 1 ? static_cast<float>(std::round(static_cast<double>(value) * 65535) / 65535) : value;
}

template <class Reduce>
void reducePositions(Mesh& mesh, VertexError& error, Reduce reduce) {
    for (glm::vec3& p : mesh.positions) {
        const glm::vec3 reduced = reduce(p);
        error.positionMm = std::max(error.positionMm, glm::distance(glm::dvec3(reduced), glm::dvec3(p)));
        p = reduced;
    }
}

template <class Number>
void reduceDirections(Mesh& mesh, VertexError& error, Number number) {
    for (glm::vec3& n : mesh.normals) {
        const glm::vec3 reduced(number(n.x), number(n.y), number(n.z));
        error.normalDegrees = std::max(error.normalDegrees, angleDegrees(n, reduced));
        n = reduced;
    }
    for (glm::vec4& t : mesh.tangents)
        t = {number(t.x), number(t.y), number(t.z), t.w};
}

template <class Number>
void reduceUvs(Mesh& mesh, VertexError& error, Number number) {
    for (glm::vec2& uv : mesh.uvs) {
        const glm::vec2 reduced(number(uv.x), number(uv.y));
        error.uv = std::max(error.uv, glm::distance(glm::dvec2(reduced), glm::dvec2(uv)));
        uv = reduced;
    }
}

/// Texture coordinates are written as shorts only when all of them are inside the unit square.
bool allInside(const std::vector<glm::vec2>& uvs) {
    return std::ranges::all_of(uvs, [](const glm::vec2& uv) { return uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1; });
}

} // namespace

std::size_t vertexBytes(const Mesh& mesh, VertexPrecision precision) {
    const bool full = precision == VertexPrecision::Float;
    std::size_t bytes = full ? 12 : 8;
    if (!mesh.normals.empty()) bytes += full ? 12 : 8;
    if (!mesh.tangents.empty()) bytes += full ? 16 : 8;
    if (!mesh.uvs.empty()) bytes += full || (precision == VertexPrecision::Unorm16 && !allInside(mesh.uvs)) ? 8 : 4;
    if (!mesh.colors.empty()) bytes += precision == VertexPrecision::Unorm16 ? 8 : 16;
    for (const MeshAttribute& attribute : mesh.attributes) {
        const bool one = attribute.type == NumberType::Int8 || attribute.type == NumberType::Uint8;
        bytes += (attribute.components * (staysWhole(attribute) ? (one ? 1 : 2) : 4) + 3) / 4 * 4;
    }
    return bytes;
}

Result<VertexError> reducePrecision(Mesh& mesh, VertexPrecision precision) {
    VertexError error;
    if (precision == VertexPrecision::Float) return error;
    if (precision == VertexPrecision::Half) {
        for (const glm::vec3& p : mesh.positions)
            if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kMostHalf)
                return inputError(7026, {}, fmt::format("a coordinate of {:g} mm does not fit into a half float", p.x),
                                  "use --vertex unorm16, or a smaller --unit-mm");
        const auto reduce = [](const glm::vec3& p) { return glm::vec3(half(p.x), half(p.y), half(p.z)); };
        reducePositions(mesh, error, reduce);
        reduceDirections(mesh, error, half);
        reduceUvs(mesh, error, half);
        return error;
    }
    const PositionGrid grid(mesh.positions);
    reducePositions(mesh, error, [&](const glm::vec3& p) { return glm::vec3(grid.decode(grid.encode(p))); });
    reduceDirections(mesh, error, snorm);
    if (allInside(mesh.uvs)) reduceUvs(mesh, error, unorm);
    return error;
}

} // namespace tegument::prep
