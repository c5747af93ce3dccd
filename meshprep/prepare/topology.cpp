#include "meshprep/prepare/topology.h"

#include "host/mesh/facing.h"
#include "host/mesh/normals.h"
#include "host/mesh/triangles.h"
#include "host/support/parallel.h"
#include "meshprep/prepare/clean.h"
#include "meshprep/prepare/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace tegument::prep {

namespace {

/// Triangles joined across edges, all of whose edges have two triangles.
struct Shell {
    std::vector<std::uint32_t> triangles;
    double volume = 0;     // mm^3; below 0 where it faces inwards
    std::size_t depth = 0; // how many other shells it lies in

    /// A shell in a shell is the wall of a hollow, and faces the hollow; one in that is a body again.
    [[nodiscard]] bool insideOut() const { return depth % 2 == 0 ? volume < 0 : volume > 0; }
};

constexpr std::size_t kMostNested = 20'000; // pairs of them are looked at
/// Of the volume that a ball of the same area has: less is a sheet with two sides.
constexpr double kLeastVolume = 1e-6;

/// Coordinates of no axis of the mesh, so that a ray along the last one seldom meets an edge.
glm::dvec3 askew(const glm::dvec3& p) {
    const glm::dvec3 w = glm::normalize(glm::dvec3(0.2718, 0.1414, 0.9513));
    const glm::dvec3 u = glm::normalize(glm::cross(w, glm::dvec3(0.5772, 0.8165, 0)));
    return {glm::dot(u, p), glm::dot(glm::cross(w, u), p), glm::dot(w, p)};
}

struct Extent {
    glm::dvec3 low{INFINITY};
    glm::dvec3 high{-INFINITY};

    [[nodiscard]] bool holds(const Extent& other) const {
        return glm::all(glm::lessThanEqual(low, other.low)) && glm::all(glm::greaterThanEqual(high, other.high));
    }
};

struct Probe {
    glm::dvec3 at{0};
    std::size_t shell = 0;
    bool inside = false;
};

/// Which shells lie in `outer`: an odd number of its triangles is above a point of theirs.
void count(const Mesh& mesh, const Shell& outer, std::vector<Probe>& probes) {
    std::ranges::sort(probes, {}, [](const Probe& probe) { return probe.at.x; });
    for (const std::uint32_t triangle : outer.triangles) {
        std::array<glm::dvec3, 3> p = cornersOf(mesh, triangle);
        std::ranges::transform(p, p.begin(), askew);
        const auto [low, high] = std::minmax({p[0].x, p[1].x, p[2].x});
        const double twice = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
        if (twice == 0) continue;
        for (auto probe = std::ranges::lower_bound(probes, low, {}, [](const Probe& one) { return one.at.x; });
             probe != probes.end() && probe->at.x <= high; ++probe) {
            const glm::dvec3 way = probe->at - p[0];
            const double b = (way.x * (p[2].y - p[0].y) - (p[2].x - p[0].x) * way.y) / twice;
            const double c = ((p[1].x - p[0].x) * way.y - way.x * (p[1].y - p[0].y)) / twice;
            if (b < 0 || c < 0 || b + c >= 1) continue;
            if (p[0].z + b * (p[1].z - p[0].z) + c * (p[2].z - p[0].z) > probe->at.z) probe->inside = !probe->inside;
        }
    }
}

/// The closed ones of these components that hold a volume, each of triangles that face the same way. Of more than 20,000, none counts as
/// lying in another.
std::vector<Shell> shellsOf(const Surface& surface, std::vector<std::vector<std::uint32_t>> closed) {
    const Mesh& mesh = surface.mesh;
    std::vector<Shell> shells;
    std::vector<Extent> extents;
    for (std::vector<std::uint32_t>& triangles : closed) {
        Shell shell{.triangles = std::move(triangles)};
        Extent extent;
        const glm::dvec3 origin = cornersOf(mesh, shell.triangles.front())[0];
        double area = 0;
        for (const std::uint32_t triangle : shell.triangles) {
            const std::array<glm::dvec3, 3> p = cornersOf(mesh, triangle);
            const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
            shell.volume += glm::dot(p[0] - origin, normal) / 6;
            area += glm::length(normal) / 2;
            for (const glm::dvec3& corner : p) {
                extent.low = glm::min(extent.low, corner);
                extent.high = glm::max(extent.high, corner);
            }
        }
        if (!(std::abs(shell.volume) > kLeastVolume * area * std::sqrt(area))) continue;
        shells.push_back(std::move(shell));
        extents.push_back(extent);
    }
    if (shells.size() > kMostNested) return shells;
    std::vector<std::vector<Probe>> probes(shells.size());
    forEachInParallel(shells.size(), [&](std::size_t outer) {
        for (std::size_t i = 0; i < shells.size(); ++i) {
            if (i == outer || !extents[outer].holds(extents[i])) continue;
            const std::array<glm::dvec3, 3> p = cornersOf(mesh, shells[i].triangles.front());
            probes[outer].push_back({.at = askew((p[0] + p[1] + p[2]) / 3.0), .shell = i});
        }
        count(mesh, shells[outer], probes[outer]);
    });
    for (const std::vector<Probe>& of : probes)
        for (const Probe& probe : of)
            shells[probe.shell].depth += probe.inside;
    return shells;
}

constexpr std::uint32_t kNone = UINT32_MAX;

std::size_t countBowTies(const Surface& surface, DisjointSets& fans) {
    std::vector<std::uint32_t> fanAt(surface.pointCount, kNone);
    std::vector<bool> several(surface.pointCount, false);
    for (std::uint32_t corner = 0; corner < surface.mesh.indices.size(); ++corner) {
        const std::uint32_t point = surface.pointAt(corner);
        const std::uint32_t fan = fans.find(corner);
        if (fanAt[point] == kNone) fanAt[point] = fan;
        several[point] = several[point] || fanAt[point] != fan;
    }
    return static_cast<std::size_t>(std::ranges::count(several, true));
}

std::size_t countComponents(const Surface& surface) {
    DisjointSets sets(surface.pointCount);
    for (std::size_t i = 0; i < surface.mesh.indices.size(); i += 3)
        for (const std::size_t next : {1u, 2u})
            sets.join(surface.pointAt(i), surface.pointAt(i + next));
    std::vector<bool> root(surface.pointCount, false);
    for (std::size_t corner = 0; corner < surface.mesh.indices.size(); ++corner)
        root[sets.find(surface.pointAt(corner))] = true;
    return static_cast<std::size_t>(std::ranges::count(root, true));
}

std::size_t countFlat(const Surface& surface) {
    std::size_t flat = 0;
    for (std::size_t triangle = 0; triangle < surface.triangles(); ++triangle)
        flat += faceNormal(cornersOf(surface.mesh, triangle)) == glm::dvec3(0);
    return flat;
}

void countEdges(const EdgeTable& edges, Topology& topology) {
    edges.forEach([&](std::span<const HalfEdge> sides) {
        topology.boundaryEdges += sides.size() == 1;
        topology.crowdedEdges += sides.size() > 2;
        topology.opposedEdges += sides.size() == 2 && sides[0].forwards == sides[1].forwards;
    });
}

/// Sides of triangles across edges of exactly two triangles.
struct Neighbours {
    std::vector<std::uint32_t> across; // by corner: the triangle behind the side that starts there, or none
    std::vector<bool> opposed;         // by corner: it is seen from the other side

