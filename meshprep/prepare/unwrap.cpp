#include "meshprep/prepare/unwrap.h"

#include "host/mesh/materials.h"
#include "host/mesh/triangles.h"
#include "host/support/parallel.h"
#include "meshprep/prepare/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tegument::prep {

namespace {

/// xatlas's time grows with the square of a chart's triangles, so what is connected is cut into pieces of no more.
constexpr std::size_t kMostTriangles = 4096;
/// Of more triangles than this, half as many each: texels are too few there for what a longer seam costs.
constexpr std::size_t kMany = 250'000;
constexpr double kMostOfAll = 1e-3; // what loadMesh warns of

/// Charts of a piece that lie flat: xatlas's, or where these do not, ones of bounded turn.
std::vector<Chart> chartsOf(const Triangles& triangles, const Faces& piece) {
    std::vector<Chart> charts;
    std::vector<bool> placed(piece.size(), false);
    std::vector<std::pair<std::uint32_t, std::size_t>> number(piece.size());
    for (std::size_t i = 0; i < piece.size(); ++i)
        number[i] = {piece[i], i};
    std::ranges::sort(number);
    for (Chart& chart : xatlasCharts(triangles, piece)) {
        if (!liesFlat(triangles, chart)) continue;
        for (const std::uint32_t face : chart.faces)
            placed[std::ranges::lower_bound(number, face, {}, &std::pair<std::uint32_t, std::size_t>::first)->second] = true;
        charts.push_back(std::move(chart));
    }
    Faces left;
    for (std::size_t i = 0; i < piece.size(); ++i)
        if (!placed[i]) left.push_back(piece[i]);
    if (!left.empty()) std::ranges::move(boundedCharts(triangles, left), std::back_inserter(charts));
    return charts;
}

/// Two halves of a chart, one beside the other along x or y.
std::array<Chart, 2> halvesAlong(const Chart& chart, glm::length_t axis) {
    std::vector<std::pair<double, std::size_t>> along;
    for (std::size_t i = 0; i < chart.faces.size(); ++i)
        along.emplace_back(chart.places[i][0][axis] + chart.places[i][1][axis] + chart.places[i][2][axis], i);
    std::ranges::sort(along);
    std::array<Chart, 2> halves;
    for (std::size_t k = 0; k < along.size(); ++k) {
        Chart& half = halves[2 * k < along.size() ? 0 : 1];
        half.faces.push_back(chart.faces[along[k].second]);
        half.places.push_back(chart.places[along[k].second]);
    }
    return halves;
}

/// A chart far longer than the square that all would fill leaves the square empty, and packing takes the time of its length.
std::vector<Chart> withoutLong(std::vector<Chart> charts) {
    constexpr double kMostLength = 4; // sides of that square
    double area = 0;
    for (const Chart& chart : charts)
        for (const auto& [p, q, r] : chart.places)
            area += std::abs((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)) / 2;
    std::vector<Chart> kept;
    std::ranges::reverse(charts);
    while (!charts.empty()) {
        Chart chart = std::move(charts.back());
        charts.pop_back();
        glm::dvec2 low(INFINITY), high(-INFINITY);
        for (const auto& places : chart.places)
            for (const glm::dvec2& place : places) {
                low = glm::min(low, place);
                high = glm::max(high, place);
            }
        const glm::dvec2 size = high - low;
        if (chart.faces.size() == 1 || !(std::max(size.x, size.y) > kMostLength * std::sqrt(area))) {
            kept.push_back(std::move(chart));
            continue;
        }
        auto [first, second] = halvesAlong(chart, size.x >= size.y ? 0 : 1);
        charts.push_back(std::move(second));
        charts.push_back(std::move(first));
    }
    return kept;
}

std::vector<Chart> allCharts(const Triangles& triangles) {
    const std::vector<Faces> pieces = cutIntoPieces(triangles, triangles.count() > kMany ? kMostTriangles / 2 : kMostTriangles);
    std::vector<std::vector<Chart>> found(pieces.size());
    forEachInParallel(pieces.size(), [&](std::size_t i) { found[i] = chartsOf(triangles, pieces[i]); });
    std::vector<Chart> charts;
    for (std::vector<Chart>& some : found)
        std::ranges::move(some, std::back_inserter(charts));
    return withoutLong(std::move(charts));
}

/// Vertices anew: one for each pair of a vertex of the mesh and a chart. Triangles without an area lie in one point.
std::size_t takeCoordinates(Surface& surface, const std::vector<Chart>& charts, const Packing& packing) {
    Mesh& mesh = surface.mesh;
    struct Corner {
        std::uint32_t chart = UINT32_MAX;
        glm::vec2 uv{0};
    };
    std::vector<Corner> corners(mesh.indices.size());
    for (std::uint32_t c = 0; c < charts.size(); ++c)
        for (std::size_t i = 0; i < charts[c].faces.size(); ++i)
            for (std::size_t corner = 0; corner < 3; ++corner)
                corners[3 * charts[c].faces[i] + corner] = {.chart = c, .uv = glm::vec2(packing.places[c][i][corner])};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
    std::vector<std::uint32_t> from;
    std::vector<glm::vec2> uvs;
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const auto [entry, isNew] =
            known.try_emplace({mesh.indices[corner], corners[corner].chart}, static_cast<std::uint32_t>(from.size()));
        if (isNew) {
            from.push_back(mesh.indices[corner]);
            uvs.push_back(corners[corner].uv);
        }
        mesh.indices[corner] = entry->second;
    }
    const std::size_t before = mesh.positions.size();
    mesh.uvs.clear();
    mesh.tangents.clear();
    gatherVertices(mesh, from);
    mesh.uvs = std::move(uvs);
    std::vector<std::uint32_t> point;
    for (const std::uint32_t vertex : from)
        point.push_back(surface.point[vertex]);
    surface.point = std::move(point);
    return from.size() - std::min(before, from.size());
}

Error cannotUnwrap(std::string why) {
    return inputError(7028, {}, "the mesh cannot be unwrapped: " + std::move(why), "its triangles may have no area: see tegument prep");
}

} // namespace

Result<Unwrapping> unwrap(Surface& surface) {
    surface.mesh.textures.clear();
    dropTextures(surface.mesh.materials);
    const std::vector<Chart> charts = allCharts(Triangles(surface));
    if (charts.empty()) return cannotUnwrap("no chart could be made of it");
    const Packing packing = pack(charts);
    if (packing.places.size() != charts.size()) return cannotUnwrap("its charts could not be packed");
    Unwrapping result{.charts = charts.size()};
    result.split = takeCoordinates(surface, charts, packing);
    const UvReport report = examineUvs(surface.mesh);
    if (report.overlapping + report.outside > kMostOfAll)
        return cannotUnwrap(fmt::format("{:.1f} % of its charts would overlap", 100 * (report.overlapping + report.outside)));
    result.covered = report.covered;
    return result;
}

} // namespace tegument::prep
