#include "meshprep/prepare/charts.h"

#include "host/support/parallel.h"
#include "meshprep/prepare/edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace tegument::prep {

namespace {

/// Share of a chart's area that may overlap, be turned over, or be drawn too small.
constexpr double kMostOverlap = 5e-4;
constexpr double kMostTurned = 1e-4;
constexpr double kMostTiny = 0.02;
constexpr double kTiny = 1.0 / 8; // of the usual length in the plane
/// Normals of a bounded chart turn by at most this much from its first triangle's: lengths shrink to .7 at most where it is seen.
constexpr double kMostTurn = std::numbers::pi / 4;
/// What is left between bounded charts joins one where it is seen from the side of its surface at all.
constexpr double kLeastSeen = 0.2;
constexpr std::size_t kFragment = 16;

std::vector<std::uint32_t> partOfTriangle(const Mesh& mesh) {
    std::vector<std::uint32_t> part(mesh.indices.size() / 3, 0);
    for (std::uint32_t i = 0; i < mesh.parts.size(); ++i)
        std::fill_n(part.begin() + mesh.parts[i].firstIndex / 3, mesh.parts[i].indexCount / 3, i);
    return part;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

double doubled(const std::array<glm::dvec2, 3>& p) {
    return cross(p[1] - p[0], p[2] - p[0]);
}

/// Walks over neighbours within a set of triangles.
class Walk {
public:
    Walk(const Triangles& triangles, const Faces& faces) : triangles_(triangles) {
        for (const std::uint32_t face : faces)
            left_.emplace(face, false);
    }

    /// All that is connected with `first` and not taken yet, nearest first.
    Faces from(std::uint32_t first) {
        Faces found = {first};
        left_[first] = true;
        for (std::size_t i = 0; i < found.size(); ++i)
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const auto next = left_.find(triangles_.beyond(found[i], corner));
                if (next == left_.end() || next->second) continue;
                next->second = true;
                found.push_back(next->first);
            }
        return found;
    }
    [[nodiscard]] bool taken(std::uint32_t face) const { return left_.at(face); }

private:
    const Triangles& triangles_;
    std::unordered_map<std::uint32_t, bool> left_;
};

std::vector<Faces> connected(const Triangles& triangles, const Faces& faces) {
    Walk walk(triangles, faces);
    std::vector<Faces> found;
    for (const std::uint32_t face : faces)
        if (!walk.taken(face)) found.push_back(walk.from(face));
    return found;
}

/// Connected triangles in two halves, each the nearer to one of two ends; and their connected parts.
std::vector<Faces> halved(const Triangles& triangles, const Faces& faces) {
    const std::uint32_t end = Walk(triangles, faces).from(faces.front()).back();
    const Faces ordered = Walk(triangles, faces).from(end);
    const auto middle = ordered.begin() + static_cast<std::ptrdiff_t>(ordered.size() / 2);
    std::vector<Faces> halves = connected(triangles, {ordered.begin(), middle});
    for (Faces& part : connected(triangles, {middle, ordered.end()}))
        halves.push_back(std::move(part));
    return halves;
}

} // namespace

Triangles::Triangles(const Surface& surface)
    : surface_(&surface), normals_(surface.triangles()), areas_(surface.triangles()), beyond_(surface.mesh.indices.size(), kNone) {
    inChunks(areas_.size(), 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            const auto face = static_cast<std::uint32_t>(i);
            const glm::dvec3 twice = glm::cross(place(face, 1) - place(face, 0), place(face, 2) - place(face, 0));
            const double length = glm::length(twice);
            areas_[i] = length / 2;
            if (length > 0) normals_[i] = twice / length;
        }
    });
    const std::vector<std::uint32_t> part = partOfTriangle(surface.mesh);
    EdgeTable(surface).forEach([&](std::span<const HalfEdge> edge) {
        if (edge.size() != 2 || edge[0].forwards == edge[1].forwards) return;
        if (part[edge[0].triangle()] != part[edge[1].triangle()]) return;
        beyond_[edge[0].corner] = edge[1].triangle();
        beyond_[edge[1].corner] = edge[0].triangle();
    });
}

