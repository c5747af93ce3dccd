#pragma once
// A mesh file as it is: what was in it, and what had to be left out. `loadMesh` makes of it what the effects draw; `meshprep` cleans it.

#include "host/mesh/mesh.h"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace tegument {

struct ReadOptions {
    std::optional<double> unitMm; // as MeshOptions::unitMm
    bool guessUnit = false;       // as MeshOptions::guessUnit
    bool dropBadFaces = false;    // leave out faces that refer to no vertex, with a count, instead of refusing the file
    bool dropNotFinite = false;   // leave out faces with a corner at NaN or infinity, with a count, instead of refusing the file
    bool carryMaterials = false;  // keep materials and their pictures as they are in the file, instead of decoding a few of them
    bool ownCoordinates = false;  // as MeshOptions::ownCoordinates
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

namespace meshfile {
struct Source;
}

/// A row of the table in mesh_file.h, which whoever lists formats asks, or does for one what it does not for another.
struct MeshFormat {
    std::string_view extension; // ".glb"
    std::string_view name;      // "glb"
    Result<ReadMesh> (*read)(const meshfile::Source& source);
    double unitMm;                            // of a file that does not say
    bool zIsUp = false;                       // else y
    std::array<std::string_view, 3> starts{}; // its first bytes are one of these; empty: only its name tells
};
[[nodiscard]] std::span<const MeshFormat> meshFormats();
/// By the ending of its name; null where that is none of a mesh.
[[nodiscard]] const MeshFormat* meshFormatOf(const std::filesystem::path& path);
/// ".glb, .gltf" ...
[[nodiscard]] std::string meshEndings();
/// Which axis of which files points up: "z of STL files, else y".
[[nodiscard]] std::string meshUps();

/// One of `meshFormats`, by content and extension. A mesh without a triangle is no error here.
[[nodiscard]] Result<ReadMesh> readMesh(const std::filesystem::path& path, const ReadOptions& options = {});

} // namespace tegument
