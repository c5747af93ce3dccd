#pragma once
// Charts packed into the unit square, each scaled and shifted, never turned or mirrored.

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
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

} // namespace tegument
