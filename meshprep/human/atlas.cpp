// Charts are drawn into a grid of cells, grown by half the gutter, and placed largest first, each at the highest free place; the common
// scale is found by bisection. (B. Levy, S. Petitjean, N. Ray, J. Maillot, Least Squares Conformal Maps, 2002, section 4, packs by
// horizons; with a handful of charts all cells can be tried instead, so that charts may lie inside each other's hollows.)

#include "meshprep/human/atlas.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

namespace tegument {

namespace {

constexpr std::size_t kPackingCells = 512;
constexpr int kBisections = 12;

using Row = std::bitset<kPackingCells>;

/// The cells that a chart touches, with the lower corner of its cell (0, 0).
struct Stamp {
    std::vector<Row> rows;
    std::size_t width = 0;
    glm::dvec2 corner{0}; // in cells
};

using Triangle = std::array<glm::dvec2, 3>;

/// Whether an axis-aligned square around `centre` meets the triangle: separating axes of both.
bool meets(const Triangle& t, const glm::dvec2& centre, double half) {
    for (const glm::length_t axis : {0, 1}) {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        if (low > centre[axis] + half || high < centre[axis] - half) return false;
    }
    for (std::size_t e = 0; e < 3; ++e) {
        const glm::dvec2 along = t[(e + 1) % 3] - t[e];
        const glm::dvec2 normal(along.y, -along.x);
        const double inner = glm::dot(t[(e + 2) % 3] - t[e], normal);
        const double reach = half * (std::abs(normal.x) + std::abs(normal.y));
        const double side = glm::dot(centre - t[e], normal);
        if (inner >= 0 ? side < -reach || side > inner + reach : side > reach || side < inner - reach) return false;
    }
    return true;
}

/// Cells whose square, grown by `grow` cells on each side, meets a triangle. Nothing if the chart is larger than the grid.
std::optional<Stamp> makeStamp(const AtlasChart& chart, double cellsPerUnit, double grow) {
    std::vector<Triangle> triangles;
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(std::numeric_limits<double>::lowest());
    for (const auto& triangle : chart.triangles) {
        Triangle t{};
        for (std::size_t c = 0; c < 3; ++c) {
            t[c] = glm::dvec2(triangle[c]) * cellsPerUnit;
            low = glm::min(low, t[c]);
            high = glm::max(high, t[c]);
        }
        triangles.push_back(t);
    }
    const glm::dvec2 corner = low - grow;
    const glm::dvec2 size = glm::ceil(high - low + 2 * grow);
    if (!(std::max(size.x, size.y) <= static_cast<double>(kPackingCells))) return std::nullopt;
    Stamp stamp{.rows = std::vector<Row>(static_cast<std::size_t>(size.y)), .width = static_cast<std::size_t>(size.x), .corner = corner};
    for (Triangle& t : triangles) {
        for (glm::dvec2& p : t)
            p -= corner;
        const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
        const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
        const auto first = [&](double v) { return static_cast<std::size_t>(std::max(0.0, std::floor(v - grow))); };
        const auto last = [&](double v, std::size_t count) { return std::min(count, static_cast<std::size_t>(std::ceil(v + grow))); };
        for (std::size_t y = first(y0); y < last(y1, stamp.rows.size()); ++y)
            for (std::size_t x = first(x0); x < last(x1, stamp.width); ++x)
                if (!stamp.rows[y][x] && meets(t, glm::dvec2(x, y) + 0.5, 0.5 + grow)) stamp.rows[y].set(x);
    }
    return stamp;
}

/// The highest row, and in it the leftmost column, where the stamp meets nothing.
std::optional<std::pair<std::size_t, std::size_t>> findPlace(const std::vector<Row>& taken, const Stamp& stamp) {
    for (std::size_t y = kPackingCells - stamp.rows.size() + 1; y-- > 0;)
        for (std::size_t x = 0; x + stamp.width <= kPackingCells; ++x) {
            const auto free = [&](std::size_t row) { return (taken[y + row] & (stamp.rows[row] << x)).none(); };
            std::size_t row = 0;
            while (row < stamp.rows.size() && free(row))
                ++row;
            if (row == stamp.rows.size()) return std::pair(x, y);
        }
    return std::nullopt;
}

/// Scale that gives the chart one unit of length per mm on the mean, times the wanted density.
double baseScale(const AtlasChart& chart) {
    return chart.density * std::sqrt(chart.surfaceMm2 / chartArea(chart));
}

std::optional<Placement> place(const AtlasChart& chart, double scale, double grow, std::vector<Row>& taken) {
    const double cells = static_cast<double>(kPackingCells);
    const std::optional<Stamp> stamp = makeStamp(chart, scale * cells, grow);
    if (!stamp) return std::nullopt;
    const auto found = findPlace(taken, *stamp);
    if (!found) return std::nullopt;
    const auto [x, y] = *found;
    for (std::size_t row = 0; row < stamp->rows.size(); ++row)
        taken[y + row] |= stamp->rows[row] << x;
    return Placement{.scale = scale, .offset = (glm::dvec2(x, y) - stamp->corner) / cells};
}

std::optional<std::vector<Placement>> tryScale(const std::vector<AtlasChart>& charts, const std::vector<std::size_t>& order, double scale,
                                               double grow) {
    std::vector<Row> taken(kPackingCells);
    std::vector<Placement> result(charts.size());
    for (const std::size_t i : order) {
        const std::optional<Placement> placed = place(charts[i], scale * baseScale(charts[i]), grow, taken);
        if (!placed) return std::nullopt;
        result[i] = *placed;
    }
    return result;
}

/// For each chart the mean direction, in texture space, in which y grows on the mesh.
std::vector<glm::dvec2> upDirections(const TriangleSurface& surface, const std::vector<std::uint32_t>& charts) {
    std::vector<glm::dvec2> up(std::size_t{1} + std::ranges::max(charts), glm::dvec2(0));
    for (std::size_t t = 0; t < charts.size(); ++t) {
        const CornerTriangle& triangle = surface.triangles[t];
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t next = (c + 1) % 3;
            const float rise = surface.positions[triangle.position[next]].y - surface.positions[triangle.position[c]].y;
            up[charts[t]] += glm::dvec2((surface.uvs[triangle.uv[next]] - surface.uvs[triangle.uv[c]]) * rise);
        }
    }
    return up;
}

/// By the quarter turn that brings `up` nearest to (0, 1).
glm::vec2 turnUpright(const glm::vec2& p, const glm::dvec2& up) {
    if (std::abs(up.y) >= std::abs(up.x)) return up.y >= 0 ? p : -p;
    return up.x >= 0 ? glm::vec2(-p.y, p.x) : glm::vec2(p.y, -p.x);
}

struct Foremost {
    std::uint32_t chart = 0;
    std::uint32_t uv = 0;
};

/// Of the skin; nothing where there is none.
std::optional<Foremost> foremostPoint(const TriangleSurface& surface, const std::vector<std::uint32_t>& charts) {
    std::optional<Foremost> result;
    float z = std::numeric_limits<float>::lowest();
    for (std::size_t t = 0; t < charts.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const float here = surface.positions[surface.triangles[t].position[c]].z;
            if (surface.triangles[t].part != BustPart::Skin || here <= z) continue;
            z = here;
            result = Foremost{.chart = charts[t], .uv = surface.triangles[t].uv[c]};
        }
    return result;
}

} // namespace

