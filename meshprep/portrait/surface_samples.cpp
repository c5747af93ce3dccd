#include "meshprep/portrait/surface_samples.h"

#include <cmath>
#include <utility>

namespace tegument {

namespace {

/// The corners in an order that is the same however the triangle lies, and seen from either side: by the edge across.
glm::ivec3 orderOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 across(glm::length(c - b), glm::length(a - c), glm::length(b - a));
    glm::ivec3 order(0, 1, 2);
    for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)})
        if (across[order[j]] < (1 - 1e-6) * across[order[i]]) std::swap(order[i], order[j]);
    return order;
}

} // namespace

std::vector<SurfaceSample> sampleSurface(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, int count) {
    const auto at = [&](std::size_t i) { return glm::dvec3(positions[indices[i]]); };
    const auto twiceArea = [&](std::size_t i) { return glm::cross(at(i + 1) - at(i), at(i + 2) - at(i)); };
    double total = 0;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        total += glm::length(twiceArea(i));
    std::vector<SurfaceSample> samples;
    if (!(total > 0) || !std::isfinite(total)) return samples;
    samples.reserve(static_cast<std::size_t>(count) + 1);
    double reached = 0;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 cross = twiceArea(i);
        const double area = glm::length(cross);
        if (!(area > 0)) continue;
        reached += area;
        const glm::ivec3 order = orderOf(at(i), at(i + 1), at(i + 2));
        while ((static_cast<double>(samples.size()) + 0.5) / count * total < reached && samples.size() < static_cast<std::size_t>(count)) {
            const double n = static_cast<double>(samples.size()) + 1; // the R2 sequence: even in two dimensions
            double a = std::fmod(n * 0.7548776662466927, 1.0), b = std::fmod(n * 0.5698402909980532, 1.0);
            if (a + b > 1) a = 1 - a, b = 1 - b;
            glm::dvec3 corners;
            corners[order[0]] = 1 - a - b, corners[order[1]] = a, corners[order[2]] = b;
            samples.push_back({.point = corners.x * at(i) + corners.y * at(i + 1) + corners.z * at(i + 2),
                               .normal = cross / area,
                               .triangle = static_cast<std::uint32_t>(i / 3),
                               .corners = corners});
        }
    }
    return samples;
}

} // namespace tegument
