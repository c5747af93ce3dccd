#pragma once
// meshoptimizer as its users call it: another version where the build was given its sources (TEGUMENT_MESHOPT_PEER).

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace tegument::testing_prep {

using Indices = std::vector<std::uint32_t>;

[[nodiscard]] std::string peerName();
/// Its orders: for vertex caches, for a FIFO cache of so many entries, for strips, and the first one after sorting by place.
[[nodiscard]] std::vector<Indices> peerOrders(const Indices& indices, const std::vector<glm::vec3>& positions, unsigned entries);
[[nodiscard]] Indices peerVertexCache(const Indices& indices, std::size_t vertices);
/// Its levels of so many triangles: by places alone, and by places and attributes with the weights that its documentation and gltfpack use.
[[nodiscard]] std::vector<Indices> peerLevels(const Indices& indices, const std::vector<glm::vec3>& positions,
                                              const std::vector<glm::vec3>& normals, const std::vector<glm::vec2>& uvs,
                                              std::size_t triangles);

} // namespace tegument::testing_prep
