#pragma once
// How a mesh lies on its texture, triangle by triangle, and the colours in which that is drawn on it. Ribbons of fur have no place on the
// texture and are left out. Needs no window and no GPU.

#include "host/mesh/mesh.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tegument::view {

/// In the order in which the key shows them.
enum class MeshShow { None, Texels, Stretch, Seams, Fur };

/// By area: one hundredth of the surface lies below `low`, one above `high`.
struct Spread {
    double low = 0;
    double median = 0;
    double high = 0;
};

struct MeshTriangle {
    std::array<std::uint32_t, 3> corners{};
    double area = 0;              // mm^2
    double scale = 0;             // of lengths, from mm to the side of the texture: the root of the areas' ratio; 0: no area there
    double stretch = 0;           // the longest of what a circle becomes on the texture over the shortest; infinite where there is no area
    std::array<bool, 3> seam{};   // of the edge from corner i to the next: the texture continues elsewhere
    std::array<bool, 3> border{}; // no triangle beyond
    std::uint32_t number = 0;     // in the mesh
    double fur = 0;               // roots per mm^2, there and about
};

struct MeshFigures {
    std::vector<MeshTriangle> triangles;
    std::size_t vertices = 0;   // that they use
    std::size_t components = 0; // joined at vertices of one place
    std::size_t flat = 0;       // on the texture, without area
    std::size_t mirrored = 0;   // on the texture
    double seamLength = 0;      // mm; each seam once
    double borderLength = 0;
    Spread scale; // of what has an area
    Spread stretch;
    std::size_t roots = 0; // of fur
    double furryArea = 0;  // mm^2, of triangles with roots about
    Spread fur;            // of those
};
[[nodiscard]] MeshFigures examineMesh(const Mesh& mesh);

/// Counts roots of fur; `onto`: for each the triangle of the mesh that it stands on. A triangle's density is that of an area about it, by
/// the sums of roots and of mm^2, wide enough for some thirty roots: single triangles have one or none.
void countRoots(MeshFigures& figures, const Mesh& mesh, std::span<const std::uint32_t> onto);

struct LegendEntry {
    std::array<float, 3> color{};
    std::string label;
};
[[nodiscard]] std::vector<LegendEntry> legendOf(MeshShow show, const MeshFigures& figures, double texels);
/// Of the whole triangle. Magenta: it has no area on the texture.
[[nodiscard]] std::array<float, 3> colorOf(MeshShow show, const MeshTriangle& triangle, const MeshFigures& figures);
/// "35,709 vertices, 70,122 triangles, 6 components" and more, a line each. `texels`: along each side of the texture.
[[nodiscard]] std::vector<std::string> linesOf(MeshShow show, const MeshFigures& figures, double texels);

} // namespace tegument::view
