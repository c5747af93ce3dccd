#include "host/mesh/pose.h"

#include <algorithm>
#include <cassert>

namespace tegument {

namespace {

constexpr const char* kPositions = "posed position";
constexpr const char* kNormals = "posed normal";

const MeshAttribute* named(const Mesh& mesh, const char* name) {
    const auto found = std::ranges::find(mesh.attributes, name, &MeshAttribute::name);
    return found != mesh.attributes.end() && found->values.size() == 3 * mesh.positions.size() ? &*found : nullptr;
}

void put(Mesh& mesh, const char* name, std::span<const glm::vec3> vectors) {
    assert(vectors.size() == mesh.positions.size());
    std::erase_if(mesh.attributes, [&](const MeshAttribute& attribute) { return attribute.name == name; });
    MeshAttribute attribute{.name = name, .components = 3};
    attribute.values.reserve(3 * vectors.size());
    for (const glm::vec3& v : vectors)
        attribute.values.insert(attribute.values.end(), {v.x, v.y, v.z});
    mesh.attributes.push_back(std::move(attribute));
}

} // namespace

std::optional<PoseView> poseOf(const Mesh& mesh) {
    const MeshAttribute* positions = named(mesh, kPositions);
    const MeshAttribute* normals = named(mesh, kNormals);
    if (!positions || !normals) return std::nullopt;
    return PoseView{.positions = positions->values, .normals = normals->values};
}

void setPose(Mesh& mesh, std::span<const glm::vec3> positions, std::span<const glm::vec3> normals) {
    put(mesh, kPositions, positions);
    put(mesh, kNormals, normals);
    for (MeshPart& part : mesh.parts)
        computeClusters(mesh, part);
}

Bounds seenBounds(const Mesh& mesh) {
    const auto pose = poseOf(mesh);
    if (!pose) return mesh.bounds;
    Mesh seen;
    const std::vector<bool> expanded = expandedVertices(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (expanded.empty() || !expanded[i]) seen.positions.emplace_back(pose->position(i)); // roots lie within
    computeBounds(seen);
    return seen.bounds;
}

std::vector<bool> expandedVertices(const Mesh& mesh) {
    std::vector<bool> expanded;
    for (const MeshPart& part : mesh.parts) {
        if (!part.expanded) continue;
        expanded.resize(mesh.positions.size());
        for (std::uint32_t i = 0; i < part.indexCount; ++i)
            expanded[mesh.indices[part.firstIndex + i]] = true;
    }
    return expanded;
}

} // namespace tegument