std::vector<Faces> cutIntoPieces(const Triangles& triangles, std::size_t most) {
    Faces all;
    for (std::uint32_t face = 0; face < triangles.count(); ++face)
        if (triangles.area(face) > 0) all.push_back(face);
    std::vector<Faces> pieces;
    std::vector<Faces> large = connected(triangles, all);
    while (!large.empty()) {
        std::vector<std::vector<Faces>> halves(large.size());
        forEachInParallel(large.size(), [&](std::size_t i) {
            if (large[i].size() > most) halves[i] = halved(triangles, large[i]);
        });
        std::vector<Faces> next;
        for (std::size_t i = 0; i < large.size(); ++i) {
            if (large[i].size() <= most) pieces.push_back(std::move(large[i]));
            std::ranges::move(halves[i], std::back_inserter(next));
        }
        large = std::move(next);
    }
    return pieces;
}

namespace {

/// Where triangles lie by sign and size: TRUE where nothing is turned over or lost.
bool keepsSides(const Triangles& triangles, const Chart& chart) {
    double area = 0, turned = 0, tiny = 0, kept = 0;
    for (std::size_t i = 0; i < chart.faces.size(); ++i) {
        const double flat = doubled(chart.places[i]) / 2;
        const double own = triangles.area(chart.faces[i]);
        if (!std::isfinite(flat)) return false;
        area += own;
        kept += std::abs(flat);
        if (flat < 0) turned += own;
        if (!(std::abs(flat) > kTiny * kTiny * own)) tiny += own;
    }
    return kept > 0 && std::min(turned, area - turned) <= kMostTurned * area && tiny <= kMostTiny * area;
}

/// The chart as a mesh in the unit square, for the examination that users see.
double overlapOf(const Chart& chart) {
    Mesh mesh;
    glm::dvec2 low(INFINITY), high(-INFINITY);
    for (const auto& places : chart.places)
        for (const glm::dvec2& place : places) {
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
    for (const auto& places : chart.places)
        for (const glm::dvec2& place : places) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.uvs.size()));
            mesh.uvs.emplace_back((place - low) / glm::max(high - low, glm::dvec2(1e-30)));
        }
    constexpr double kTexelsEach = 8; // along a triangle
    const auto side = static_cast<int>(kTexelsEach * std::sqrt(static_cast<double>(chart.faces.size())));
    return examineUvs(mesh, std::clamp(side, 64, 1024)).overlapping;
}

} // namespace

void scaleToSurface(const Triangles& triangles, Chart& chart) {
    constexpr double kMostStretch = 3; // of lengths: the area of needles in the plane is rounding, which may be next to nothing
    double area = 0, flat = 0, length = 0, flatLength = 0;
    for (std::size_t i = 0; i < chart.faces.size(); ++i) {
        area += triangles.area(chart.faces[i]);
        flat += std::abs(doubled(chart.places[i])) / 2;
        for (const std::size_t corner : {0U, 1U, 2U}) {
            const std::size_t next = (corner + 1) % 3;
            length += glm::distance(triangles.place(chart.faces[i], corner), triangles.place(chart.faces[i], next));
            flatLength += glm::distance(chart.places[i][corner], chart.places[i][next]);
        }
    }
    const double scale = std::min(std::sqrt(area / flat), kMostStretch * length / flatLength);
    for (auto& places : chart.places)
        for (glm::dvec2& place : places)
            place *= scale;
}

bool liesFlat(const Triangles& triangles, const Chart& chart) {
    return keepsSides(triangles, chart) && (chart.faces.size() == 1 || overlapOf(chart) <= kMostOverlap);
}

