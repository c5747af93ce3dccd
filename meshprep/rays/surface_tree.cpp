#include "meshprep/rays/surface_tree.h"

#include "meshprep/rays/embree.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace tegument {

struct SurfaceTree::State {
    EmbreeScene embree;
};

namespace {

/// Buffers of Embree's own: it reads 16 bytes at the last vertex.
void fill(RTCGeometry geometry, std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, std::size_t corners) {
    auto* points = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), positions.size()));
    for (const glm::vec3& p : positions)
        points = std::copy_n(&p.x, 3, points);
    auto* faces = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                                      corners == 3 ? RTC_FORMAT_UINT3 : RTC_FORMAT_UINT4,
                                                                      corners * sizeof(std::uint32_t), indices.size() / corners));
    std::ranges::copy(indices, faces);
}

} // namespace

SurfaceTree::SurfaceTree(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, const TreeOptions& options)
    : state_(new State{EmbreeScene(options.threads)}) {
    assert(options.corners == 3 || options.corners == 4);
    RTCGeometry geometry =
        rtcNewGeometry(state_->embree.device, options.corners == 3 ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_QUAD);
    fill(geometry, positions, indices, options.corners);
    if (options.watertight) rtcSetSceneFlags(state_->embree.scene, RTC_SCENE_FLAG_ROBUST);
    if (options.quick) rtcSetSceneBuildQuality(state_->embree.scene, RTC_BUILD_QUALITY_LOW);
    state_->embree.commit(geometry);
}

SurfaceTree::~SurfaceTree() = default;

std::optional<RayHit> SurfaceTree::nearest(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range) const {
    RTCRayHit query{.ray = rayFrom(origin, direction, range.first, range.last), .hit = {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    QueryContext context;
    meetNearest(state_->embree.scene, context, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayHit{.face = query.hit.primID, .distance = query.ray.tfar};
}

bool SurfaceTree::meetsAny(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range) const {
    RTCRay ray = rayFrom(origin, direction, range.first, range.last);
    meetAny(state_->embree.scene, ray);
    return !(ray.tfar >= 0); // Embree sets it to minus infinity on a hit
}

void SurfaceTree::search(const glm::vec3& point, float radius, Visitor visitor, void* own) const {
    struct Call {
        Visitor visitor;
        void* own;
    } call{visitor, own};
    const auto take = [](RTCPointQueryFunctionArguments* arguments) {
        const auto& to = *static_cast<Call*>(arguments->userPtr);
        const float left = to.visitor(to.own, arguments->primID);
        const bool smaller = left < arguments->query->radius;
        if (smaller) arguments->query->radius = left;
        return smaller;
    };
    RTCPointQuery query{};
    query.x = point.x;
    query.y = point.y;
    query.z = point.z;
    query.radius = radius;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(state_->embree.scene, &query, &context, take, &call);
}

} // namespace tegument
