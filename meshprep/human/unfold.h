#pragma once
// The charts as they lie in the plane before packing: upright, with more room for the face than the file's atlas gives it.

#include "meshprep/human/cut.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace tegument {

/// For each texture coordinate of the surface its place in the plane. Each chart is turned by quarter turns so that y on the mesh grows
/// upwards in it; the chart of the foremost point (the nose) is widened around that point by `widenFace`. `charts` is of each triangle.
[[nodiscard]] std::vector<glm::vec2> unfoldCharts(const TriangleSurface& surface, const std::vector<std::uint32_t>& charts);

/// A map of the plane that enlarges what is around `centre` at the cost of what is far from it, `halfWidth` away: across by
/// f(s) = 1.4 s / (1 + 0.4 s^2), s = (x - centre.x) / halfWidth; upwards by the integral of 0.9 + 0.7 exp(-t^2 / 2),
/// t = (y - centre.y) / (0.28 halfWidth). Both grow everywhere for |s| <= 1, so nothing folds.
[[nodiscard]] glm::vec2 widenFace(const glm::vec2& p, const glm::vec2& centre, float halfWidth);

} // namespace tegument