    explicit Neighbours(const Surface& surface) : across(surface.mesh.indices.size(), kNone), opposed(surface.mesh.indices.size(), false) {
        EdgeTable(surface).forEach([&](std::span<const HalfEdge> sides) {
            if (sides.size() != 2) return;
            for (const std::size_t i : {0u, 1u}) {
                across[sides[i].corner] = sides[1 - i].triangle();
                opposed[sides[i].corner] = sides[0].forwards == sides[1].forwards;
            }
        });
    }
};

/// The triangles reached from `start` across edges, with whether each is seen from the other side than `start`.
void flood(const Neighbours& neighbours, std::uint32_t start, std::vector<bool>& seen, std::vector<bool>& turned,
           std::vector<std::uint32_t>& reached) {
    reached.assign(1, start);
    seen[start] = true;
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (std::uint32_t corner = 3 * reached[i]; corner < 3 * reached[i] + 3; ++corner) {
            const std::uint32_t next = neighbours.across[corner];
            if (next == kNone || seen[next]) continue;
            seen[next] = true;
            turned[next] = turned[reached[i]] != neighbours.opposed[corner];
            reached.push_back(next);
        }
}

/// A surface that was written once for each side: of each two triangles back to back the first stays. A mesh with some such parts, as
/// leaves or cloth, keeps them.
std::size_t dropDoubles(Surface& surface) {
    const std::vector<std::uint32_t> back = backToBack(surface);
    std::size_t doubled = 0;
    for (std::uint32_t i = 0; i < back.size(); ++i)
        doubled += back[i] != i;
    if (2 * doubled <= back.size()) return 0;
    return keepTriangles(surface.mesh, [&](std::span<const std::uint32_t, 3>, std::size_t triangle) { return back[triangle] >= triangle; });
}

void turnOver(Mesh& mesh, std::uint32_t triangle) {
    std::swap(mesh.indices[3 * std::size_t{triangle} + 1], mesh.indices[3 * std::size_t{triangle} + 2]);
}

/// Turns what differs from the majority of its component. The components: closed ones in `closed`, the others' triangles in `open`.
std::size_t orientByMajority(Surface& surface, std::vector<std::vector<std::uint32_t>>& closed, std::vector<std::uint32_t>& open) {
    const Neighbours neighbours(surface);
    const std::size_t count = surface.triangles();
    std::vector<bool> seen(count, false);
    std::vector<bool> turned(count, false);
    std::vector<std::uint32_t> reached;
    std::size_t changed = 0;
    for (std::uint32_t start = 0; start < count; ++start) {
        if (seen[start]) continue;
        flood(neighbours, start, seen, turned, reached);
        const auto others = static_cast<std::size_t>(std::ranges::count_if(reached, [&](std::uint32_t t) { return turned[t]; }));
        const bool minority = 2 * others <= reached.size(); // of the triangles that differ from `start`
        for (const std::uint32_t t : reached)
            if (turned[t] == minority) turnOver(surface.mesh, t);
        changed += minority ? others : reached.size() - others;
        const bool whole = std::ranges::none_of(reached, [&](std::uint32_t t) {
            return neighbours.across[3 * t] == kNone || neighbours.across[3 * t + 1] == kNone || neighbours.across[3 * t + 2] == kNone;
        });
        if (whole)
            closed.push_back(reached);
        else
            open.insert(open.end(), reached.begin(), reached.end());
    }
    return changed;
}

/// What is open is judged as one.
bool facesInwards(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
    Mesh some;
    some.positions = mesh.positions;
    for (const std::uint32_t triangle : triangles)
        some.indices.insert(some.indices.end(),
                            {mesh.indices[3 * triangle], mesh.indices[3 * triangle + 1], mesh.indices[3 * triangle + 2]});
    return outwardFacing(some) < 0;
}

} // namespace

