#pragma once
// Inside meshprep/rays: what both trees share of Embree, and all that differs between its versions 3 and 4.

#if TEGUMENT_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <glm/glm.hpp>

namespace tegument {

// Embree is not built for ThreadSanitizer, which takes for races what Embree's own threads do among themselves: there it has one only.
#ifdef __SANITIZE_THREAD__
inline constexpr bool kEmbreeAlone = true;
#else
inline constexpr bool kEmbreeAlone = false;
#endif

struct EmbreeScene {
    RTCDevice device;
    RTCScene scene;

    explicit EmbreeScene(unsigned threads)
        : device(rtcNewDevice(threads == 1 || kEmbreeAlone ? "threads=1" : nullptr)), scene(rtcNewScene(device)) {}
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    /// Takes the geometry over and builds the tree.
    void commit(RTCGeometry geometry) const {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
    }
};

#if TEGUMENT_EMBREE == 4
using QueryContext = RTCRayQueryContext;

inline void meetNearest(RTCScene scene, QueryContext& context, RTCRayHit& query) {
    rtcInitRayQueryContext(&context);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &query, &arguments);
}

inline void meetAny(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray);
}
#else
using QueryContext = RTCIntersectContext;

inline void meetNearest(RTCScene scene, QueryContext& context, RTCRayHit& query) {
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
}

inline void meetAny(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}
#endif

inline RTCRay rayFrom(const glm::vec3& origin, const glm::vec3& direction, float first, float last) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.tnear = first;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = last;
    ray.mask = ~0U;
    return ray;
}

} // namespace tegument
