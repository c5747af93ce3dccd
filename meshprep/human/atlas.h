#pragma once
// Charts packed into the unit square, each scaled and shifted, never turned or mirrored.
// The charts as they lie in the plane before packing: upright, with more room for the face than the file's atlas gives it.
// Charts: faces that share texture coordinates.

#include "host/support/disjoint_sets.h"
#include "meshprep/human/cut.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace tegument {

struct AtlasChart {
    std::vector<std::array<glm::vec2, 3>> triangles; // as the chart lies in the plane before packing
    double surfaceMm2 = 0;                           // area of the chart on the mesh
    double density = 1;                              // texels per mm wanted, relative to the other charts
};

/// In the plane of `triangles`.
[[nodiscard]] double chartArea(const AtlasChart& chart);

/// p -> scale * p + offset.
struct Placement {
    double scale = 1;
    glm::dvec2 offset{0};

    [[nodiscard]] glm::vec2 operator()(const glm::vec2& p) const;
};

/// Places the charts so that their texel densities (square root of chart area over surface) stand in the wanted proportion and are as large
/// as a bitmap packing of kPackingCells^2 cells allows; `gutter` (of the unit square) stays free between charts, half of it along the
/// border. No placement (an empty result) when some chart cannot be placed at all.
[[nodiscard]] std::vector<Placement> packCharts(const std::vector<AtlasChart>& charts, double gutter);

/// For each texture coordinate of the surface its place in the plane. Each chart is turned by quarter turns so that y on the mesh grows
/// upwards in it; the chart of the foremost point (the nose) is widened around that point by `widenFace`. `charts` is of each triangle.
[[nodiscard]] std::vector<glm::vec2> unfoldCharts(const TriangleSurface& surface, const std::vector<std::uint32_t>& charts);

/// A map of the plane that enlarges what is around `centre` at the cost of what is far from it, `halfWidth` away: across by
/// f(s) = 1.4 s / (1 + 0.4 s^2), s = (x - centre.x) / halfWidth; upwards by the integral of 0.9 + 0.7 exp(-t^2 / 2),
/// t = (y - centre.y) / (0.28 halfWidth). Both grow everywhere for |s| <= 1, so nothing folds.
[[nodiscard]] glm::vec2 widenFace(const glm::vec2& p, const glm::vec2& centre, float halfWidth);

/// For each face (with indices `uv`) the number of its chart. Numbers follow the order of first use.
template <class Face>
[[nodiscard]] std::vector<std::uint32_t> chartsOf(const std::vector<Face>& faces) {
    std::uint32_t last = 0;
    for (const Face& face : faces)
        last = std::max(last, std::ranges::max(face.uv));
    DisjointSets sets(last + std::size_t{1});
    for (const Face& face : faces)
        for (const std::uint32_t uv : face.uv)
            sets.join(face.uv[0], uv);
    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<std::uint32_t> result;
    for (const Face& face : faces)
        result.push_back(numbers.try_emplace(sets.find(face.uv[0]), static_cast<std::uint32_t>(numbers.size())).first->second);
    return result;
}

} // namespace tegument
