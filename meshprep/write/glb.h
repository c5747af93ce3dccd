#pragma once
// Writing a glb with more than the mesh itself: coarser levels, small vertices, indices of 16 bits throughout.

#include "meshprep/write/write_mesh.h"

#include <algorithm>
#include <array>

namespace tegument {

/// A coarser mesh over the same vertices.
struct MeshLevel {
    std::vector<std::uint32_t> indices;
    std::vector<MeshPart> parts;
    double errorMm = 0; // how far the surface may be from the full one
};

enum class VertexFormat {
    Float,  // 4 bytes per number
    Unorm16 // 2 bytes per number (KHR_mesh_quantization): positions on a cubic grid of 65536 steps, directions of 32767
};

struct GlbOptions {
    std::vector<MeshLevel> levels; // from fine to coarse; other readers find them by the extension MSFT_lod
    VertexFormat format = VertexFormat::Float;
    bool partsOwnVertices = false; // parts use ranges of vertices that do not overlap: their indices count from the range's first one
    glm::dvec3 moved{0};           // what preparation added to every position, in mm; kept in the mesh's extras
    glm::dvec3 place{0};           // where the positions count from, in mm: the translation of the nodes
};

/// The name that an attribute has in a glTF file: "TEXCOORD_1" and "COLOR_1" are glTF's own, others begin with an underscore.
[[nodiscard]] std::string gltfName(const MeshAttribute& attribute);
/// Whether glTF holds it as it is stored: 8 and 16 bits; all else becomes floats.
[[nodiscard]] bool staysWhole(const MeshAttribute& attribute);

/// As `writeGlb(path, mesh)`, which uses the defaults. Indices have 16 bits where they fit. The mesh's bounds, the levels' errors and
/// `moved` are in the meshes' `extras.tegument`, in millimetres. An empty mesh is a glb without nodes.
[[nodiscard]] Result<void> writeGlb(const std::filesystem::path& path, const Mesh& mesh, const GlbOptions& options);

/// The grid of `VertexFormat::Unorm16`: position = origin + step * integer. Its cells are cubes, so that directions need no care.
struct PositionGrid {
    glm::dvec3 origin{0};
    double step = 0;

    explicit PositionGrid(const std::vector<glm::vec3>& positions);
    [[nodiscard]] std::array<std::uint16_t, 3> encode(const glm::vec3& position) const;
    [[nodiscard]] glm::dvec3 decode(const std::array<std::uint16_t, 3>& numbers) const {
        return origin + step * glm::dvec3(numbers[0], numbers[1], numbers[2]);
    }
};

/// A number of -1 to 1 in 16 bits, as glTF's normalised shorts are read: n / 32767, at least -1.
[[nodiscard]] std::int16_t toSnorm16(float value);
[[nodiscard]] inline double fromSnorm16(std::int16_t value) {
    return std::max(value / 32767.0, -1.0);
}

} // namespace tegument
