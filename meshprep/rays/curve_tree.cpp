#include "meshprep/rays/curve_tree.h"

#include "meshprep/rays/embree.h"

#include <algorithm>
#include <limits>

namespace tegument {

struct CurveTree::State {
    EmbreeScene embree;
    std::vector<glm::vec4> controls;
    std::vector<std::uint32_t> starts;
};

namespace {

struct CurvePlace {
    glm::dvec3 axis; // not unit
    double radius;
};

/// By the basis of uniform cubic B-splines and its derivative.
CurvePlace curveAt(const glm::vec4* controls, double u) {
    const double v = 1 - u;
    const double basis[4] = {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6, u * u * u / 6};
    const double slope[4] = {-v * v / 2, (3 * u * u - 4 * u) / 2, -(3 * v * v - 4 * v) / 2, u * u / 2};
    CurvePlace place{glm::dvec3(0), 0};
    for (int i = 0; i < 4; ++i) {
        place.axis += slope[i] * glm::dvec3(controls[i]);
        place.radius += basis[i] * static_cast<double>(controls[i].w);
    }
    return place;
}

} // namespace

CurveTree::CurveTree(std::vector<glm::vec4> controls, std::span<const std::uint32_t> starts, unsigned threads)
    : state_(new State{EmbreeScene(threads), std::move(controls), {starts.begin(), starts.end()}}) {
    RTCGeometry geometry = rtcNewGeometry(state_->embree.device, RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE);
    auto* points = static_cast<glm::vec4*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(glm::vec4), state_->controls.size()));
    std::ranges::copy(state_->controls, points);
    auto* pieces = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(std::uint32_t), state_->starts.size()));
    std::ranges::copy(state_->starts, pieces);
    state_->embree.commit(geometry);
}

CurveTree::~CurveTree() = default;

std::optional<CurveHit> CurveTree::nearest(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range) const {
    RTCRayHit query{.ray = rayFrom(origin, direction, range.first, range.last), .hit = {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    QueryContext context;
    meetNearest(state_->embree.scene, context, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const RTCHit& met = query.hit;
    const double along = std::clamp(static_cast<double>(met.u), 0.0, 1.0);
    const CurvePlace place = curveAt(&state_->controls[state_->starts[met.primID]], along);
    CurveHit hit{.piece = met.primID, .along = met.u, .distance = query.ray.tfar, .radius = place.radius};
    hit.normal = glm::normalize(glm::dvec3(met.Ng_x, met.Ng_y, met.Ng_z));
    hit.axis = glm::normalize(place.axis);
    return hit;
}

bool CurveTree::meetsAny(const glm::vec3& origin, const glm::vec3& direction, const RayRange& range) const {
    RTCRay ray = rayFrom(origin, direction, range.first, range.last);
    meetAny(state_->embree.scene, ray);
    return !(ray.tfar >= 0); // Embree sets it to minus infinity on a hit
}

} // namespace tegument