namespace {

glm::dvec3 meanNormal(const Triangles& triangles, const Faces& faces) {
    glm::dvec3 sum(0);
    for (const std::uint32_t face : faces)
        sum += triangles.area(face) * triangles.normal(face);
    return sum;
}

/// As seen from the side that most of it faces.
Chart seen(const Triangles& triangles, Faces faces) {
    glm::dvec3 towards = meanNormal(triangles, faces);
    if (!(glm::length(towards) > 0)) towards = triangles.normal(faces.front());
    towards = glm::normalize(towards);
    const glm::dvec3 side = std::abs(towards.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(side, towards));
    const glm::dvec3 v = glm::cross(towards, u);
    Chart chart{.faces = std::move(faces), .places = {}};
    const glm::dvec3 origin = triangles.place(chart.faces.front(), 0);
    for (const std::uint32_t face : chart.faces) {
        std::array<glm::dvec2, 3>& places = chart.places.emplace_back();
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 at = triangles.place(face, corner) - origin;
            places[corner] = {glm::dot(at, u), glm::dot(at, v)};
        }
    }
    scaleToSurface(triangles, chart);
    return chart;
}

/// Triangles round `first` whose normals turn by no more than the bound.
class Grower {
public:
    Grower(const Triangles& triangles, const Faces& piece) : triangles_(triangles) {
        for (const std::uint32_t face : piece)
            owner_.emplace(face, Triangles::kNone);
    }

    std::vector<Faces> regions(const Faces& piece) {
        std::vector<Faces> regions;
        for (const std::uint32_t face : piece)
            if (owner_.at(face) == Triangles::kNone) regions.push_back(grown(face, static_cast<std::uint32_t>(regions.size())));
        joinFragments(regions);
        std::erase_if(regions, [](const Faces& faces) { return faces.empty(); });
        return regions;
    }

private:
    Faces grown(std::uint32_t first, std::uint32_t region) {
        static const double least = std::cos(kMostTurn);
        Faces found = {first};
        owner_.at(first) = region;
        for (std::size_t i = 0; i < found.size(); ++i)
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const auto next = owner_.find(triangles_.beyond(found[i], corner));
                if (next == owner_.end() || next->second != Triangles::kNone) continue;
                if (glm::dot(triangles_.normal(next->first), triangles_.normal(first)) < least) continue;
                next->second = region;
                found.push_back(next->first);
            }
        return found;
    }

    /// A few triangles between larger regions go to one that sees them.
    void joinFragments(std::vector<Faces>& regions) {
        std::vector<glm::dvec3> towards;
        for (const Faces& faces : regions) {
            const glm::dvec3 mean = meanNormal(triangles_, faces);
            towards.push_back(glm::length(mean) > 0 ? glm::normalize(mean) : mean);
        }
        for (std::uint32_t i = 0; i < regions.size(); ++i) {
            if (regions[i].size() > kFragment) continue;
            Faces left;
            for (const std::uint32_t face : regions[i]) {
                const std::uint32_t to = joins(face, i, regions, towards);
                if (to == Triangles::kNone) {
                    left.push_back(face);
                    continue;
                }
                regions[to].push_back(face);
                owner_.at(face) = to;
            }
            regions[i] = std::move(left);
        }
    }

    [[nodiscard]] std::uint32_t joins(std::uint32_t face, std::uint32_t own, const std::vector<Faces>& regions,
                                      const std::vector<glm::dvec3>& towards) const {
        std::uint32_t best = Triangles::kNone;
        double most = kLeastSeen;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto next = owner_.find(triangles_.beyond(face, corner));
            if (next == owner_.end() || next->second == own || regions[next->second].size() <= kFragment) continue;
            const double seen = glm::dot(triangles_.normal(face), towards[next->second]);
            if (seen <= most) continue;
            most = seen;
            best = next->second;
        }
        return best;
    }

    const Triangles& triangles_;
    std::unordered_map<std::uint32_t, std::uint32_t> owner_;
};

} // namespace

std::vector<Chart> boundedCharts(const Triangles& triangles, const Faces& piece) {
    std::vector<Chart> charts;
    std::vector<Faces> open;
    for (const Faces& region : Grower(triangles, piece).regions(piece))
        for (Faces& faces : connected(triangles, region))
            open.push_back(std::move(faces));
    while (!open.empty()) {
        Faces faces = std::move(open.back());
        open.pop_back();
        Chart chart = seen(triangles, faces);
        if (faces.size() == 1 || liesFlat(triangles, chart)) {
            charts.push_back(std::move(chart));
            continue;
        }
        for (Faces& half : halved(triangles, faces))
            open.push_back(std::move(half));
    }
    return charts;
}

} // namespace tegument::prep
