#pragma once
// Inside host/mesh only: the readers behind loadMesh, and the errors they share. A reader checks everything that comes from the file; what
// it returns has equally long attribute arrays (or empty ones), indices in range, and lengths already multiplied by the unit.

#include "host/mesh/obj_file.h"
#include "host/mesh/read_mesh.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace tegument::meshfile {

/// More vertices or indices than this are refused: 32-bit offsets into a vertex buffer of 48 bytes per vertex stay valid, and a file that
/// repeats one primitive a million times cannot take the machine's memory.
inline constexpr std::size_t kMaxVertices = 1u << 26;
inline constexpr std::size_t kMaxIndices = 1u << 28;

inline constexpr int kMostPictureSide = 16384; // texels, as pictures are read
inline constexpr std::size_t kMostPictureTexels = std::size_t{1} << 26;
inline constexpr float kUvRounding = 1e-4F;

/// A mesh file's bytes, where they came from, and how many millimetres one of its units is.
struct Source {
    const std::filesystem::path& path;
    std::string_view bytes;
    double unitMm;
    bool dropBadFaces = false;   // faces that refer to no vertex are counted and left out; otherwise they are an error
    bool keepNotFinite = false;  // whoever reads cares for NaN and infinity; otherwise they are an error
    bool carryMaterials = false; // as ReadOptions has it
    bool ownCoordinates = false; // the same
    Roots roots{};               // where files may lie that this one names

    [[nodiscard]] std::string name() const { return path.string(); }
    [[nodiscard]] SourcePosition atByte(std::size_t byte) const { return {.file = name(), .byte = byte}; }
    [[nodiscard]] SourcePosition atLine(int line) const { return {.file = name(), .line = line, .column = 1}; }
    [[nodiscard]] SourcePosition whole() const { return {.file = name()}; }
};

inline constexpr int kOutside = 1014;
/// A file that the mesh file names. TG1014 it is there, and outside of the roots; TG5001 it is not there.
[[nodiscard]] Result<std::string> readNamed(const Source& source, const std::filesystem::path& file);
/// What lies outside of the roots has a hint of its own.
[[nodiscard]] std::string hintFor(const Error& error, const char* otherwise);

[[nodiscard]] Result<ReadMesh> readPly(const Source& source);
/// With `dropBadFaces`, corners may name what the file lacks.
[[nodiscard]] Result<ObjFile> parseObj(const Source& source);
/// The pictures that the materials in use name as their colour (map_Kd), several in a sheet, with those that have a colour alone (Kd).
/// Warnings: TG5326 one of several is used, TG5328 one cannot be read.
void addObjTextures(const Source& source, const ObjFile& file, ReadMesh& read);
/// Whether materials name a picture for each tile of the plane (UDIM), which no glTF material can.
[[nodiscard]] bool namesTiles(const Source& source, const ObjFile& file);
/// That picture as the mesh's colour map; TG5328, a warning, where it cannot be read.
void useColourMap(const Source& source, const std::filesystem::path& picture, Mesh& mesh);
/// Several pictures side by side as one, all as large as the largest. One that cannot be read is white, with a warning (TG5328).
void useColourSheet(const Source& source, const std::vector<std::string>& pictures, Mesh& mesh);
/// How a picture goes on beyond its edges, along u and along v.
enum class PictureEdge { Repeat, Mirror, Clamp };
using PictureEdges = std::array<PictureEdge, 2>;
/// Where one of the mesh's textures goes on otherwise than by repeating, and coordinates lead there: all are laid out over the tiles in
/// use, and the coordinates with them. `edges`: of each texture. TG5323, a warning, where that is too large.
void layOutPictures(const Source& source, const std::vector<PictureEdges>& edges, Mesh& mesh);
/// The texel of a picture `side` wide that is seen at another, beyond its edges.
[[nodiscard]] int wrapped(int texel, int side, PictureEdge edge);
/// Multiplies an sRGB picture by a linear colour.
void tint(const glm::vec3& factor, Image& picture);
/// What the triangles of a part are drawn with.
struct DrawnMaterial {
    std::optional<Image> colour; // sRGB
    std::optional<Image> normal;
    glm::vec3 factor{1}; // linear, of the colour
    PictureEdges edges{};

