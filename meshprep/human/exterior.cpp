#include "meshprep/human/exterior.h"

#include "host/support/disjoint_sets.h"
#include "meshprep/human/cut.h"
#include "meshprep/rays/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace tegument {

namespace {

/// Points of a Fibonacci spiral on the unit sphere.
std::vector<glm::vec3> spreadDirections(int count) {
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0)); // the golden angle
    std::vector<glm::vec3> result;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count;
        const double ring = std::sqrt(1 - z * z);
        result.emplace_back(ring * std::cos(turn * i), ring * std::sin(turn * i), z);
    }
    return result;
}

SurfaceTree treeOf(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads) {
    std::vector<std::uint32_t> indices;
    for (const Quad& quad : quads)
        indices.insert(indices.end(), quad.position.begin(), quad.position.end());
    return {positions, indices, {.corners = 4, .watertight = true}};
}

bool isSeen(const SurfaceTree& tree, const glm::vec3& centre, const glm::vec3& normal, const std::vector<glm::vec3>& directions,
            int least) {
    constexpr float kLift = 0.01f;    // mm off the surface, against hitting the quad itself
    constexpr float kGrazing = 0.02f; // rays flatter than this would skim over the neighbours' facets
    const glm::vec3 origin = centre + normal * kLift;
    int leaving = 0;
    for (const glm::vec3& direction : directions) {
        if (glm::dot(direction, normal) <= kGrazing || tree.meetsAny(origin, direction)) continue;
        if (++leaving == least) return true;
    }
    return false;
}

/// For each unseen quad how many unseen quads are joined to it by edges, itself included.
std::vector<std::size_t> unseenPatchSizes(const std::vector<Quad>& quads, const std::vector<std::uint8_t>& seen) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
    DisjointSets patches(quads.size());
    for (std::uint32_t q = 0; q < quads.size(); ++q)
        for (std::size_t c = 0; seen[q] == 0 && c < 4; ++c) {
            const auto edge = std::minmax(quads[q].position[c], quads[q].position[(c + 1) % 4]);
            const auto [entry, isNew] = edges.try_emplace({edge.first, edge.second}, q);
            if (!isNew) patches.join(entry->second, q);
        }
    std::vector<std::size_t> counts(quads.size(), 0);
    for (std::uint32_t q = 0; q < quads.size(); ++q)
        ++counts[patches.find(q)];
    std::vector<std::size_t> sizes;
    for (std::uint32_t q = 0; q < quads.size(); ++q)
        sizes.push_back(counts[patches.find(q)]);
    return sizes;
}

} // namespace

std::vector<std::uint8_t> seenFromOutside(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads,
                                          const ExteriorRays& rays) {
    const SurfaceTree tree = treeOf(positions, quads);
    const std::vector<glm::vec3> spread = spreadDirections(rays.directions);
    std::vector<std::uint8_t> seen;
    for (const Quad& quad : quads) {
        std::array<glm::vec3, 4> p{};
        for (std::size_t c = 0; c < 4; ++c)
            p[c] = positions[quad.position[c]];
        const glm::vec3 normal = glm::normalize(glm::cross(p[2] - p[0], p[3] - p[1]));
        seen.push_back(isSeen(tree, (p[0] + p[1] + p[2] + p[3]) / 4.0f, normal, spread, rays.leastLeaving) ? 1 : 0);
    }
    return seen;
}

std::vector<std::uint8_t> hiddenPatches(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads,
                                        const std::vector<std::uint8_t>& seen, std::size_t leastPatch, float rim) {
    const std::vector<std::size_t> sizes = unseenPatchSizes(quads, seen);
    std::set<std::uint32_t> seenVertices;
    for (std::size_t q = 0; q < quads.size(); ++q)
        if (seen[q] != 0) seenVertices.insert(quads[q].position.begin(), quads[q].position.end());
    const EdgeWays ways = waysAlongEdges(positions, quads, {seenVertices.begin(), seenVertices.end()}, rim);
    std::vector<std::uint8_t> hidden(quads.size(), 0);
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const bool far = std::ranges::all_of(quads[q].position, [&](std::uint32_t v) { return ways.length[v] >= rim; });
        hidden[q] = seen[q] == 0 && far && sizes[q] >= leastPatch ? 1 : 0;
    }
    return hidden;
}

} // namespace tegument
