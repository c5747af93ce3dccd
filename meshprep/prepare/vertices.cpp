#include "meshprep/prepare/vertices.h"

#include "host/mesh/triangles.h"
#include "host/mesh/welding.h"

#include <array>

namespace tegument::prep {

std::size_t weldVertices(Surface& surface) {
    Mesh& mesh = surface.mesh;
    const std::vector<std::uint32_t> first = firstEqual(mesh.positions.size(), [&](std::uint32_t i) {
        const glm::vec3 n = mesh.normals.empty() ? glm::vec3(0) : mesh.normals[i];
        const glm::vec2 t = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[i];
        const auto bits = floatKey<5>({n.x, n.y, n.z, t.x, t.y});
        return std::array{surface.point[i], bits[0], bits[1], bits[2], bits[3], bits[4]};
    });
    std::vector<std::uint32_t> number(first.size());
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
        number[i] = first[i] == i ? static_cast<std::uint32_t>(kept.size()) : number[first[i]];
        if (first[i] == i) kept.push_back(i);
    }
    const std::size_t gone = first.size() - kept.size();
    if (gone == 0) return 0;
    gatherVertices(mesh, kept);
    for (std::uint32_t& index : mesh.indices)
        index = number[index];
    std::vector<std::uint32_t> point;
    point.reserve(kept.size());
    for (const std::uint32_t vertex : kept)
        point.push_back(surface.point[vertex]);
    surface.point = std::move(point);
    return gone;
}

std::size_t orderVertices(Mesh& mesh) {
    constexpr std::uint32_t kNone = UINT32_MAX;
    std::vector<std::uint32_t> number(mesh.positions.size(), kNone);
    std::vector<std::uint32_t> from;
    from.reserve(number.size());
    std::size_t moved = 0;
    for (std::uint32_t& index : mesh.indices) {
        if (number[index] == kNone) {
            number[index] = static_cast<std::uint32_t>(from.size());
            moved += number[index] != index;
            from.push_back(index);
        }
        index = number[index];
    }
    if (moved > 0) gatherVertices(mesh, from);
    return moved;
}

} // namespace tegument::prep
