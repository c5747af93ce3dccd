#pragma once
// Vertices and triangles taken out of a mesh or put in another order, with everything that belongs to them.

#include "host/mesh/mesh.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

namespace tegument {

/// Vertex i becomes what vertex from[i] was; indices are left alone.
void gatherVertices(Mesh& mesh, std::span<const std::uint32_t> from);

/// Takes out vertices of no triangle; the others keep their order. Gives for each vertex that is left its old number.
std::vector<std::uint32_t> keepReferenced(Mesh& mesh);

/// Takes out the triangles for which `keep(corners, triangle)` is false; gives their number. Parts that hold nothing any more go too.
template <class Keep>
std::size_t keepTriangles(Mesh& mesh, Keep keep) {
    std::size_t to = 0;
    std::vector<MeshPart> parts;
    for (const MeshPart& part : mesh.parts) {
        const std::size_t first = to;
        const auto last = std::size_t{part.firstIndex} + part.indexCount;
        for (std::size_t i = part.firstIndex; i < last; i += 3) {
            if (!keep(std::span<const std::uint32_t, 3>(&mesh.indices[i], 3), i / 3)) continue;
            std::copy_n(&mesh.indices[i], 3, &mesh.indices[to]);
            to += 3;
        }
        if (to == first) continue;
        parts.push_back(
            {.name = part.name, .firstIndex = static_cast<std::uint32_t>(first), .indexCount = static_cast<std::uint32_t>(to - first)});
        parts.back().material = part.material;
        if (to - first == part.indexCount) parts.back().clusters = part.clusters; // they say which triangles are theirs
    }
    const std::size_t dropped = (mesh.indices.size() - to) / 3;
    mesh.indices.resize(to);
    mesh.parts = std::move(parts);
    return dropped;
}

/// The triangles of a grid of (columns + 1) x (rows + 1) vertices that stand row by row from `first` on: those of one cell by the letters
/// of its corners, a and b in a row, c and d in the next.
inline void addGrid(std::vector<std::uint32_t>& indices, std::uint32_t columns, std::uint32_t rows, std::string_view cell,
                    std::uint32_t first = 0) {
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column)
            for (const char corner : cell) {
                const auto at = static_cast<std::uint32_t>(corner - 'a');
                indices.push_back(first + (row + at / 2) * (columns + 1) + column + at % 2);
            }
}

} // namespace tegument
