#pragma once
// A mesh of several parts as the simplifier sees it.

#include "meshprep/prepare/simplify.h"
#include "meshprep/write/glb.h"

#include <set>
#include <span>
#include <vector>

namespace tegument::prep {

/// Every part's vertices are its own for the simplifier: where parts meet it sees a seam, moves both sides at once and opens no gap. So all
/// parts are simplified together, and each loses what it can spare.
class WholeMesh {
public:
    explicit WholeMesh(const Mesh& mesh);

    /// Whether parts have vertices in common, and few enough triangles would be left to find theirs again.
    [[nodiscard]] bool mayBeOne(std::size_t triangles) const;

    /// In the vertices' own numbers, as what follows.
    [[nodiscard]] const std::vector<std::uint32_t>& full() const { return indices_; }

    [[nodiscard]] const std::vector<glm::vec3>& positions() const { return positions_; }

    [[nodiscard]] std::vector<std::uint32_t> simplified(std::span<const std::uint32_t> from, std::size_t triangles, float normals = 0,
                                                        std::set<std::uint32_t> locked = {}) const;

    /// As users of the library have it who do not know of parts: a vertex of several is one, and borders of parts hold nothing. What is
    /// left is in the order in which it came, so that the parts are found again.
    [[nodiscard]] std::vector<std::uint32_t> simplifiedAsOne(std::size_t triangles, float normals) const;

    /// Each part loses the same share, and keeps its borders.
    [[nodiscard]] std::vector<std::uint32_t> partByPart(std::size_t triangles) const;

    [[nodiscard]] MeshLevel level(const std::vector<std::uint32_t>& coarse) const;

    static void addPart(MeshLevel& level, const MeshPart& from, const std::vector<std::uint32_t>& own);

private:
    [[nodiscard]] SimplifiedAttributes attributesOf(std::uint32_t vertex) const;

    /// Own numbers of triangles in the mesh's, which are in the order of its parts: a triangle's first corner is one of its part, and those
    /// that its part does not have are another one's.
    [[nodiscard]] std::vector<std::uint32_t> toParts(const std::vector<std::uint32_t>& coarse) const;

    const Mesh& mesh_;
    std::vector<std::uint32_t> indices_;
    bool shares_ = false;
    std::vector<std::uint32_t> original_; // vertex of the mesh
    std::vector<std::uint32_t> part_;     // of each vertex
    std::vector<glm::vec3> positions_;
    std::vector<SimplifiedAttributes> attributes_;
};

} // namespace tegument::prep
