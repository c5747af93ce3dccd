#pragma once
// A mesh file as it is: what was in it, and what had to be left out. `loadMesh` makes of it what the effects draw; `meshprep` cleans it.

#include "host/mesh/mesh.h"

#include <cstddef>

namespace tegument {

struct ReadOptions {
    std::optional<double> unitMm; // as MeshOptions::unitMm
    bool guessUnit = false;       // as MeshOptions::guessUnit
    bool dropBadFaces = false;    // leave out faces that refer to no vertex, with a count, instead of refusing the file
    bool dropNotFinite = false;   // leave out faces with a corner at NaN or infinity, with a count, instead of refusing the file
    bool carryMaterials = false;  // keep materials and their pictures as they are in the file, instead of decoding a few of them
    Roots roots{};                // as MeshOptions::roots
};

/// Counted while reading. `vertices` and `faces` are the file's own: positions or vertices, and polygons.
struct ReadCounts {
    std::size_t vertices = 0;
    std::size_t faces = 0;
    std::size_t smallFaces = 0;     // of fewer than three corners: left out
    std::size_t badFaces = 0;       // refer to no vertex: left out
    std::size_t notFiniteFaces = 0; // have a corner at NaN or infinity: left out
};

struct ReadMesh {
    Mesh mesh; // triangles; normals and tangents as in the file (any length), or none; no bounds; degenerate triangles still there
    ReadCounts counts;
    /// For `readMesh` itself, which empties it: positions as the file has them (mm), where it has more than floats hold, from `exactFrom`
    /// on.
    std::vector<glm::dvec3> exact{};
    glm::dvec3 exactFrom{0};
    bool floats = true;                       // the file stores its coordinates as 32-bit floats
    std::vector<std::string> materialNames{}; // of the parts of an OBJ file
};

/// glb/gltf, PLY, OBJ, STL, OFF by content and extension. A mesh without a triangle is no error here.
[[nodiscard]] Result<ReadMesh> readMesh(const std::filesystem::path& path, const ReadOptions& options = {});

} // namespace tegument
