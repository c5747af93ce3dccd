#include "host/reference/surface.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>

namespace tegument::reference {

struct RayScene::State {
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);

    ~State() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

RayScene::RayScene(const Mesh& mesh) : mesh_(mesh), state_(std::make_unique<State>()) {
    RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
    for (const glm::vec3& p : mesh.positions)
        points = std::copy_n(&p.x, 3, points);
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.indices.size() / 3));
    std::ranges::copy(mesh.indices, indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(state_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST); // no ray slips through an edge
    rtcCommitScene(state_->scene);
}

RayScene::~RayScene() = default;

namespace {

/// Where the ray meets the plane of the triangle.
Hit refine(const Mesh& mesh, std::uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction) {
    const auto corner = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.indices[3 * static_cast<std::size_t>(triangle) + c]]); };
    const glm::dvec3 a = corner(0);
    const glm::dvec3 p = corner(1) - a;
    const glm::dvec3 q = corner(2) - a;
    const glm::dvec3 normal = glm::cross(p, q);
    const double distance = glm::dot(a - origin, normal) / glm::dot(direction, normal);
    const glm::dvec3 within = origin + distance * direction - a;
    const double square = glm::dot(normal, normal);
    const double wb = glm::dot(glm::cross(within, q), normal) / square;
    const double wc = glm::dot(glm::cross(p, within), normal) / square;
    return {{triangle, {1 - wb - wc, wb, wc}}, distance};
}

} // namespace

std::optional<Hit> RayScene::nearest(const glm::dvec3& origin, const glm::dvec3& direction) const {
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(origin.x);
    ray.ray.org_y = static_cast<float>(origin.y);
    ray.ray.org_z = static_cast<float>(origin.z);
    ray.ray.dir_x = static_cast<float>(direction.x);
    ray.ray.dir_y = static_cast<float>(direction.y);
    ray.ray.dir_z = static_cast<float>(direction.z);
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(state_->scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return refine(mesh_, ray.hit.primID, origin, direction);
}

bool RayScene::reaches(const glm::dvec3& light, const glm::dvec3& point, double slack) const {
    const double distance = glm::length(point - light);
    const auto hit = nearest(light, (point - light) / distance);
    return !hit || hit->distance > distance - slack;
}

std::vector<std::uint32_t> RayScene::around(const glm::dvec3& centre, double radius) const {
    constexpr double kWidened = 1 + 1e-5; // the query is in 32-bit floats
    RTCPointQuery query{};
    query.x = static_cast<float>(centre.x);
    query.y = static_cast<float>(centre.y);
    query.z = static_cast<float>(centre.z);
    query.radius = static_cast<float>(radius * kWidened);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    std::vector<std::uint32_t> found;
    const auto take = [](RTCPointQueryFunctionArguments* arguments) {
        static_cast<std::vector<std::uint32_t>*>(arguments->userPtr)->push_back(arguments->primID);
        return false; // the radius stays
    };
    rtcPointQuery(state_->scene, &query, &context, take, &found);
    std::ranges::sort(found);
    return found;
}

} // namespace tegument::reference
