#pragma once
// Roots as one float texture that shaders of every target can read, Direct3D 9 included: a grid of bricks of cells, the lists of the cells,
// the roots. docs/design/fur.md, "Roots", has the layout.

#include "host/image/image.h"
#include "meshprep/fur/roots/roots.h"

#include <span>

namespace tegument {

inline constexpr int kRootColumns = 4096;     // of the texture, always
inline constexpr std::size_t kRootTexels = 3; // of one root
inline constexpr int kNodeCells = 4;          // from one node of the coat's lean and density to the next

struct RootTexture {
    Image image; // RGBA
    glm::ivec3 bricks{0};
    int brick = 0; // cells along a brick's side
    std::size_t usedBricks = 0;
    std::size_t usedCells = 0;  // that list a root
    std::size_t listed = 0;     // entries of all lists
    std::size_t mostListed = 0; // entries of one list
    std::size_t mostTexels = 0; // texels of one list: the bound of the shader's loop
    std::size_t texels = 0;     // in use
    double seconds = 0;
};

/// Puts the roots into the order of their cells. TG7107 where the texture would be larger than 4096 x 4096.
[[nodiscard]] Result<RootTexture> buildRootTexture(RootSet& set, unsigned threads = 0);

/// The reader that docs/design/fur.md describes, in the shader's arithmetic: numbers of the roots that the cell around a point lists.
[[nodiscard]] std::vector<std::size_t> rootsAround(const Image& image, const glm::vec3& point);
/// Lean and density of the coat at a point, between the nodes of its brick; 0 where there is no brick.
[[nodiscard]] glm::vec4 coatAround(const Image& image, const glm::vec3& point);
/// Of the mesh that the roots were made for; nothing in files of earlier versions, and in pictures that hold no roots.
[[nodiscard]] std::optional<SurfaceFigures> figuresIn(const Image& image);
/// What the first row says of all roots.
struct RootHeader {
    std::size_t count = 0;
    std::size_t firstRoot = 0; // address
    double density = 0;        // full, roots per mm^2
    glm::dvec3 centre{0};      // of the mesh's ball, mm
    double ballRadius = 0;
    // Of strands that are curves (docs/design/grooms.md); 0 where they are not.
    std::size_t firstPoint = 0;  // address: a texel for each point, from the root on: how far from the root, mm; radius, mm
    std::size_t curvePoints = 0; // of each strand
    double farthest = 0;         // from its root, mm
    double widest = 0;           // radius, mm
    bool painted = false;        // the strands' vertices hold colours
    glm::vec3 low{0};            // of all points
    glm::vec3 high{0};

    [[nodiscard]] std::size_t addressOf(std::size_t number) const;
};
/// Nothing where the picture holds no roots, or fewer than it says.
[[nodiscard]] std::optional<RootHeader> rootHeader(const Image& image);
/// The root with this number, as its texels say.
[[nodiscard]] Root rootAt(const Image& image, std::size_t number);

} // namespace tegument
