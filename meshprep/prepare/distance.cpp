// Nearest points by a tree of boxes. It works in single precision, so the surfaces are brought to unit
// size around the origin first.

#include "meshprep/prepare/distance.h"

#include "host/support/rays/surface_tree.h"
#include "meshprep/prepare/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tegument::prep {

namespace {

class Surface {
public:
    Surface(const std::vector<glm::dvec3>& positions, std::span<const std::uint32_t> triangles)
        : positions_(positions), triangles_(triangles), tree_(std::vector<glm::vec3>(positions.begin(), positions.end()), triangles, {}) {}

    [[nodiscard]] double squaredDistance(const glm::dvec3& point) const {
        constexpr float kAll = std::numeric_limits<float>::infinity();
        double least = std::numeric_limits<double>::infinity();
        float radius = kAll;
        tree_.visitNear(glm::vec3(point), kAll, [&](std::uint32_t triangle) {
            const std::uint32_t* t = &triangles_[3 * std::size_t{triangle}];
            const glm::dvec3 offset = nearestOnTriangle(point, positions_[t[0]], positions_[t[1]], positions_[t[2]]) - point;
            const double squared = glm::dot(offset, offset);
            if (squared < least) { // not a number where two corners are equal: such a triangle is a side of others
                least = squared;
                radius = std::nextafter(static_cast<float>(std::sqrt(squared)), 1e30f);
            }
            return radius;
        });
        return least;
    }

private:
    const std::vector<glm::dvec3>& positions_;
    std::span<const std::uint32_t> triangles_;
    SurfaceTree tree_;
};

} // namespace

SurfaceDistance distance(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to) {
    if (from.empty() || to.empty()) return {};
    glm::dvec3 low(positions[from[0]]);
    glm::dvec3 high = low;
    for (const std::uint32_t index : from) {
        low = glm::min(low, glm::dvec3(positions[index]));
        high = glm::max(high, glm::dvec3(positions[index]));
    }
    const glm::dvec3 size = high - low;
    const double scale = std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
    std::vector<glm::dvec3> points;
    points.reserve(positions.size());
    for (const glm::vec3& p : positions)
        points.push_back((glm::dvec3(p) - low) / scale);
    const Surface surface(points, to);
    double greatest = 0;
    double sum = 0;
    std::size_t count = 0;
    const auto add = [&](const glm::dvec3& point) {
        const double squared = surface.squaredDistance(point);
        greatest = std::max(greatest, squared);
        sum += squared;
        ++count;
    };
    std::vector<bool> done(positions.size(), false);
    for (std::size_t i = 0; i < from.size(); i += 3) {
        add((points[from[i]] + points[from[i + 1]] + points[from[i + 2]]) / 3.0);
        for (const std::uint32_t corner : from.subspan(i, 3)) {
            if (!done[corner]) add(points[corner]);
            done[corner] = true;
        }
    }
    return {.greatest = scale * std::sqrt(greatest), .rms = scale * std::sqrt(sum / static_cast<double>(count))};
}

} // namespace tegument::prep