DisjointSets cornerFans(const Surface& surface, const EdgeTable& edges, const std::vector<std::uint32_t>& backToBack) {
    DisjointSets fans(surface.mesh.indices.size());
    const auto join = [&](const HalfEdge& a, const HalfEdge& b) {
        if (a.forwards == b.forwards || backToBack[a.triangle()] == b.triangle()) return;
        fans.join(a.corner, nextCorner(b.corner));
        fans.join(nextCorner(a.corner), b.corner);
    };
    edges.forEach([&](std::span<const HalfEdge> sides) {
        constexpr std::size_t kFew = 8; // an edge of a million triangles: each is joined to the next ones only, so time stays linear
        for (std::size_t i = 0; i < sides.size(); ++i)
            for (std::size_t k = i + 1; k < std::min(sides.size(), i + kFew); ++k)
                join(sides[i], sides[k]);
    });
    return fans;
}

Topology examine(const Surface& surface) {
    Topology topology;
    const auto ofEdges = [&] {
        const EdgeTable edges(surface);
        countEdges(edges, topology);
        std::vector<std::uint32_t> none(surface.triangles()); // triangles back to back share their edges: they are one fan here
        std::iota(none.begin(), none.end(), 0u);
        DisjointSets fans = cornerFans(surface, edges, none);
        topology.bowTies = countBowTies(surface, fans);
    };
    const auto ofTriangles = [&] {
        const std::vector<std::uint32_t> back = backToBack(surface);
        for (std::uint32_t i = 0; i < back.size(); ++i)
            topology.backToBackPairs += back[i] > i;
        topology.flatTriangles = countFlat(surface);
        topology.components = countComponents(surface);
    };
    forEachInParallel(2, [&](std::size_t i) { i == 0 ? ofEdges() : ofTriangles(); });
    return topology;
}

std::size_t shellsInsideOut(Surface surface) {
    std::vector<std::vector<std::uint32_t>> closed;
    std::vector<std::uint32_t> open;
    if (orientByMajority(surface, closed, open) > 0) return 0; // told by another warning
    return static_cast<std::size_t>(std::ranges::count_if(shellsOf(surface, std::move(closed)), &Shell::insideOut));
}

Oriented orient(Surface& surface) {
    Oriented done{.doubles = dropDoubles(surface)};
    std::vector<std::vector<std::uint32_t>> closed;
    std::vector<std::uint32_t> open;
    done.turned = orientByMajority(surface, closed, open);
    std::size_t over = 0;
    for (const Shell& shell : shellsOf(surface, std::move(closed))) {
        if (!shell.insideOut()) continue;
        ++done.shells;
        over += shell.triangles.size();
        for (const std::uint32_t triangle : shell.triangles)
            turnOver(surface.mesh, triangle);
    }
    if (!open.empty() && facesInwards(surface.mesh, open)) {
        over += open.size();
        for (const std::uint32_t triangle : open)
            turnOver(surface.mesh, triangle);
    }
    done.turnedOver = over;
    return done;
}

} // namespace tegument::prep
