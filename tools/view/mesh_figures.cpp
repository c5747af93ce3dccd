#include "tools/view/mesh_figures.h"

#include "host/support/disjoint_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace tegument::view {

namespace {

using MeshColor = std::array<float, 3>;
constexpr double kInOneHundred = 0.01;
constexpr double kDoublings = 2; // of the colours, from the middle to either end
constexpr MeshColor kNoArea = {1, 0, 1};
constexpr MeshColor kSurface = {0.72F, 0.72F, 0.72F};
constexpr MeshColor kSeam = {1, 0.45F, 0.05F};
constexpr MeshColor kBorder = {0.1F, 0.8F, 1};
// Light in the middle, dark at the ends: the signs can be told apart without red and green.
constexpr std::array<MeshColor, 5> kScaleColors = {MeshColor{0.13F, 0.25F, 0.7F}, MeshColor{0.45F, 0.68F, 0.92F},
                                                   MeshColor{0.95F, 0.95F, 0.9F}, MeshColor{0.96F, 0.65F, 0.3F},
                                                   MeshColor{0.65F, 0.08F, 0.1F}};
constexpr std::array<MeshColor, 3> kStretchColors = {MeshColor{0.95F, 0.95F, 0.9F}, MeshColor{0.96F, 0.65F, 0.3F},
                                                     MeshColor{0.65F, 0.08F, 0.1F}};

template <std::size_t N>
MeshColor between(const std::array<MeshColor, N>& colors, double share) {
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(N - 1);
    const auto below = std::min(static_cast<std::size_t>(place), N - 2);
    MeshColor color{};
    for (std::size_t c = 0; c < color.size(); ++c)
        color.at(c) = std::lerp(colors.at(below).at(c), colors.at(below + 1).at(c), static_cast<float>(place - static_cast<double>(below)));
    return color;
}

/// Singular values of the map from the triangle's plane to the texture.
void examineMapping(MeshTriangle& triangle, const Mesh& mesh, MeshFigures& figures) {
    const auto [a, b, c] = triangle.corners;
    const glm::dvec3 across = glm::dvec3(mesh.positions[b]) - glm::dvec3(mesh.positions[a]);
    const glm::dvec3 along = glm::dvec3(mesh.positions[c]) - glm::dvec3(mesh.positions[a]);
    triangle.area = 0.5 * glm::length(glm::cross(across, along));
    triangle.stretch = std::numeric_limits<double>::infinity();
    if (mesh.uvs.empty() || triangle.area == 0) return;
    const glm::dvec2 u = glm::dvec2(mesh.uvs[b]) - glm::dvec2(mesh.uvs[a]);
    const glm::dvec2 v = glm::dvec2(mesh.uvs[c]) - glm::dvec2(mesh.uvs[a]);
    const double twice = u.x * v.y - u.y * v.x;
    if (twice > 0) ++figures.mirrored; // v runs down the texture
    triangle.scale = std::sqrt(0.5 * std::abs(twice) / triangle.area);
    if (twice == 0) return;
    const double length = glm::length(across);
    const double foot = glm::dot(along, across) / length;
    const double height = 2 * triangle.area / length;
    const glm::dvec2 x = u / length;              // what one mm along the first edge becomes
    const glm::dvec2 y = (v - foot * x) / height; // and one mm across it
    const double sum = 0.5 * (glm::dot(x, x) + glm::dot(y, y));
    const double root = std::sqrt(std::max(0.0, sum * sum - std::pow(x.x * y.y - x.y * y.x, 2)));
    triangle.stretch = std::sqrt((sum + root) / std::max(sum - root, std::numeric_limits<double>::min()));
}

/// Vertices of one place have one number.
std::vector<std::uint32_t> placesOf(const Mesh& mesh) {
    std::map<std::tuple<float, float, float>, std::uint32_t> known;
    std::vector<std::uint32_t> places;
    for (const glm::vec3& p : mesh.positions)
        places.push_back(known.emplace(std::tuple(p.x, p.y, p.z), static_cast<std::uint32_t>(known.size())).first->second);
    return places;
}

struct MeshEdge {
    std::array<glm::vec2, 2> uvs{};
    std::vector<std::pair<std::size_t, std::size_t>> sides; // triangle, corner
    bool parts = false;
};

void examineEdges(const Mesh& mesh, const std::vector<std::uint32_t>& places, MeshFigures& figures) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, MeshEdge> edges;
    for (std::size_t t = 0; t < figures.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t from = figures.triangles[t].corners.at(k);
            std::uint32_t to = figures.triangles[t].corners.at((k + 1) % 3);
            if (places[from] > places[to]) std::swap(from, to);
            MeshEdge& edge = edges[{places[from], places[to]}];
            const std::array<glm::vec2, 2> uvs = mesh.uvs.empty() ? edge.uvs : std::array{mesh.uvs[from], mesh.uvs[to]};
            edge.parts |= !edge.sides.empty() && uvs != edge.uvs;
            edge.uvs = uvs;
            edge.sides.emplace_back(t, k);
        }
    for (const auto& [ends, edge] : edges) {
        const auto [t, k] = edge.sides.front();
        const auto& corners = figures.triangles[t].corners;
        const double length = glm::length(glm::dvec3(mesh.positions[corners.at((k + 1) % 3)]) - glm::dvec3(mesh.positions[corners.at(k)]));
        if (edge.sides.size() == 1) figures.borderLength += length;
        if (edge.parts) figures.seamLength += length;
        for (const auto& [triangle, corner] : edge.sides) {
            figures.triangles[triangle].border.at(corner) = edge.sides.size() == 1;
            figures.triangles[triangle].seam.at(corner) = edge.parts;
        }
    }
}

