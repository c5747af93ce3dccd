#include "host/support/rays/surface_tree.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>

namespace tegument {

struct SurfaceTree::State {
    RTCDevice device;
    RTCScene scene;

    explicit State(unsigned threads) : device(rtcNewDevice(threads == 1 ? "threads=1" : nullptr)), scene(rtcNewScene(device)) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
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

RTCRay rayFrom(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.tnear = range.first;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = range.last;
    ray.mask = ~0U;
    return ray;
}

} // namespace

SurfaceTree::SurfaceTree(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, const TreeOptions& options)
    : state_(std::make_unique<State>(options.threads)) {
    assert(options.corners == 3 || options.corners == 4);
    RTCGeometry geometry = rtcNewGeometry(state_->device, options.corners == 3 ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_QUAD);
    fill(geometry, positions, indices, options.corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(state_->scene, geometry);
    rtcReleaseGeometry(geometry);
    if (options.watertight) rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
    if (options.quick) rtcSetSceneBuildQuality(state_->scene, RTC_BUILD_QUALITY_LOW);
    rtcCommitScene(state_->scene);
}

SurfaceTree::~SurfaceTree() = default;

std::optional<RayHit> SurfaceTree::nearest(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range) const {
    RTCRayHit query{.ray = rayFrom(origin, direction, range), .hit = {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(state_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayHit{.face = query.hit.primID, .distance = query.ray.tfar};
}

bool SurfaceTree::meetsAny(const glm::vec3& origin, const glm::vec3& direction) const {
    RTCRay ray = rayFrom(origin, direction, {});
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(state_->scene, &context, &ray);
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
    rtcPointQuery(state_->scene, &query, &context, take, &call);
}

} // namespace tegument
