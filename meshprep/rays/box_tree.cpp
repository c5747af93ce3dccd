#include "meshprep/rays/box_tree.h"

#include "meshprep/rays/embree.h"

#include <vector>

namespace tegument {

struct BoxTree::State {
    std::vector<PieceBox> boxes;
    EmbreeScene embree{1};
};

namespace {

struct Search : QueryContext {
    float (*visitor)(void*, std::uint32_t) = nullptr;
    void* own = nullptr;
};

void boundsOf(const RTCBoundsFunctionArguments* arguments) {
    const PieceBox& box = (*static_cast<const std::vector<PieceBox>*>(arguments->geometryUserPtr))[arguments->primID];
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = box.low.x, bounds.lower_y = box.low.y, bounds.lower_z = box.low.z;
    bounds.upper_x = box.high.x, bounds.upper_y = box.high.y, bounds.upper_z = box.high.z;
}

void visit(const RTCIntersectFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    const Search& search = *static_cast<Search*>(arguments->context);
    float& last = RTCRayN_tfar(RTCRayHitN_RayN(arguments->rayhit, arguments->N), arguments->N, 0);
    const float left = search.visitor(search.own, arguments->primID);
    if (left < last) last = left;
}

} // namespace

BoxTree::BoxTree(std::span<const PieceBox> boxes) : state_(std::make_unique<State>()) {
    state_->boxes.assign(boxes.begin(), boxes.end());
    RTCGeometry geometry = rtcNewGeometry(state_->embree.device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
    rtcSetGeometryUserData(geometry, &state_->boxes);
    rtcSetGeometryBoundsFunction(geometry, boundsOf, nullptr);
    rtcSetGeometryIntersectFunction(geometry, visit);
    rtcSetSceneFlags(state_->embree.scene, RTC_SCENE_FLAG_ROBUST); // no ray slips past a piece
    state_->embree.commit(geometry);
}

BoxTree::~BoxTree() = default;

void BoxTree::search(const glm::vec3& origin, const glm::vec3& direction, float last, Visitor visitor, void* own) const {
    Search search{};
    search.visitor = visitor;
    search.own = own;
    RTCRayHit query{.ray = rayFrom(origin, direction, 0, last), .hit = {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    meetNearest(state_->embree.scene, search, query);
}

} // namespace tegument
