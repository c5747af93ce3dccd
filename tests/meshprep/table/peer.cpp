#include "tests/meshprep/table/peer.h"

#include <meshoptimizer.h>

#include <fmt/format.h>

#include <array>
#include <limits>

namespace tegument::testing_prep {

std::string peerName() {
    return fmt::format("meshoptimizer {}.{}", MESHOPTIMIZER_VERSION / 1000, MESHOPTIMIZER_VERSION % 1000 / 10);
}

Indices peerVertexCache(const Indices& indices, std::size_t vertices) {
    Indices out(indices.size());
    meshopt_optimizeVertexCache(out.data(), indices.data(), indices.size(), vertices);
    return out;
}

std::vector<Indices> peerOrders(const Indices& indices, const std::vector<glm::vec3>& positions, unsigned entries) {
    const std::size_t vertices = positions.size();
    std::vector<Indices> orders = {peerVertexCache(indices, vertices)};
    Indices out(indices.size());
    meshopt_optimizeVertexCacheFifo(out.data(), indices.data(), indices.size(), vertices, entries);
    orders.push_back(out);
    meshopt_optimizeVertexCacheStrip(out.data(), indices.data(), indices.size(), vertices);
    orders.push_back(out);
    meshopt_spatialSortTriangles(out.data(), indices.data(), indices.size(), &positions[0].x, vertices, sizeof(glm::vec3));
    orders.push_back(peerVertexCache(out, vertices));
    return orders;
}

Indices simplifiedByPlace(const Indices& indices, const std::vector<glm::vec3>& positions, std::size_t triangles) {
    Indices out(indices.size());
    out.resize(meshopt_simplify(out.data(), indices.data(), indices.size(), &positions[0].x, positions.size(), sizeof(glm::vec3),
                                3 * triangles, std::numeric_limits<float>::max(), 0, nullptr));
    return out;
}

std::vector<Indices> peerLevels(const Indices& indices, const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals,
                                const std::vector<glm::vec2>& uvs, std::size_t triangles) {
    using Attributes = std::array<float, 5>;
    std::vector<Attributes> attributes;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec2 uv = uvs.empty() ? glm::vec2(0) : uvs[i];
        attributes.push_back({normals[i].x, normals[i].y, normals[i].z, uv.x, uv.y});
    }
    constexpr Attributes kWeights = {0.5f, 0.5f, 0.5f, 1, 1};
    Indices out(indices.size());
    out.resize(meshopt_simplifyWithAttributes(out.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                              sizeof(glm::vec3), attributes[0].data(), sizeof(Attributes), kWeights.data(), kWeights.size(),
                                              nullptr, 3 * triangles, std::numeric_limits<float>::max(), 0, nullptr));
    return {simplifiedByPlace(indices, positions, triangles), out};
}

} // namespace tegument::testing_prep
