#pragma once
// A Wavefront OBJ file as it is written: polygons whose corners name a position, a texture coordinate and a normal apart, in groups.
// `readMesh` makes triangles of it.

#include "host/support/result.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

/// Indices from 0.
struct ObjCorner {
    static constexpr std::uint32_t kNone = UINT32_MAX; // the corner names no texture coordinate or normal

    std::uint32_t position = kNone;
    std::uint32_t uv = kNone;
    std::uint32_t normal = kNone;
    bool operator==(const ObjCorner&) const = default;
};

/// Faces in a row that share the names in force: of `o`, `g` and `usemtl`.
struct ObjSection {
    std::string object;
    std::string group;
    std::string material;
    std::size_t firstFace = 0;
};

struct ObjFile {
    struct Face {
        std::uint32_t firstCorner = 0;
        int line = 0;
    };

    std::vector<glm::vec3> positions; // the file's coordinates times the unit
    std::vector<glm::dvec3> exact;    // the same in double precision
    std::vector<glm::vec4> colors;    // linear, of each position; none where no position has one
    std::vector<glm::dvec2> uvs;      // v up
    std::vector<glm::vec3> normals;   // of any length
    std::vector<ObjCorner> corners;
    std::vector<Face> faces; // of any number of corners
    std::vector<ObjSection> sections;
    std::vector<ObjCorner> lineCorners;         // of lines, one after the other
    std::vector<std::uint32_t> firstOfLine;     // corner of each line that names what is there, or what may still come
    std::vector<std::string> libraries;         // of materials, as the file names them
    std::size_t badFaces = 0;                   // not among `faces`: they name an element before the first or beyond all that could be
    std::size_t absentUvs = 0;                  // corners that name texture coordinates which the file has not: they name none
    std::size_t absentNormals = 0;              // the same of normals
    std::map<std::string, int> otherStatements; // the first line of each that is not understood

    [[nodiscard]] std::span<const ObjCorner> cornersOf(std::size_t face) const;
    /// One behind the last face of a section.
    [[nodiscard]] std::size_t endOf(std::size_t section) const;
    /// Whether all that the corner names is there.
    [[nodiscard]] bool holds(const ObjCorner& corner) const;
};

/// A text in its own unit. TG5302 what is not understood, TG5304 a corner that names what is not there, TG5305 a coordinate that is not
/// finite, TG5310 too large; each with its line of `file`.
[[nodiscard]] Result<ObjFile> parseObj(std::string_view text, const std::filesystem::path& file);

/// A file that an OBJ file or its library names, as seen from a folder. Such names often come from Windows, where case does not count, or
/// are places of another machine: what is not there is looked for in the folder by its last word.
[[nodiscard]] std::filesystem::path objFileIn(const std::filesystem::path& folder, std::string name);

/// The libraries of one statement `mtllib`: one whose name may hold spaces, or several.
[[nodiscard]] std::vector<std::filesystem::path> objLibrariesIn(const std::filesystem::path& folder, const std::string& names);

/// The picture of a statement `map_... [-option values...] name`: the name may hold spaces.
[[nodiscard]] std::string objPictureName(std::string_view rest);

} // namespace tegument
