#pragma once
// Meshes as the effects see them: one vertex stream, millimetres, right-handed, counter-clockwise front faces, v down.

#include "host/image/image.h"
#include "host/support/result.h"
#include "host/support/roots.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tegument {

/// Triangles of a part that lie near each other and look one way: what a host can leave out together. Lengths in mm.
struct MeshCluster {
    std::uint32_t firstIndex = 0; // from the part's first one on
    std::uint32_t indexCount = 0;
    glm::vec3 centre{0}; // of a ball that holds its vertices
    float radius = 0;
    glm::vec3 axis{0, 0, 1}; // unit; no normal of its vertices is further from it than the angle
    float cosine = -1;       // of this cosine
};

/// A run of triangles that shares a material or a group name.
struct MeshPart {
    std::string name;
    std::uint32_t firstIndex = 0;
    std::uint32_t indexCount = 0;
    std::vector<MeshCluster> clusters{};     // in order, without gaps; or none
    std::optional<std::uint32_t> material{}; // of the mesh's `materials`
    /// The three vertices of each triangle stand at one place until a vertex shader moves them apart, as those of billboards do: they have
    /// no area, face nowhere, and their texture coordinates are the shader's.
    bool expanded = false;
};

struct Bounds {
    glm::vec3 minimum{0};
    glm::vec3 maximum{0};
    glm::vec3 centre{0}; // of the bounding sphere
    float radius = 0;
};

/// A texture that travels inside the mesh file (glb).
struct EmbeddedTexture {
    std::string role; // "color" (sRGB), "normal", "kernelSize" ...
    Image image;
};

enum class NumberType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// What a file gives its vertices besides what an effect reads: properties of PLY, further texture coordinates and colours of glTF.
struct MeshAttribute {
    std::string name;                      // as in a PLY file; as glTF has it, without the underscore of names that are nobody's
    NumberType type = NumberType::Float32; // how the file stores it
    bool normalised = false;               // whole numbers that stand for 0 to 1, or -1 to 1
    std::size_t components = 1;            // 1 to 4
    std::vector<double> values;            // so many of each vertex, as they are stored
};

/// Materials as a glTF file writes them, carried through without being understood.
struct MaterialSet {
    std::string json;                // an object with "materials" and, where there are any, "textures", "samplers" and "images"
    std::vector<std::string> images; // the files that "images" lists: JPEG stays JPEG
};

struct Motion; // host/mesh/motion.h

struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions; // mm, counted from `origin`
    std::vector<glm::vec3> normals;   // unit
    std::vector<glm::vec4> tangents;  // unit, w = +1 or -1: bitangent = w * cross(normal, tangent) (glTF, MikkTSpace)
    std::vector<glm::vec2> uvs;       // v down (glTF); empty when the file has none
    std::vector<glm::vec4> colors{};  // linear, alpha last; of each vertex, or none
    std::vector<MeshAttribute> attributes{};
    std::vector<std::uint32_t> indices;
    std::vector<MeshPart> parts;
    std::vector<EmbeddedTexture> textures;
    MaterialSet materials{}; // only where they were asked for (ReadOptions::carryMaterials): then `textures` are none
    glm::dvec3 origin{0};    // mm: where the positions count from. Not 0 only where floats would not hold them: a survey's coordinates
    std::string attribution; // shown with every picture of it; from glTF asset.copyright
    double unitMm = 1;       // what one unit of the file was taken for
    Bounds bounds;
    std::shared_ptr<const Motion> motion{};      // what moves it; null: nothing
    std::vector<std::uint32_t> motionVertices{}; // of each vertex, which of the motion's it is
    glm::dmat4 motionRoot{1};                    // from the motion's world to the mesh's, in mm, from 0 on
    std::vector<Diagnostic> warnings;
};

struct MeshOptions {
    std::optional<double> unitMm; // default: 1000 for glTF (metres), the file's own declaration, else 1
    bool flipV = false;           // the file's v runs against its format's convention (the Lee Perry-Smith glb has v up)
    bool guessUnit = false;       // where the size is implausible and no unit is given: take a likely one, and warn (TG5327)
    bool expectHead = false;      // refuse a size implausible for a human head, with a hint to --unit-mm
    glm::vec3 scale{1};           // what its placement scales it by: only the size of a head is judged with it
    bool requireUvs = false;      // TG53xx when there are none
    double overlapWarning = 1e-3; // warn when more than this share of the UV area overlaps or lies outside [0,1]
    bool ownCoordinates = false;  // texture coordinates stay as the file has them, for pictures that come from elsewhere; else those of
                                  // several materials are laid out in one sheet with their pictures and colours
    Roots roots{};                // where else files may lie that the mesh file names: host/support/roots.h
};

/// Sets MeshPart::expanded by the positions, in meshes with texture coordinates.
void markExpandedParts(Mesh& mesh);

/// By content and extension (docs/meshes.md). Normals are made (angle weighted) where absent, tangents where there are UVs.
[[nodiscard]] Result<Mesh> loadMesh(const std::filesystem::path& path, const MeshOptions& options = {});

/// What one unit of a file is likely to be, in mm, where the unit that it was read with makes it smaller than 10 mm or larger than 20 m.
[[nodiscard]] std::optional<double> likelyUnit(const Bounds& bounds, double unitMm);
/// The warning that goes with it: TG5327.
[[nodiscard]] Diagnostic guessedUnit(const std::filesystem::path& path, const Bounds& bounds, double unitMm, double likely);

/// Fills `normals` (angle weighted over equal positions) when empty.
void computeNormals(Mesh& mesh);
/// Fills `tangents` by the MikkTSpace convention, also across mirrored charts; may split vertices.
void computeTangents(Mesh& mesh);
void computeBounds(Mesh& mesh);
/// Fills ball and cone of each cluster of the part from the vertices of its triangles; normals must be there.
void computeClusters(const Mesh& mesh, MeshPart& part);

/// Shares of the total UV area: overlapping another triangle, and outside [0,1].
struct UvReport {
    double overlapping = 0;
    double outside = 0;
    double covered = 0; // of the unit square
};
/// `texels`: along each side of the map on which overlap is counted.
[[nodiscard]] UvReport examineUvs(const Mesh& mesh, int texels = 1024);

} // namespace tegument
