// How much of the UV area overlaps or lies outside the unit square.
//
// Outside is exact: each triangle is clipped to the square (Sutherland and Hodgman, Reentrant polygon clipping, CACM 17(1), 1974) and the
// areas compared. Overlap is counted on texel centres of a map, as the hardware would cover them: coordinates are rounded to
// 1/65536 texel and the edge tests are exact integers with a rule for centres on an edge, so two triangles that share an edge never both
// own a texel. Overlaps narrower than a texel can be missed; they cannot be stored in such a map either.

#include "host/mesh/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#ifndef TEGUMENT_UV_TEXELS
#define TEGUMENT_UV_TEXELS 1024
#endif

namespace tegument {

namespace {

using Polygon = std::vector<glm::dvec2>;

double signedArea(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2& a = polygon[i];
        const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2;
}

/// Keeps the part where sign * (p[axis] - limit) <= 0.
Polygon clipped(const Polygon& polygon, glm::length_t axis, double limit, double sign) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2& a = polygon[i];
        const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
        const double da = sign * (a[axis] - limit);
        const double db = sign * (b[axis] - limit);
        if (da <= 0) result.push_back(a);
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) result.push_back(a + (b - a) * (da / (da - db)));
    }
    return result;
}

Polygon insideUnitSquare(Polygon polygon) {
    for (const glm::length_t axis : {0, 1}) {
        polygon = clipped(polygon, axis, 1, 1);
        polygon = clipped(polygon, axis, 0, -1);
    }
    for (glm::dvec2& point : polygon) // an edge of length 1e30 is cut with an error of 1e14
        point = glm::clamp(point, glm::dvec2(0), glm::dvec2(1));
    return polygon;
}

Polygon triangleAt(const Mesh& mesh, std::size_t firstIndex) {
    return {glm::dvec2(mesh.uvs[mesh.indices[firstIndex]]), glm::dvec2(mesh.uvs[mesh.indices[firstIndex + 1]]),
            glm::dvec2(mesh.uvs[mesh.indices[firstIndex + 2]])};
}

constexpr std::int64_t kSubtexels = 65536;

struct FixedPoint {
    std::int64_t x = 0;
    std::int64_t y = 0;
};

/// Counts how many triangles own each texel.
class CoverageMap {
public:
    explicit CoverageMap(std::int64_t size) : size_(size), counts_(static_cast<std::size_t>(size * size), 0) {}

    /// Corners in the unit square.
    void add(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        std::array<FixedPoint, 3> p = {fixed(a), fixed(b), fixed(c)};
        const std::int64_t area = cross(p[0], p[1], p[2]);
        if (area == 0) return;
        if (area < 0) std::swap(p[1], p[2]);
        const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
        for (std::int64_t row = firstCentre(low); row < size_ && row * kSubtexels + kSubtexels / 2 <= high; ++row)
            addRow(p, row);
    }

    [[nodiscard]] const std::vector<std::uint32_t>& counts() const { return counts_; }

private:
    [[nodiscard]] FixedPoint fixed(const glm::dvec2& uv) const {
        const auto scale = static_cast<double>(size_ * kSubtexels);
        return {std::llround(uv.x * scale), std::llround(uv.y * scale)};
    }

    /// The first texel whose centre is not below `coordinate`.
    static std::int64_t firstCentre(std::int64_t coordinate) {
        return std::max<std::int64_t>(0, (coordinate - kSubtexels / 2 + kSubtexels - 1) / kSubtexels);
    }

    static std::int64_t cross(const FixedPoint& a, const FixedPoint& b, const FixedPoint& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }

    /// Of a centre on an edge only one of the two triangles, which run through the edge in opposite directions, is the owner.
    static bool owns(const std::array<FixedPoint, 3>& p, const FixedPoint& centre) {
        for (std::size_t i = 0; i < 3; ++i) {
            const FixedPoint& a = p[i];
            const FixedPoint& b = p[(i + 1) % 3];
            const std::int64_t side = cross(a, b, centre);
            const bool ownsEdge = b.y > a.y || (b.y == a.y && b.x < a.x);
            if (side < 0 || (side == 0 && !ownsEdge)) return false;
        }
        return true;
    }

    void addRow(const std::array<FixedPoint, 3>& p, std::int64_t row) {
        const std::int64_t y = row * kSubtexels + kSubtexels / 2;
        const auto [from, to] = span(p, y);
        for (std::int64_t column = firstCentre(from); column < size_; ++column) {
            const FixedPoint centre{column * kSubtexels + kSubtexels / 2, y};
            if (centre.x > to) break;
            if (owns(p, centre)) ++counts_[static_cast<std::size_t>(row * size_ + column)];
        }
    }

    /// Where the row at height y crosses the triangle, widened by one subtexel for the division's rounding.
    static std::pair<std::int64_t, std::int64_t> span(const std::array<FixedPoint, 3>& p, std::int64_t y) {
        std::int64_t from = INT64_MAX;
        std::int64_t to = INT64_MIN;
        for (std::size_t i = 0; i < 3; ++i) {
            const FixedPoint& a = p[i];
            const FixedPoint& b = p[(i + 1) % 3];
            if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y) continue;
            const bool level = a.y == b.y;
            const std::int64_t x = level ? a.x : a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
            from = std::min({from, x - 1, level ? b.x : from});
            to = std::max({to, x + 1, level ? b.x : to});
        }
        return {from, to};
    }

    std::int64_t size_;
    std::vector<std::uint32_t> counts_;
};

/// Fewer texels for a mesh whose triangles cover the square hundreds of times over, so that the time stays bounded; its overlap shows
/// anyway.
std::int64_t mapSize(double insideArea, double full) {
    constexpr double kMostLayers = 64;
    return static_cast<std::int64_t>(std::max(16.0, full * std::sqrt(std::min(1.0, kMostLayers / std::max(insideArea, 1.0)))));
}

bool isExpanded(const Mesh& mesh, std::size_t index) {
    return std::ranges::any_of(mesh.parts, [&](const MeshPart& part) {
        return part.expanded && index >= part.firstIndex && index - part.firstIndex < part.indexCount;
    });
}

} // namespace

UvReport examineUvs(const Mesh& mesh, int texels) {
    if (mesh.uvs.empty()) return {};
    double total = 0;
    double inside = 0;
    std::vector<Polygon> polygons;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        if (isExpanded(mesh, i)) continue;
        const Polygon triangle = triangleAt(mesh, i);
        Polygon kept = insideUnitSquare(triangle);
        total += std::abs(signedArea(triangle));
        inside += std::abs(signedArea(kept));
        if (kept.size() >= 3) polygons.push_back(std::move(kept));
    }
    CoverageMap map(mapSize(inside, std::min(texels, TEGUMENT_UV_TEXELS)));
    for (const Polygon& polygon : polygons)
        for (std::size_t i = 2; i < polygon.size(); ++i)
            map.add(polygon[0], polygon[i - 1], polygon[i]);

    double covered = 0;
    double coverings = 0;
    double shared = 0;
    for (const std::uint32_t count : map.counts()) {
        covered += count > 0;
        coverings += count;
        shared += count > 1 ? count : 0;
    }
    UvReport report;
    report.covered = covered / static_cast<double>(map.counts().size());
    if (total > 0) report.outside = std::clamp((total - inside) / total, 0.0, 1.0);
    if (coverings > 0) report.overlapping = shared / coverings * (1 - report.outside);
    return report;
}

} // namespace tegument
