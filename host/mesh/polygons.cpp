// Polygons into triangles by ear clipping (G. H. Meisters, Polygons have ears, American Mathematical Monthly 82(6), 1975), in the plane
// that the polygon faces most: its normal is M. E. Newell's sum over the edges, which holds for slightly bent polygons too.

#include "host/mesh/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace tegument::meshfile {

namespace {

/// The time grows with the square of a polygon's corners; this many take some 50 ms.
constexpr std::size_t kMostCorners = 10000;

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Corners seen from the side where they run counter-clockwise, scaled to about 1; empty when they span no area.
std::vector<glm::dvec2> flattened(const std::vector<glm::dvec3>& points) {
    glm::dvec3 size(0);
    for (const glm::dvec3& point : points)
        size = glm::max(size, glm::abs(point - points[0]));
    const double scale = std::max({size.x, size.y, size.z});
    if (!(scale > 0) || !std::isfinite(scale)) return {};
    glm::dvec3 normal(0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 a = (points[i] - points[0]) / scale;
        const glm::dvec3 b = (points[(i + 1) % points.size()] - points[0]) / scale;
        normal += glm::cross(a, b);
    }
    const glm::dvec3 extent = glm::abs(normal);
    glm::length_t axis = 0;
    for (const glm::length_t other : {1, 2})
        if (extent[other] > extent[axis]) axis = other;
    if (!(extent[axis] > 0)) return {};
    const glm::length_t u = (axis + 1) % 3;
    const glm::length_t v = (axis + 2) % 3;
    std::vector<glm::dvec2> flat;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 p = (point - points[0]) / scale;
        flat.push_back(normal[axis] > 0 ? glm::dvec2(p[u], p[v]) : glm::dvec2(p[v], p[u]));
    }
    return flat;
}

/// Corners are rounded to floats, so that a triangle of unit size may be this much smaller than it was meant to be.
constexpr double kRounding = 2.5e-7;

/// All of the outline is seen from the first corner, as in every convex polygon: the fan fills it.
bool fanFits(const std::vector<glm::dvec2>& p) {
    for (std::size_t i = 2; i < p.size(); ++i)
        if (cross(p[0], p[i - 1], p[i]) < -kRounding) return false;
    return true;
}

/// A ring of corners from which ears are cut one by one.
class Ring {
public:
    explicit Ring(const std::vector<glm::dvec2>& points) : p_(points), next_(points.size()), previous_(points.size()) {
        const std::size_t n = points.size();
        for (std::size_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
    }

    /// Positions in the polygon, three per triangle.
    std::vector<std::size_t> cut() {
        std::vector<std::size_t> triangles;
        std::size_t at = 0;
        std::size_t tried = 0;
        for (std::size_t left = p_.size(); left >= 3;) {
            // a ring that crosses itself may have no ear: then any corner goes, and the loop still ends
            if (!isEar(at) && tried < left) {
                at = next_[at];
                ++tried;
                continue;
            }
            triangles.insert(triangles.end(), {previous_[at], at, next_[at]});
            next_[previous_[at]] = next_[at];
            previous_[next_[at]] = previous_[at];
            at = next_[next_[at]]; // leave the neighbour its turn: alternating ears make fewer slivers than a fan
            tried = 0;
            --left;
        }
        return triangles;
    }

private:
    [[nodiscard]] bool isEar(std::size_t at) const {
        const glm::dvec2& a = p_[previous_[at]];
        const glm::dvec2& b = p_[at];
        const glm::dvec2& c = p_[next_[at]];
        if (!(cross(a, b, c) > 0)) return false;
        for (std::size_t other = next_[next_[at]]; other != previous_[at]; other = next_[other]) {
            const glm::dvec2& p = p_[other];
            const bool corner = p == a || p == b || p == c; // a hole is joined by a slit, whose ends occur twice
            if (!corner && cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
        }
        return true;
    }

    const std::vector<glm::dvec2>& p_;
    std::vector<std::size_t> next_;
    std::vector<std::size_t> previous_;
};

} // namespace

void Polygons::add(std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& indices) {
    if (corners.size() > 3) fans_.push_back({.firstIndex = indices.size(), .corners = corners.size()});
    for (std::size_t i = 2; i < corners.size(); ++i)
        indices.insert(indices.end(), {corners[0], corners[i - 1], corners[i]});
}

std::optional<Error> Polygons::cut(const Source& source, const std::vector<glm::vec3>& positions, const std::vector<glm::dvec3>& exact,
                                   std::vector<std::uint32_t>& indices) {
    std::vector<std::uint32_t> corners;
    std::vector<glm::dvec3> points;
    for (const Fan& fan : fans_) {
        const auto first = indices.begin() + static_cast<std::ptrdiff_t>(fan.firstIndex);
        corners.assign({first[0], first[1]});
        for (std::size_t i = 2; i < fan.corners; ++i)
            corners.push_back(first[static_cast<std::ptrdiff_t>(3 * (i - 2) + 2)]);
        points.clear();
        for (const std::uint32_t corner : corners)
            points.push_back(exact.empty() ? glm::dvec3(positions[corner]) : exact[corner]);
        const std::vector<glm::dvec2> flat = flattened(points);
        if (flat.empty() || fanFits(flat)) continue; // without area nothing fits better
        if (fan.corners > kMostCorners)
            return unsupported(source.whole(), fmt::format("a polygon of {} corners that are not all seen from the first", fan.corners),
                               "export triangles");
        std::ranges::transform(Ring(flat).cut(), first, [&](std::size_t corner) { return corners[corner]; });
    }
    return std::nullopt;
}

} // namespace tegument::meshfile
