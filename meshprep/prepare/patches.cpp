#include "meshprep/prepare/patches.h"

#include <cmath>
#include <limits>

namespace tegument::prep {

Patches divideIntoPatches(std::span<const std::array<glm::dvec3, 3>> triangles, std::span<const double> area) {
    std::vector<glm::dvec3> middle;
    for (const auto& p : triangles)
        middle.push_back((p[0] + p[1] + p[2]) / 3.0);
    Patches patches{.ofTriangle = std::vector<std::uint32_t>(middle.size(), 0), .area = std::vector<double>(kPatches, 0)};
    std::vector<double> nearest(middle.size(), std::numeric_limits<double>::infinity());
    std::size_t seed = 0;
    for (std::uint32_t k = 0; k < kPatches && !middle.empty(); ++k) {
        std::size_t farthest = 0;
        for (std::size_t i = 0; i < middle.size(); ++i) {
            const glm::dvec3 offset = middle[i] - middle[seed];
            const double squared = glm::dot(offset, offset);
            if (squared < nearest[i]) {
                nearest[i] = squared;
                patches.ofTriangle[i] = k;
            }
            if (nearest[i] > nearest[farthest]) farthest = i;
        }
        seed = farthest;
    }
    for (std::size_t i = 0; i < middle.size(); ++i)
        patches.area[patches.ofTriangle[i]] += area[i];
    return patches;
}

double variation(std::span<const double> values, std::span<const double> weights) {
    double total = 0;
    double mean = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        total += weights[i];
        mean += weights[i] * values[i];
    }
    if (!(mean > 0)) return 0;
    mean /= total;
    double squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        squares += weights[i] * (values[i] / mean - 1) * (values[i] / mean - 1);
    return std::sqrt(squares / total);
}

} // namespace tegument::prep
