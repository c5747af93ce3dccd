#include "meshprep/portrait/surface_samples.h"

#include <cmath>

namespace tegument {

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
        while ((static_cast<double>(samples.size()) + 0.5) / count * total < reached && samples.size() < static_cast<std::size_t>(count)) {
            const double n = static_cast<double>(samples.size()) + 1; // the R2 sequence: even in two dimensions
            double a = std::fmod(n * 0.7548776662466927, 1.0), b = std::fmod(n * 0.5698402909980532, 1.0);
            if (a + b > 1) a = 1 - a, b = 1 - b;
            const glm::dvec3 corners(1 - a - b, a, b);
            samples.push_back({.point = corners.x * at(i) + corners.y * at(i + 1) + corners.z * at(i + 2),
                               .normal = cross / area,
                               .triangle = static_cast<std::uint32_t>(i / 3),
                               .corners = corners});
        }
    }
    return samples;
}

} // namespace tegument
