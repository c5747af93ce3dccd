#include "meshprep/prepare/shells.h"

#include "host/mesh/normals.h"
#include "host/support/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::prep {

namespace {

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

} // namespace

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

} // namespace tegument::prep
