#pragma once
// Inside host/mesh only: the scene of a glTF file as a list of what is drawn where.

#include "host/mesh/gltf_document.h"

namespace tegument::meshfile {

/// How positions, normals and tangents of one node are carried into the world.
struct GltfCarrier {
    glm::dmat4 matrix{1};
    glm::dmat3 linear{1};
    glm::dmat3 normals{1};
    bool mirrors = false;
    bool turns = true; // false: a uniform scale leaves directions bit for bit as they are

    explicit GltfCarrier(const glm::dmat4& m) : matrix(m), linear(m) {
        const double scale = linear[0][0];
        turns = !(scale > 0 && linear == glm::dmat3(scale));
        mirrors = glm::determinant(linear) < 0;
        // cofactor matrix: the inverse transpose without its division, so it exists for flattened meshes too
        normals = glm::dmat3(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]), glm::cross(linear[0], linear[1]));
        if (mirrors) normals = -normals;
    }

    [[nodiscard]] glm::vec3 direction(const glm::dmat3& by, const glm::vec3& v) const {
        if (!turns) return v;
        const glm::dvec3 carried = by * glm::dvec3(v);
        const double length = glm::length(carried);
        return length > 0 ? glm::vec3(carried / length) : glm::vec3(0);
    }
};

/// A mesh as one node draws it.
struct GltfDraw {
    std::size_t mesh = 0;
    std::string nodeName;
    GltfCarrier carrier;
};

/// The meshes of the default scene's nodes, one entry for each node or instance that draws one. TG5302 where nodes are no trees, TG5310
/// where they draw more than a mesh may hold. Skins that are ignored are warnings, unless materials are carried: gltf_losses.h.
[[nodiscard]] Result<std::vector<GltfDraw>> drawsOf(const GltfDocument& document, Mesh& mesh);

} // namespace tegument::meshfile
