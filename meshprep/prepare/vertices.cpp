#include "meshprep/prepare/vertices.h"

#include "host/mesh/motion.h"
#include "host/mesh/triangles.h"
#include "host/mesh/welding.h"

#include <array>
#include <bit>

namespace tegument::prep {

namespace {

std::array<std::uint32_t, 2> wordsOf(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value);
    return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
}

/// A number for each vertex: equal where place, movement, colours and all attributes are.
std::vector<std::uint32_t> kindsOf(const Surface& surface) {
    const Mesh& mesh = surface.mesh;
    std::vector<std::uint32_t> kind = surface.point;
    if (mesh.motion)
        kind = firstEqual(kind.size(), [&](std::uint32_t i) { return std::array{kind[i], mesh.motion->kinds[mesh.motionVertices[i]]}; });
    if (!mesh.colors.empty())
        kind = firstEqual(kind.size(), [&](std::uint32_t i) {
            const glm::vec4& c = mesh.colors[i];
            const auto bits = floatKey<4>({c.r, c.g, c.b, c.a});
            return std::array{kind[i], bits[0], bits[1], bits[2], bits[3]};
        });
    for (const MeshAttribute& attribute : mesh.attributes)
        for (std::size_t c = 0; c < attribute.components; ++c)
            kind = firstEqual(kind.size(), [&](std::uint32_t i) {
                const auto bits = wordsOf(attribute.values[i * attribute.components + c]);
                return std::array{kind[i], bits[0], bits[1]};
            });
    return kind;
}

} // namespace

std::size_t weldVertices(Surface& surface) {
    Mesh& mesh = surface.mesh;
    const std::vector<std::uint32_t> kinds = kindsOf(surface);
    const std::vector<std::uint32_t> first = firstEqual(mesh.positions.size(), [&](std::uint32_t i) {
        const glm::vec3 n = mesh.normals.empty() ? glm::vec3(0) : mesh.normals[i];
        const glm::vec2 t = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[i];
        const auto bits = floatKey<5>({n.x, n.y, n.z, t.x, t.y});
        return std::array{kinds[i], bits[0], bits[1], bits[2], bits[3], bits[4]};
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

std::size_t orderVertices(Mesh& mesh, std::span<std::vector<std::uint32_t>* const> others) {
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
    if (moved == 0) return 0;
    gatherVertices(mesh, from);
    for (std::vector<std::uint32_t>* list : others)
        for (std::uint32_t& index : *list)
            index = number[index];
    return moved;
}

} // namespace tegument::prep
