#pragma once
// Strands as ribbons: a part of a mesh that effects/FurCoat.fx bends into fur. docs/design/fur.md has the layout of their vertices.

#include "meshprep/fur/ribbons/coat_flow.h"
#include "meshprep/fur/roots/root_texture.h"

#include <string>

namespace tegument {

/// Strands that are curves, of which the texture of roots holds the points (docs/design/grooms.md).
struct RibbonCurves {
    std::size_t points = 0;           // of each, 2 to kMostCurvePoints: a row of the ribbon stands at every one
    std::vector<glm::vec3> direction; // of each root, by its number: where its strand lies, as of FlowOptions::told
    std::vector<glm::vec3> color;     // likewise: linear albedo
};
inline constexpr std::size_t kMostCurvePoints = 32;

struct RibbonOptions {
    int segments = 6;                     // of a ribbon, 1 to kMostSegments
    const RibbonCurves* curves = nullptr; // in place of segments, flow, colours and regions
    std::size_t cluster = 256;            // roots of one
    std::optional<glm::dvec3> comb;       // as FlowOptions
    glm::dvec3 down{0, -1, 0};
    std::optional<FurMap> flowMap;   // directions, as of `tegument fur roots`: in place of the comb
    bool encoded = false;            // the colour map holds sRGB
    std::optional<FurMap> colorMap;  // linear albedo, 0..1: white where there is none
    std::optional<FurMap> regionMap; // red: 0 long fur, 1 short as on ears; in place of what the mesh's thickness says
    unsigned threads = 0;            // 0: one a processor
};

inline constexpr int kMostSegments = 15;

struct RibbonFigures {
    std::size_t strands = 0;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t clusters = 0;
    double widestCone = 0; // half its angle, degrees: the median of all clusters
    glm::dvec3 comb{0};
    double seconds = 0;
};

/// The part whose triangles are ribbons (docs/design/fur.md). Their vertices stand on their roots until a shader bends them.
inline constexpr const char* kStrandsPart = "strands";
/// The same ribbons, of fewer segments: for what is short or far.
inline constexpr const char* kUnderfurPart = "underfur";
[[nodiscard]] inline bool isRibbons(const MeshPart& part) {
    return part.name == kStrandsPart || part.name == kUnderfurPart;
}

/// Adds a ribbon for each root as part "strands", and every second row of it as part "underfur", in place of those that are there. The mesh
/// as loadMesh gives it. TG7103 an option that makes no sense, TG7106 a map that the mesh has no coordinates for, TG7109 no texture of
/// roots.
[[nodiscard]] Result<RibbonFigures> addRibbons(Mesh& mesh, const Image& roots, const RibbonOptions& options = {});

/// The same on roots that are made for it: their texture.
[[nodiscard]] Result<Image> growRibbons(Mesh& mesh, const RootOptions& roots, const RibbonOptions& options = {});

[[nodiscard]] bool hasRibbons(const Mesh& mesh);
/// Why the strands of the mesh cannot be drawn with this texture of roots; nothing where they were made from it.
[[nodiscard]] std::optional<std::string> whyNotItsRoots(const Mesh& mesh, const Image& roots);
/// Takes them out.
void removeRibbons(Mesh& mesh);

/// What a ribbon's vertex says besides its place, in floats that hold it exactly.
struct RibbonVertex {
    float along = 0;     // 0 root, 1 tip
    glm::vec3 color{1};  // linear albedo
    float shortness = 0; // 0..1
};
[[nodiscard]] float packRibbonVertex(const RibbonVertex& vertex);
[[nodiscard]] RibbonVertex unpackRibbonVertex(float packed);

} // namespace tegument