    [[nodiscard]] bool hasPicture() const { return colour || normal; }
};
/// Several materials as one colour map and one normal map, and the coordinates with them. False, and nothing is done to coordinates, where
/// the sheet would be too large.
[[nodiscard]] bool layOutMaterials(std::span<const DrawnMaterial> materials, std::span<const std::size_t> materialOfPart, ReadMesh& read);
/// Adds a vertex that is equal to this one in everything.
void copyVertex(Mesh& mesh, std::uint32_t vertex);
/// The picture as a material of all parts, as glTF has it.
void carryColourMap(const Source& source, const std::string& picture, Mesh& mesh);
/// The same materials as glTF has them, with their pictures; `names`: of each part's material. What glTF cannot say is one warning
/// (TG5331).
void carryObjMaterials(const Source& source, const ObjFile& file, const std::vector<std::string>& names, Mesh& mesh);
[[nodiscard]] Result<ReadMesh> readObj(const Source& source);
[[nodiscard]] Result<ReadMesh> readStl(const Source& source);
[[nodiscard]] Result<ReadMesh> readOff(const Source& source);
/// glb by its magic, else glTF as JSON.
[[nodiscard]] Result<ReadMesh> readGltf(const Source& source);

inline constexpr std::array<MeshFormat, 6> kFormats = {{{".glb", "glb", readGltf, 1000, false, {"glTF"}},
                                                        {".gltf", "glTF", readGltf, 1000},
                                                        {".ply", "PLY", readPly, 1, false, {"ply\n", "ply\r", "ply "}},
                                                        {".obj", "OBJ", readObj, 1},
                                                        {".stl", "STL", readStl, 1, true},
                                                        {".off", "OFF", readOff, 1}}};

[[nodiscard]] Error truncated(SourcePosition at, const std::string& text);                                             // TG5301
[[nodiscard]] Error malformed(SourcePosition at, const std::string& text, std::string hint = "export the mesh again"); // TG5302
[[nodiscard]] Error notANumber(SourcePosition at, std::string_view word);                                              // TG5302
[[nodiscard]] Error overclaimed(SourcePosition at, const std::string& text); // TG5303: counts or offsets that point outside the file
[[nodiscard]] Error badIndex(SourcePosition at, const std::string& text);    // TG5304
[[nodiscard]] Error notFinite(SourcePosition at, const std::string& text);   // TG5305
[[nodiscard]] Error noTriangles(SourcePosition at);                          // TG5306
[[nodiscard]] Error unsupported(SourcePosition at, const std::string& text, std::string hint); // TG5307
[[nodiscard]] Error tooLarge(SourcePosition at);                                               // TG5310
[[nodiscard]] Error outOfMemory(const std::filesystem::path& path);                            // TG5311

/// Chooses `mesh.origin` and fills the positions anew where floats would not hold them, and warns where even then they do not (TG5329).
void settlePlace(const std::filesystem::path& path, ReadMesh& file);

/// The box round what triangles use, from its own corner on. Before `settlePlace`.
[[nodiscard]] Bounds sizeOf(const ReadMesh& file);

/// As if the file, read with 1 mm per unit, had been read with another unit. Before `settlePlace`.
void changeUnit(ReadMesh& file, double unitMm);

void warn(Mesh& mesh, int code, SourcePosition at, std::string text, std::string hint = {});

/// The whole word as a number, whatever the locale. Too large is infinity, too small is 0; "nan" and "inf" are numbers (and refused later
/// as not finite).
[[nodiscard]] bool parseReal(std::string_view word, double& value);

/// A text without the byte order mark that some editors write in front.
[[nodiscard]] std::string_view withoutMark(std::string_view text);

/// A line of text up to a '#' that begins a comment.
[[nodiscard]] std::string_view withoutComment(std::string_view line);

/// The first word of a line of text, taken off it; empty where none is left.
[[nodiscard]] std::string_view nextWord(std::string_view& line);

[[nodiscard]] inline bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Colours of scans are those of pictures (sRGB); alpha is not encoded.
[[nodiscard]] glm::vec4 linearColor(const glm::dvec4& encoded);

/// Multiplied in double precision and rounded once.
[[nodiscard]] inline glm::vec3 scaled(const glm::dvec3& v, double unitMm) {
    return glm::vec3(v * unitMm);
}

} // namespace tegument::meshfile