double chartArea(const AtlasChart& chart) {
    double area = 0;
    for (const auto& t : chart.triangles) {
        const glm::dvec2 a(t[1] - t[0]);
        const glm::dvec2 b(t[2] - t[0]);
        area += std::abs(a.x * b.y - a.y * b.x) / 2;
    }
    return area;
}

glm::vec2 Placement::operator()(const glm::vec2& p) const {
    return {glm::dvec2(p) * scale + offset};
}

std::vector<Placement> packCharts(const std::vector<AtlasChart>& charts, double gutter) {
    std::vector<std::size_t> order(charts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    double wanted = 0; // area at scale 1
    for (const AtlasChart& chart : charts)
        wanted += chart.density * chart.density * chart.surfaceMm2;
    std::ranges::stable_sort(order, std::greater{},
                             [&](std::size_t i) { return charts[i].density * charts[i].density * charts[i].surfaceMm2; });
    const double grow = gutter / 2 * static_cast<double>(kPackingCells);
    double possible = 0;
    double impossible = 1 / std::sqrt(wanted); // would fill the square without a gap
    std::vector<Placement> best;
    for (int i = 0; i < kBisections; ++i) {
        const double scale = (possible + impossible) / 2;
        if (std::optional<std::vector<Placement>> packed = tryScale(charts, order, scale, grow)) {
            best = std::move(*packed);
            possible = scale;
        } else {
            impossible = scale;
        }
    }
    return best;
}

glm::vec2 widenFace(const glm::vec2& p, const glm::vec2& centre, float halfWidth) {
    constexpr float kAcross = 0.4f;
    constexpr float kFar = 0.9f;
    constexpr float kNear = 0.7f;
    const float s = (p.x - centre.x) / halfWidth;
    const float sigma = 0.28f * halfWidth;
    const float dy = p.y - centre.y;
    const float bell = sigma * std::sqrt(std::numbers::pi_v<float> / 2) * std::erf(dy / (sigma * std::numbers::sqrt2_v<float>));
    return {centre.x + halfWidth * s * (1 + kAcross) / (1 + kAcross * s * s), centre.y + kFar * dy + kNear * bell};
}

std::vector<glm::vec2> unfoldCharts(const TriangleSurface& surface, const std::vector<std::uint32_t>& charts) {
    const std::vector<glm::dvec2> up = upDirections(surface, charts);
    std::vector<glm::vec2> plane = surface.uvs;
    std::vector<std::uint8_t> ofFace(plane.size(), 0);
    const std::optional<Foremost> nose = foremostPoint(surface, charts);
    for (std::size_t t = 0; t < charts.size(); ++t)
        for (const std::uint32_t uv : surface.triangles[t].uv) {
            plane[uv] = turnUpright(surface.uvs[uv], up[charts[t]]);
            ofFace[uv] = nose && charts[t] == nose->chart ? 1 : 0;
        }
    if (!nose) return plane;
    const glm::vec2 centre = plane[nose->uv];
    float halfWidth = 0;
    for (std::size_t uv = 0; uv < plane.size(); ++uv)
        if (ofFace[uv] != 0) halfWidth = std::max(halfWidth, std::abs(plane[uv].x - centre.x));
    for (std::size_t uv = 0; uv < plane.size(); ++uv)
        if (ofFace[uv] != 0) plane[uv] = widenFace(plane[uv], centre, halfWidth);
    return plane;
}

} // namespace tegument
