#pragma once
// A surface unwrapped into a map: what is known of each texel's point, how dense the texels lie on the surface, and both blurs of
// docs/design/skin.md by them.

#include "lab/reference/convolution.h"
#include "lab/reference/surface.h"

#include <functional>

namespace tegument::reference {

struct ChartMap {
    Map map;
    std::vector<glm::dvec2> density; // texels per mm along u and v; 0 outside the charts

    [[nodiscard]] glm::dvec2 densityAt(int x, int y) const { return density[map.index(x, y)]; }
};

/// Of the triangles that cover the texels' centres.
[[nodiscard]] std::vector<glm::dvec2> densities(const Mesh& mesh, const Unwrapped& places);

/// value(point) of the point under each texel's centre; texels without one are not valid.
[[nodiscard]] ChartMap chartMap(const Mesh& mesh, int size, const std::function<glm::dvec4(const SurfacePoint&)>& value);

/// By one Gaussian of this variance, mm^2. What the texels' own squares have blurred is counted in.
[[nodiscard]] Map spread(const ChartMap& given, double variance);

/// Poisson discs one after the other, each as wide as the texel's alpha, the kernel size, says. Three is the seed's number.
struct Discs {
    double size = 1.2;     // mm where the kernel size is 1; as printed: pairs of texels
    double turn = 2.39996; // radians from disc to disc
    int count = 3;
    bool asPrinted = false; // the points' mean left in, Table 7 at the seams
};
[[nodiscard]] Map spread(const ChartMap& given, const Discs& discs);

} // namespace tegument::reference
