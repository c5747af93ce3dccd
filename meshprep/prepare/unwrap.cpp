#include "meshprep/prepare/unwrap.h"

#include "host/mesh/materials.h"
#include "host/mesh/triangles.h"

#include <fmt/format.h>
#include <xatlas.h>

#include <algorithm>
#include <map>
#include <memory>

namespace tegument::prep {

namespace {

using Atlas = std::unique_ptr<xatlas::Atlas, decltype(&xatlas::Destroy)>;

/// Maps of light are 1024 texels wide by default; a blurred texel of one chart must not be read by another.
constexpr std::uint32_t kTexels = 1024;
constexpr std::uint32_t kGutter = 4;
/// Diffusion ends at the border of a chart, so few large charts are better than many without stretch, which the Stretch map takes care of.
constexpr float kMostCost = 16;
constexpr std::uint32_t kRounds = 1; // more take longer and leave as many

/// Triangles of different parts are never in one chart.
std::vector<std::uint32_t> partOfFace(const Mesh& mesh) {
    std::vector<std::uint32_t> part(mesh.indices.size() / 3, 0);
    for (std::uint32_t i = 0; i < mesh.parts.size(); ++i)
        std::fill_n(part.begin() + mesh.parts[i].firstIndex / 3, mesh.parts[i].indexCount / 3, i);
    return part;
}

/// Every place once: vertices that differ only in their normals do not cut a chart.
std::optional<Error> addMesh(xatlas::Atlas& atlas, const Surface& surface) {
    std::vector<glm::vec3> places(surface.pointCount);
    std::vector<std::uint32_t> corners;
    for (std::size_t corner = 0; corner < surface.mesh.indices.size(); ++corner) {
        const std::uint32_t place = surface.pointAt(corner);
        places[place] = surface.mesh.positions[surface.mesh.indices[corner]];
        corners.push_back(place);
    }
    const std::vector<std::uint32_t> parts = partOfFace(surface.mesh);
    xatlas::MeshDecl decl;
    decl.vertexPositionData = places.data();
    decl.vertexPositionStride = sizeof(glm::vec3);
    decl.vertexCount = surface.pointCount;
    decl.indexData = corners.data();
    decl.indexCount = static_cast<std::uint32_t>(corners.size());
    decl.indexFormat = xatlas::IndexFormat::UInt32;
    decl.faceMaterialData = parts.data();
    const xatlas::AddMeshError error = xatlas::AddMesh(&atlas, decl, 1);
    if (error == xatlas::AddMeshError::Success) return std::nullopt;
    return inputError(7028, {}, fmt::format("the mesh cannot be unwrapped: {}", xatlas::StringForEnum(error)),
                      "clean it with tegument prep first");
}

/// Vertices anew: one for each pair of a vertex of the mesh and a vertex of the atlas.
std::size_t takeCoordinates(Surface& surface, const xatlas::Atlas& atlas) {
    const xatlas::Mesh& charts = atlas.meshes[0];
    Mesh& mesh = surface.mesh;
    const float side = static_cast<float>(std::max({atlas.width, atlas.height, 1U}));
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
    std::vector<std::uint32_t> from;
    std::vector<glm::vec2> uvs;
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const std::uint32_t placed = charts.indexArray[corner];
        const auto [entry, isNew] = known.try_emplace({mesh.indices[corner], placed}, static_cast<std::uint32_t>(from.size()));
        if (isNew) {
            from.push_back(mesh.indices[corner]);
            uvs.emplace_back(charts.vertexArray[placed].uv[0] / side, charts.vertexArray[placed].uv[1] / side);
        }
        mesh.indices[corner] = entry->second;
    }
    const std::size_t before = mesh.positions.size();
    mesh.uvs.clear();
    mesh.tangents.clear();
    gatherVertices(mesh, from);
    mesh.uvs = std::move(uvs);
    std::vector<std::uint32_t> point;
    for (const std::uint32_t vertex : from)
        point.push_back(surface.point[vertex]);
    surface.point = std::move(point);
    return from.size() - std::min(before, from.size());
}

} // namespace

Result<Unwrapping> unwrap(Surface& surface) {
    surface.mesh.textures.clear();
    dropTextures(surface.mesh.materials);
    const Atlas atlas(xatlas::Create(), xatlas::Destroy);
    if (auto error = addMesh(*atlas, surface)) return *error;
    xatlas::ChartOptions charts;
    charts.maxCost = kMostCost;
    charts.maxIterations = kRounds;
    xatlas::PackOptions pack;
    pack.resolution = kTexels;
    pack.padding = kGutter;
    xatlas::Generate(atlas.get(), charts, pack);
    if (atlas->meshCount != 1 || atlas->chartCount == 0 || atlas->meshes[0].indexCount != surface.mesh.indices.size())
        return inputError(7028, {}, "the mesh cannot be unwrapped: no chart could be made of it",
                          "its triangles may have no area: see tegument prep");
    Unwrapping result{.charts = atlas->chartCount};
    result.split = takeCoordinates(surface, *atlas);
    result.covered = examineUvs(surface.mesh).covered;
    return result;
}

} // namespace tegument::prep
