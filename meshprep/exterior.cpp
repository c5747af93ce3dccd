#include "meshprep/exterior.h"

#include "host/support/disjoint_sets.h"
#include "meshprep/edge_ways.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

namespace tegument {

namespace {

/// An Embree scene of quads; released with it.
class OccluderScene {
public:
    OccluderScene(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
        auto* points = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), positions.size()));
        for (const glm::vec3& p : positions)
            points = std::copy_n(&p.x, 3, points);
        auto* indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(std::uint32_t), quads.size()));
        for (const Quad& quad : quads)
            indices = std::ranges::copy(quad.position, indices).out;
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene_);
    }
    ~OccluderScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    OccluderScene(const OccluderScene&) = delete;
    OccluderScene& operator=(const OccluderScene&) = delete;

    [[nodiscard]] bool leaves(const glm::vec3& origin, const glm::vec3& direction) const {
        RTCRay ray{};
        ray.org_x = origin.x;
        ray.org_y = origin.y;
        ray.org_z = origin.z;
        ray.dir_x = direction.x;
        ray.dir_y = direction.y;
        ray.dir_z = direction.z;
        ray.tfar = std::numeric_limits<float>::infinity();
        ray.mask = ~0u;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene_, &context, &ray);
        return ray.tfar >= 0; // Embree sets it to minus infinity on a hit
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

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

bool isSeen(const OccluderScene& scene, const glm::vec3& centre, const glm::vec3& normal, const std::vector<glm::vec3>& directions,
            int least) {
    constexpr float kLift = 0.01f;    // mm off the surface, against hitting the quad itself
    constexpr float kGrazing = 0.02f; // rays flatter than this would skim over the neighbours' facets
    const glm::vec3 origin = centre + normal * kLift;
    int leaving = 0;
    for (const glm::vec3& direction : directions) {
        if (glm::dot(direction, normal) <= kGrazing || !scene.leaves(origin, direction)) continue;
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
    const OccluderScene scene(positions, quads);
    const std::vector<glm::vec3> spread = spreadDirections(rays.directions);
    std::vector<std::uint8_t> seen;
    for (const Quad& quad : quads) {
        std::array<glm::vec3, 4> p{};
        for (std::size_t c = 0; c < 4; ++c)
            p[c] = positions[quad.position[c]];
        const glm::vec3 normal = glm::normalize(glm::cross(p[2] - p[0], p[3] - p[1]));
        seen.push_back(isSeen(scene, (p[0] + p[1] + p[2] + p[3]) / 4.0f, normal, spread, rays.leastLeaving) ? 1 : 0);
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
