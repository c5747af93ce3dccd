#include "lab/reference/chart_map.h"

#include <algorithm>

namespace tegument::reference {

std::vector<glm::dvec2> densities(const Mesh& mesh, const Unwrapped& places) {
    std::vector<glm::dvec2> result;
    for (const auto& place : places.texels) {
        const auto j = place ? jacobian(mesh, place->triangle) : std::nullopt;
        result.push_back(j ? glm::dvec2(places.size / glm::length(j->alongU), places.size / glm::length(j->alongV)) : glm::dvec2(0));
    }
    return result;
}

ChartMap chartMap(const Mesh& mesh, int size, const std::function<glm::dvec4(const SurfacePoint&)>& value) {
    const Unwrapped places = unwrap(mesh, size);
    ChartMap result{.map = {.size = size}, .density = densities(mesh, places)};
    for (const auto& place : places.texels) {
        result.map.valid.push_back(place ? 1 : 0);
        result.map.texels.push_back(place ? value(interpolate(mesh, *place)) : glm::dvec4(0));
    }
    return result;
}

Map spread(const ChartMap& given, double variance) {
    constexpr double kTexelVariance = 1.0 / 12; // a texel is the mean over its square
    return gaussian(given.map, [&](int x, int y) {
        const glm::dvec2 d2 = given.densityAt(x, y) * given.densityAt(x, y);
        return Spread{std::max(variance * d2.x - kTexelVariance, 0.0), std::max(variance * d2.y - kTexelVariance, 0.0)};
    });
}

Map spread(const ChartMap& given, const Discs& discs) {
    Map blurred = given.map;
    for (int i = 0; i < discs.count; ++i)
        blurred = poisson(blurred, [&](int x, int y) {
            const glm::dvec2 texels = discs.asPrinted ? glm::dvec2(2) : given.densityAt(x, y); // equation 40: 1 / width + 1 / height
            const double kernel = blurred.texels[blurred.index(x, y)].w;
            return Disc{
                .radius = discs.size * kernel * texels, .turn = i * discs.turn, .centred = !discs.asPrinted, .repair = discs.asPrinted};
        });
    return blurred;
}

} // namespace tegument::reference
