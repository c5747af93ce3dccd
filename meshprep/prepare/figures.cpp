#include "meshprep/prepare/figures.h"

#include <meshoptimizer.h>

namespace tegument::prep {

CacheFigures measure(const CacheModel& model, std::span<const std::uint32_t> indices, std::size_t vertices) {
    if (indices.empty()) return {};
    const auto statistics =
        meshopt_analyzeVertexCache(indices.data(), indices.size(), vertices, model.cache, model.batchVertices, model.batchTriangles);
    return {.acmr = statistics.acmr, .atvr = statistics.atvr};
}

SizeFigures sizes(std::size_t vertices, std::size_t triangles, std::size_t vertexBytes, bool small) {
    SizeFigures figures{.vertexBytes = vertexBytes, .indexBytes = small ? 2u : 4u};
    figures.before = triangles * 3 * vertexBytes;
    figures.after = vertices * vertexBytes + triangles * 3 * figures.indexBytes;
    return figures;
}

} // namespace tegument::prep
