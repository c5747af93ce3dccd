// Version 0.18 does not look at attributes.
#include "tests/meshprep/table/peer.h"

namespace tegument::testing_prep {

Indices simplifiedByPlace(const Indices& indices, const std::vector<glm::vec3>& positions, std::size_t triangles);

std::vector<Indices> peerLevels(const Indices& indices, const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>&,
                                const std::vector<glm::vec2>&, std::size_t triangles) {
    return {simplifiedByPlace(indices, positions, triangles)};
}

} // namespace tegument::testing_prep
