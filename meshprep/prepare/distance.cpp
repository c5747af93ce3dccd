// Nearest points by Embree's point queries over its tree of boxes. Embree works in single precision, so the surfaces are brought to unit
// size around the origin first.

#include "meshprep/prepare/distance.h"

#include "meshprep/prepare/nearest.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace tegument::prep {

namespace {

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

/// A point's way to the nearest triangle: Embree shows the triangles near it, nearest boxes first.
struct Search {
    const std::vector<glm::dvec3>* positions = nullptr;
    std::span<const std::uint32_t> triangles;
    glm::dvec3 point{0};
    double squared = std::numeric_limits<double>::infinity();
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<Search*>(arguments->userPtr);
    const std::uint32_t* t = &search.triangles[3 * std::size_t{arguments->primID}];
    const auto& p = *search.positions;
    const glm::dvec3 offset = nearestOnTriangle(search.point, p[t[0]], p[t[1]], p[t[2]]) - search.point;
    const double squared = glm::dot(offset, offset);
    if (squared >= search.squared) return false;
    search.squared = squared;
    arguments->query->radius = std::nextafter(static_cast<float>(std::sqrt(squared)), 1e30f);
    return true;
}

class Surface {
public:
    Surface(const std::vector<glm::dvec3>& positions, std::span<const std::uint32_t> triangles)
        : positions_(positions), triangles_(triangles), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_.get())) {
        RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), positions.size()));
        for (const glm::dvec3& p : positions)
            for (glm::length_t i = 0; i < 3; ++i)
                *vertices++ = static_cast<float>(p[i]);
        auto* indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size() / 3));
        std::ranges::copy(triangles, indices);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_.get(), geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_.get());
    }

    [[nodiscard]] double squaredDistance(const glm::dvec3& point) const {
        Search search{.positions = &positions_, .triangles = triangles_, .point = point};
        RTCPointQuery query{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z), 0,
                            std::numeric_limits<float>::infinity()};
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        rtcPointQuery(scene_.get(), &query, &context, visit, &search);
        return search.squared;
    }

private:
    const std::vector<glm::dvec3>& positions_;
    std::span<const std::uint32_t> triangles_;
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> scene_;
};

} // namespace

SurfaceDistance distance(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to) {
    if (from.empty() || to.empty()) return {};
    glm::dvec3 low(positions[from[0]]);
    glm::dvec3 high = low;
    for (const std::uint32_t index : from) {
        low = glm::min(low, glm::dvec3(positions[index]));
        high = glm::max(high, glm::dvec3(positions[index]));
    }
    const glm::dvec3 size = high - low;
    const double scale = std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
    std::vector<glm::dvec3> points;
    points.reserve(positions.size());
    for (const glm::vec3& p : positions)
        points.push_back((glm::dvec3(p) - low) / scale);
    const Surface surface(points, to);
    double greatest = 0;
    double sum = 0;
    std::size_t count = 0;
    const auto add = [&](const glm::dvec3& point) {
        const double squared = surface.squaredDistance(point);
        greatest = std::max(greatest, squared);
        sum += squared;
        ++count;
    };
    std::vector<bool> done(positions.size(), false);
    for (std::size_t i = 0; i < from.size(); i += 3) {
        add((points[from[i]] + points[from[i + 1]] + points[from[i + 2]]) / 3.0);
        for (const std::uint32_t corner : from.subspan(i, 3)) {
            if (!done[corner]) add(points[corner]);
            done[corner] = true;
        }
    }
    return {.greatest = scale * std::sqrt(greatest), .rms = scale * std::sqrt(sum / static_cast<double>(count))};
}

} // namespace tegument::prep
