#include "meshprep/human/ears.h"

#include <algorithm>
#include <vector>

namespace tegument {

namespace {

/// What the quads around a control point add up to.
struct Around {
    glm::vec3 edges{0};     // neighbours along edges, each counted once from either side of the edge
    glm::vec3 opposites{0}; // corners across the quads
    int quads = 0;
    float ear = 0;
};

} // namespace

float sharpenEars(Bust& bust, const RegionMasks& masks, float times) {
    std::vector<Around> around(bust.positions.size());
    for (std::size_t q = 0; q < bust.quads.size(); ++q) {
        if (bust.parts[q] != BustPart::Skin) continue;
        const Quad& quad = bust.quads[q];
        for (std::size_t c = 0; c < 4; ++c) {
            Around& here = around[quad.position[c]];
            here.edges += bust.positions[quad.position[(c + 1) % 4]] + bust.positions[quad.position[(c + 3) % 4]];
            here.opposites += bust.positions[quad.position[(c + 2) % 4]];
            here.ear = std::max(here.ear, maskAt(masks.ears, bust.uvs[quad.uv[c]]));
            ++here.quads;
        }
    }
    float farthest = 0;
    for (std::size_t v = 0; v < around.size(); ++v) {
        const Around& here = around[v];
        if (here.ear <= 0 || here.quads < 3) continue;
        // The limit of a control point inside the mesh (D. Zorin and P. Schröder, Subdivision for Modeling and Animation, 2000): with n
        // quads around it (n^2 v + 4 sum of neighbours + sum of opposite corners) / (n (n + 5)). `edges` has each neighbour twice.
        const auto n = static_cast<float>(here.quads);
        const glm::vec3 limit = (n * n * bust.positions[v] + 2.0f * here.edges + here.opposites) / (n * (n + 5));
        const glm::vec3 way = times * std::min(1.0f, here.ear) * (bust.positions[v] - limit);
        bust.positions[v] += way;
        farthest = std::max(farthest, glm::length(way));
    }
    return farthest;
}

} // namespace tegument
