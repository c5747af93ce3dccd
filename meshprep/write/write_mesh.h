#pragma once
// Meshes as files: a glb holds all of one, a PLY file what is one piece. Both are written whole or not at all; `loadMesh` reads them.

#include "host/mesh/mesh.h"

#include <string_view>

namespace tegument {

/// Writes positions, normals, tangents, UVs, indices, parts, embedded textures (PNG) as one glb in metres.
[[nodiscard]] Result<void> writeGlb(const std::filesystem::path& path, const Mesh& mesh);

/// Writes positions, normals, UVs, colours, attributes and triangles as binary PLY, in millimetres. Positions are doubles where the origin
/// is not 0. `moved`, which preparation added to every position, becomes a comment.
[[nodiscard]] Result<void> writePly(const std::filesystem::path& path, const Mesh& mesh, const glm::dvec3& moved = glm::dvec3(0));

struct GlbOptions; // meshprep/write/glb.h

/// A format that meshes are written in.
struct MeshWriter {
    std::string_view extension; // ".glb"
    std::string_view name;      // "glb"
    Result<void> (*write)(const std::filesystem::path& path, const Mesh& mesh, const GlbOptions& options);
    bool holdsParts; // and materials, pictures and levels
};
/// By the ending of its name; null where no mesh is written so.
[[nodiscard]] const MeshWriter* meshWriterOf(const std::filesystem::path& path);

} // namespace tegument
