#pragma once
// A mesh in the orders that are to be drawn.

#include "meshprep/order/order.h"
#include "tests/order/meshes.h"

namespace tegument::testing_order {

struct Vertex {
    glm::vec3 position{0};
    glm::vec3 normal{0};
};

/// Vertices lie in the order in which the triangles first name them, except where the mesh is drawn as it came.
struct Variant {
    std::string name;
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices; // empty: every three vertices are a triangle
    double acmr = 3;                    // for a FIFO cache of 16
    double warpAtvr = 0;
};

/// Unindexed, indexed as it comes, then ordered by each method for a FIFO cache of 16, at last by the best for warps.
[[nodiscard]] Result<std::vector<Variant>> makeVariants(const Triangles& mesh);

} // namespace tegument::testing_order
