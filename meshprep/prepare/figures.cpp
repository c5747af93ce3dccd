#include "meshprep/prepare/figures.h"

#include "meshprep/prepare/centre.h"
#include "meshprep/prepare/vertices.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace tegument::prep {

SizeFigures sizes(std::size_t vertices, std::size_t triangles, std::size_t vertexBytes, bool small) {
    SizeFigures figures{.vertexBytes = vertexBytes, .indexBytes = small ? 2u : 4u};
    figures.before = triangles * 3 * vertexBytes;
    figures.after = vertices * vertexBytes + triangles * 3 * figures.indexBytes;
    return figures;
}

Overdraw orderForOverdraw(Mesh& mesh) {
    if (mesh.indices.empty()) return {};
    const std::vector<glm::vec3> positions = atUnitSize(mesh.positions);
    const auto measured = [&] {
        const auto statistics =
            meshopt_analyzeOverdraw(mesh.indices.data(), mesh.indices.size(), &positions[0].x, positions.size(), sizeof(glm::vec3));
        return static_cast<double>(statistics.overdraw);
    };
    Overdraw result{.before = measured(), .after = 0};
    LocalVertices local(positions.size());
    std::vector<std::uint32_t> ordered;
    for (const MeshPart& part : mesh.parts) {
        const auto own = std::span(mesh.indices).subspan(part.firstIndex, part.indexCount);
        const auto& indices = local.enter(own);
        const std::vector<glm::vec3> places = local.gathered(positions);
        ordered.resize(indices.size());
        meshopt_optimizeOverdraw(ordered.data(), indices.data(), indices.size(), &places[0].x, places.size(), sizeof(glm::vec3),
                                 kOverdrawThreshold);
        std::ranges::transform(ordered, own.begin(), [&](std::uint32_t corner) { return local.global()[corner]; });
    }
    result.after = measured();
    return result;
}

} // namespace tegument::prep