bool isMapped(const MeshTriangle& triangle) {
    return triangle.scale > 0;
}

bool isFurry(const MeshTriangle& triangle) {
    return triangle.fur > 0;
}

template <class Value, class Counts>
Spread spreadOf(const std::vector<MeshTriangle>& triangles, const Value& value, const Counts& counts) {
    std::vector<std::pair<double, double>> values; // with areas
    double total = 0;
    for (const MeshTriangle& triangle : triangles)
        if (counts(triangle)) {
            values.emplace_back(value(triangle), triangle.area);
            total += triangle.area;
        }
    std::ranges::sort(values);
    const auto at = [&](double share) {
        double below = 0;
        for (const auto& [number, area] : values)
            if ((below += area) >= share * total) return number;
        return values.empty() ? 0.0 : values.back().first;
    };
    return {.low = at(kInOneHundred), .median = at(0.5), .high = at(1 - kInOneHundred)};
}

struct RootsAbout {
    double roots = 0;
    double area = 0; // mm^2
};

constexpr double kRootsEnough = 30;      // a density of so many is known to a fifth
constexpr double kTrianglesOfARound = 6; // that one round more takes in, at least
constexpr std::size_t kMostRounds = 40;
constexpr double kBald = 0.02; // of the greatest density: what is less has come from over the edge of the fur

/// Each triangle gives a third of what it has to each corner, and gets back the mean of what its corners hold: nothing is lost, and where
/// the density is the same everywhere it stays so.
void spreadRoots(std::vector<RootsAbout>& about, const MeshFigures& figures, const std::vector<std::uint32_t>& places) {
    if (figures.roots == 0) return;
    const double wanted = kRootsEnough * static_cast<double>(about.size()) / static_cast<double>(figures.roots); // triangles
    const std::size_t rounds = wanted <= 1 ? 0 : std::min(kMostRounds, static_cast<std::size_t>(std::ceil(wanted / kTrianglesOfARound)));
    std::vector<double> meeting(places.size(), 0); // triangles at a corner
    for (const MeshTriangle& triangle : figures.triangles)
        for (const std::uint32_t corner : triangle.corners)
            meeting[places[corner]] += 1;
    for (std::size_t round = 0; round < rounds; ++round) {
        std::vector<RootsAbout> corners(places.size());
        for (std::size_t i = 0; i < about.size(); ++i)
            for (const std::uint32_t corner : figures.triangles[i].corners) {
                corners[places[corner]].roots += about[i].roots / 3;
                corners[places[corner]].area += about[i].area / 3;
            }
        for (std::size_t i = 0; i < about.size(); ++i) {
            about[i] = {};
            for (const std::uint32_t corner : figures.triangles[i].corners) {
                about[i].roots += corners[places[corner]].roots / meeting[places[corner]];
                about[i].area += corners[places[corner]].area / meeting[places[corner]];
            }
        }
    }
}

std::vector<MeshTriangle> trianglesOf(const Mesh& mesh) {
    std::vector<MeshTriangle> triangles;
    for (const MeshPart& part : mesh.parts) {
        if (part.expanded) continue;
        for (std::size_t i = part.firstIndex; i + 2 < std::size_t{part.firstIndex} + part.indexCount; i += 3)
            triangles.push_back(
                {.corners = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]}, .number = static_cast<std::uint32_t>(i / 3)});
    }
    return triangles;
}

} // namespace

MeshFigures examineMesh(const Mesh& mesh) {
    MeshFigures figures{.triangles = trianglesOf(mesh)};
    const std::vector<std::uint32_t> places = placesOf(mesh);
    DisjointSets sets(places.size());
    std::set<std::uint32_t> used;
    for (MeshTriangle& triangle : figures.triangles) {
        examineMapping(triangle, mesh, figures);
        figures.flat += triangle.scale == 0 ? 1 : 0;
        for (std::size_t k = 0; k < 3; ++k) {
            used.insert(triangle.corners.at(k));
            sets.join(places[triangle.corners.at(k)], places[triangle.corners[0]]);
        }
    }
    std::set<std::uint32_t> roots;
    for (const std::uint32_t vertex : used)
        roots.insert(sets.find(places[vertex]));
    figures.vertices = used.size();
    figures.components = roots.size();
    examineEdges(mesh, places, figures);
    figures.scale = spreadOf(
        figures.triangles, [](const MeshTriangle& t) { return t.scale; }, isMapped);
    figures.stretch = spreadOf(
        figures.triangles, [](const MeshTriangle& t) { return t.stretch; }, isMapped);
    return figures;
}

