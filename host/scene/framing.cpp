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
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 p = glm::dvec3(position) - centre;
        across.add(glm::dot(p, right), glm::dot(p, back));
        along.add(glm::dot(p, above), glm::dot(p, back));
    }
    // A mesh that is a point is seen from beyond it; a flat one seen from its edge not from within it.
    const double least = std::max(static_cast<double>(mesh.bounds.radius), 1e-3);
    const double distance = std::max({across.distance(), along.distance(), least});
    const glm::dvec3 target = centre + across.middle() * right + along.middle() * above;
    return {.position = glm::vec3(target + distance * back),
            .target = glm::vec3(target),
            .up = alongUp(up, {0, 1, 0}),
            .horizontalFov = horizontalFov,
            .nearPlane = {},
            .farPlane = {}};
}

} // namespace tegument
