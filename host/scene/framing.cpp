#include "host/scene/framing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace tegument {

namespace {

/// How far to one side all points lie within a field of view, of which `slope` is the tangent of the half: the eye at (x, z) sees them
/// where |p.x - x| <= slope * (z - p.z).
class Wedge {
public:
    explicit Wedge(double slope) : slope_(slope) {}

    void add(double side, double towardsEye) {
        high_ = std::max(high_, side + slope_ * towardsEye);
        low_ = std::max(low_, slope_ * towardsEye - side);
    }
    [[nodiscard]] double middle() const { return (high_ - low_) / 2; }
    [[nodiscard]] double distance() const { return (high_ + low_) / (2 * slope_); }

private:
    double slope_;
    double high_ = -std::numeric_limits<double>::infinity();
    double low_ = -std::numeric_limits<double>::infinity();
};

/// Where the eye stands beside the points, so that from `distance` they reach as far to one side as to the other. Each step takes out all
/// of what is uneven but for the share that depths vary by.
double evenSides(const std::vector<glm::dvec2>& sideAndTowards, double distance, double from) {
    constexpr int kSteps = 12;
    for (int step = 0; step < kSteps; ++step) {
        double high = -std::numeric_limits<double>::infinity();
        double low = high;
        double depthOfHigh = distance, depthOfLow = distance;
        for (const glm::dvec2& p : sideAndTowards) {
            const double depth = distance - p.y;
            const double tangent = (p.x - from) / depth;
            if (tangent > high) high = tangent, depthOfHigh = depth;
            if (-tangent > low) low = -tangent, depthOfLow = depth;
        }
        from += (high - low) / (1 / depthOfHigh + 1 / depthOfLow);
    }
    return from;
}

/// Rings that enclose the mesh in every position of a turn about the vertical through `centre`.
std::vector<glm::vec3> sweptRings(const Mesh& mesh, const glm::dvec3& centre, UpAxis up) {
    constexpr int kSlices = 256;
    constexpr int kSides = 48;
    constexpr double kTurn = 6.28318530717958647692;
    const glm::dvec3 axis(alongUp(up, {0, 1, 0}));
    const glm::dvec3 aside(alongUp(up, {1, 0, 0}));
    const glm::dvec3 ahead = glm::cross(aside, axis);
    const double reach = std::max(static_cast<double>(mesh.bounds.radius), 1e-6);
    std::vector<double> widest(kSlices + 1, -1);
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 p = glm::dvec3(position) - centre;
        const double height = glm::dot(p, axis);
        const auto slice = static_cast<std::size_t>(std::lround(std::clamp((height / reach + 1) / 2, 0.0, 1.0) * kSlices));
        widest[slice] = std::max(widest[slice], glm::length(p - height * axis));
    }
    std::vector<glm::vec3> rings;
    for (int slice = 0; slice <= kSlices; ++slice) {
        const double radius = widest[static_cast<std::size_t>(slice)];
        for (int side = 0; side < kSides && radius >= 0; ++side) {
            const double angle = kTurn * side / kSides;
            const glm::dvec3 around = radius * (std::cos(angle) * aside + std::sin(angle) * ahead);
            rings.emplace_back(centre + (2.0 * slice / kSlices - 1) * reach * axis + around);
        }
    }
    return rings;
}

/// Rodrigues' formula; `axis` of length 1.
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) + axis * glm::dot(axis, v) * (1 - std::cos(angle));
}

} // namespace

glm::vec3 alongUp(UpAxis up, const glm::vec3& v) {
    return up == UpAxis::Y ? v : glm::vec3(v.x, -v.z, v.y);
}

Camera frameMesh(const Mesh& mesh, const glm::vec3& direction, UpAxis up, float horizontalFov, double aspect) {
    assert(!mesh.positions.empty() && aspect > 0);
    const glm::dvec3 back = glm::normalize(glm::dvec3(alongUp(up, direction)));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(alongUp(up, {0, 1, 0})), back));
    const glm::dvec3 above = glm::cross(back, right);
    const double slope = kFramedShare * std::tan(glm::radians(static_cast<double>(horizontalFov)) / 2);
    Wedge across(slope);
    Wedge along(slope / aspect);
    const glm::dvec3 centre(mesh.bounds.centre);
    std::vector<glm::dvec2> sides;
    std::vector<glm::dvec2> heights;
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 p = glm::dvec3(position) - centre;
        sides.emplace_back(glm::dot(p, right), glm::dot(p, back));
        heights.emplace_back(glm::dot(p, above), glm::dot(p, back));
        across.add(sides.back().x, sides.back().y);
        along.add(heights.back().x, heights.back().y);
    }
    // A mesh that is a point is seen from beyond it, a needle that points at the eye not from its tip.
    const double least = std::max(2 * static_cast<double>(mesh.bounds.radius), 1e-3);
    const double distance = std::max({across.distance(), along.distance(), least});
    const glm::dvec3 target =
        centre + evenSides(sides, distance, across.middle()) * right + evenSides(heights, distance, along.middle()) * above;
    return {.position = glm::vec3(target + distance * back),
            .target = glm::vec3(target),
            .up = alongUp(up, {0, 1, 0}),
            .horizontalFov = horizontalFov};
}

Camera frameTurningMesh(const Mesh& mesh, const glm::vec3& direction, UpAxis up, float horizontalFov, double aspect) {
    Mesh swept;
    swept.positions = sweptRings(mesh, glm::dvec3(mesh.bounds.centre), up);
    swept.bounds = mesh.bounds;
    return frameMesh(swept, direction, up, horizontalFov, aspect);
}

Workspace turnedScene(const Workspace& workspace, const glm::dvec3& pivot, double angle) {
    assert(!workspace.cameraRelative && !workspace.lightRelative);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(workspace.camera.up));
    const auto about = [&](const glm::vec3& point) { return glm::vec3(pivot + turned(glm::dvec3(point) - pivot, axis, -angle)); };
    Workspace result = workspace;
    result.camera.position = about(workspace.camera.position);
    result.camera.target = about(workspace.camera.target);
    result.light.position = about(workspace.light.position);
    if (workspace.light.direction) result.light.direction = glm::vec3(turned(glm::dvec3(*workspace.light.direction), axis, -angle));
    return result;
}

} // namespace tegument
