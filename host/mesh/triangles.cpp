#include "host/mesh/triangles.h"

namespace tegument {

namespace {

template <class T>
void gather(std::vector<T>& values, std::span<const std::uint32_t> from) {
    if (values.empty()) return;
    std::vector<T> gathered;
    gathered.reserve(from.size());
    for (const std::uint32_t index : from)
        gathered.push_back(values[index]);
    values = std::move(gathered);
}

} // namespace

void gatherVertices(Mesh& mesh, std::span<const std::uint32_t> from) {
    gather(mesh.positions, from);
    gather(mesh.normals, from);
    gather(mesh.tangents, from);
    gather(mesh.uvs, from);
    gather(mesh.colors, from);
    gather(mesh.motionVertices, from);
    for (MeshAttribute& attribute : mesh.attributes) {
        std::vector<double> gathered;
        gathered.reserve(from.size() * attribute.components);
        for (const std::uint32_t index : from)
            for (std::size_t c = 0; c < attribute.components; ++c)
                gathered.push_back(attribute.values[index * attribute.components + c]);
        attribute.values = std::move(gathered);
    }
}

std::vector<std::uint32_t> keepReferenced(Mesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const std::uint32_t index : mesh.indices)
        used[index] = true;
    std::vector<std::uint32_t> kept;
    std::vector<std::uint32_t> newIndex(mesh.positions.size());
    for (std::uint32_t i = 0; i < used.size(); ++i) {
        newIndex[i] = static_cast<std::uint32_t>(kept.size());
        if (used[i]) kept.push_back(i);
    }
    if (kept.size() == mesh.positions.size()) return kept;
    gatherVertices(mesh, kept);
    for (std::uint32_t& index : mesh.indices)
        index = newIndex[index];
    return kept;
}

} // namespace tegument
