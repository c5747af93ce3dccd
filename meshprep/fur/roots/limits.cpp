#include "meshprep/fur/roots/limits.h"

#include "host/support/parallel.h"
#include "meshprep/fur/roots/point_grid.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>
#include <memory>

namespace tegument {

namespace {

constexpr float kFarthest = 2; // no strand is longer than the ball's radius: what is further away than twice that limits none

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

/// The surface as Embree's tree.
class Rays {
public:
    Rays(const FurSurface& surface, unsigned threads)
        : device_(rtcNewDevice(threads == 1 ? "threads=1" : nullptr)), scene_(rtcNewScene(device_.get())) {
        const auto& positions = surface.positions();
        const auto& indices = surface.mesh().indices;
        rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW); // one short ray a root does not repay a better tree
        RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        // Embree reads 16 bytes at the last vertex: a buffer of its own has them
        auto* vertices = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), positions.size()));
        for (const glm::vec3& p : positions)
            for (glm::length_t i = 0; i < 3; ++i)
                *vertices++ = p[i];
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0, 3 * sizeof(std::uint32_t),
                                   indices.size() / 3);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_.get(), geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_.get());
    }

    [[nodiscard]] float along(const glm::vec3& from, const glm::vec3& direction, float start) const {
        RTCRayHit query{};
        query.ray = {.org_x = from.x,
                     .org_y = from.y,
                     .org_z = from.z,
                     .tnear = start,
                     .dir_x = direction.x,
                     .dir_y = direction.y,
                     .dir_z = direction.z,
                     .tfar = kFarthest,
                     .mask = UINT32_MAX};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_.get(), &context, &query);
        return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity() : query.ray.tfar;
    }

private:
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> scene_;
};

/// Two directions that are perpendicular to a unit vector and each other (T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT
/// 6(1), 2017).
std::pair<glm::vec3, glm::vec3> tangents(const glm::vec3& n) {
    const float sign = std::copysign(1.0F, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

/// The linear map M from steps on the tangent plane to changes of the normal that fits all neighbours best; the concave curvature is minus
/// its least eigenvalue.
class NormalFit {
public:
    void add(const glm::vec2& step, const glm::vec2& change) {
        steps_ += glm::outerProduct(step, step);
        changes_ += glm::outerProduct(change, step);
        ++count_;
    }

    [[nodiscard]] float concaveCurvature() const {
        const float determinant = glm::determinant(steps_);
        const float trace = steps_[0][0] + steps_[1][1];
        if (count_ < 3 || !(determinant > 1e-3F * trace * trace)) return 0; // all in one line: no plane to fit
        const glm::mat2 m = changes_ * glm::inverse(steps_);
        const float mean = (m[0][0] + m[1][1]) / 2;
        const float half = (m[0][0] - m[1][1]) / 2;
        const float shear = (m[0][1] + m[1][0]) / 2;
        return std::max(0.0F, std::sqrt(half * half + shear * shear) - mean);
    }

private:
    glm::mat2 steps_{0};
    glm::mat2 changes_{0};
    int count_ = 0;
};

float curvatureAt(const PointGrid& grid, const SurfacePoint& root, float reach) {
    const std::pair<glm::vec3, glm::vec3> frame = tangents(root.normal);
    const auto onPlane = [&](const glm::vec3& d) { return glm::vec2(glm::dot(d, frame.first), glm::dot(d, frame.second)); };
    NormalFit fit;
    grid.visit(root.position, reach, [&](std::uint32_t i, float) {
        const PointGrid::Entry& other = grid.entries()[i];
        const glm::vec3 step = other.position - root.position;
        const glm::vec3 change = other.normal - root.normal;
        if (glm::dot(other.normal, root.normal) > 0) fit.add(onPlane(step), onPlane(change));
        return true;
    });
    return fit.concaveCurvature();
}

} // namespace

std::vector<LengthLimits> lengthLimits(const FurSurface& surface, const std::vector<SurfacePoint>& roots, float reach, unsigned threads) {
    PointGrid grid(reach, roots.size());
    for (const SurfacePoint& root : roots)
        grid.add(root.position, root.normal, 0);
    const Rays rays(surface, threads);
    std::vector<LengthLimits> limits(roots.size());
    const float start = 1e-3F * reach; // beyond the rounding of the root's own triangle
    inChunks(roots.size(), threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i)
            limits[i] = {.curvature = curvatureAt(grid, roots[i], reach),
                         .opposite = rays.along(roots[i].position, roots[i].normal, start)};
    });
    return limits;
}

} // namespace tegument