namespace {

std::vector<LegendEntry> withFlat(std::vector<LegendEntry> legend, const MeshFigures& figures) {
    if (figures.flat > 0) legend.push_back({kNoArea, "no area on the texture"});
    return legend;
}

} // namespace

void countRoots(MeshFigures& figures, const Mesh& mesh, std::span<const std::uint32_t> onto) {
    std::map<std::uint32_t, std::size_t> at;
    for (std::size_t i = 0; i < figures.triangles.size(); ++i)
        at[figures.triangles[i].number] = i;
    std::vector<RootsAbout> about;
    for (const MeshTriangle& triangle : figures.triangles)
        about.push_back({.roots = 0, .area = triangle.area});
    figures.roots = figures.triangles.empty() ? 0 : onto.size();
    for (const std::uint32_t triangle : onto)
        if (const auto found = at.find(triangle); found != at.end()) about[found->second].roots += 1;
    spreadRoots(about, figures, placesOf(mesh));
    double most = 0;
    for (std::size_t i = 0; i < about.size(); ++i) {
        figures.triangles[i].fur = about[i].area > 0 ? about[i].roots / about[i].area : 0;
        most = std::max(most, figures.triangles[i].fur);
    }
    figures.furryArea = 0;
    for (MeshTriangle& triangle : figures.triangles) {
        if (triangle.fur < kBald * most) triangle.fur = 0;
        if (isFurry(triangle)) figures.furryArea += triangle.area;
    }
    figures.fur = spreadOf(
        figures.triangles, [](const MeshTriangle& t) { return t.fur; }, isFurry);
}

std::array<float, 3> colorOf(MeshShow show, const MeshTriangle& triangle, const MeshFigures& figures) {
    if (show == MeshShow::Seams) return kSurface;
    if (show == MeshShow::Fur)
        return isFurry(triangle) ? between(kScaleColors, 0.5 + 0.5 * std::log2(triangle.fur / figures.fur.median) / kDoublings) : kSurface;
    if (triangle.scale == 0) return kNoArea;
    if (show == MeshShow::Texels) return between(kScaleColors, 0.5 + 0.5 * std::log2(triangle.scale / figures.scale.median) / kDoublings);
    return between(kStretchColors, std::log2(triangle.stretch) / kDoublings);
}

std::vector<LegendEntry> legendOf(MeshShow show, const MeshFigures& figures, double texels) {
    if (show == MeshShow::Seams) return {{kSeam, "seam: the texture goes on elsewhere"}, {kBorder, "border: no triangle beyond"}};
    std::vector<LegendEntry> legend;
    if (show == MeshShow::Stretch) {
        for (std::size_t i = 0; i < kStretchColors.size(); ++i)
            legend.push_back({kStretchColors.at(i), fmt::format("{} to 1{}", 1U << i, i + 1 == kStretchColors.size() ? " and more" : "")});
        return withFlat(std::move(legend), figures);
    }
    const bool fur = show == MeshShow::Fur;
    for (std::size_t i = 0; i < kScaleColors.size(); ++i) {
        const double times = std::exp2(static_cast<double>(i) - kDoublings) * (fur ? figures.fur.median : texels * figures.scale.median);
        const char* end = i == 0 ? " and less" : i + 1 == kScaleColors.size() ? " and more" : i == 2 ? ", the median" : "";
        legend.push_back({kScaleColors.at(i), fmt::format("{:.3g} {}{}", times, fur ? "roots per mm2" : "texels per mm", end)});
    }
    if (fur) {
        legend.push_back({kSurface, "no roots"});
        return legend;
    }
    return withFlat(std::move(legend), figures);
}

std::vector<std::string> linesOf(MeshShow show, const MeshFigures& figures, double texels) {
    const std::string title = show == MeshShow::Texels    ? fmt::format("texels per mm, maps of {:.0f}", texels)
                              : show == MeshShow::Stretch ? "stretch on the texture"
                              : show == MeshShow::Fur     ? "density of fur"
                                                          : "seams and borders";
    const Spread& s = figures.scale;
    if (show == MeshShow::Fur)
        return {title,
                fmt::format("{} roots on {:.0f} mm2 with fur, {:.3g} per mm2", figures.roots, figures.furryArea,
                            figures.furryArea > 0 ? static_cast<double>(figures.roots) / figures.furryArea : 0),
                fmt::format("98 % of it has {:.3g} to {:.3g} per mm2", figures.fur.low, figures.fur.high)};
    return {title,
            fmt::format("{} vertices, {} triangles, {} component{}", figures.vertices, figures.triangles.size(), figures.components,
                        figures.components == 1 ? "" : "s"),
            fmt::format("seams {:.0f} mm, borders {:.0f} mm", figures.seamLength, figures.borderLength),
            fmt::format("flat on the texture {}, mirrored {}", figures.flat, figures.mirrored),
            fmt::format("texels per mm {:.3g}, 98 % in {:.3g} to {:.3g}", texels * s.median, texels * s.low, texels * s.high),
            fmt::format("stretch {:.3g}, 99 % below {:.3g}", figures.stretch.median, figures.stretch.high)};
}

} // namespace tegument::view
