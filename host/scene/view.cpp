// Camera and light matrices, in double precision.

#include "host/scene/view.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

/// Planes leave this share of the sphere's radius as a margin, so that rounding in the depth test cannot clip the point that touches the
/// sphere.
constexpr double kPlaneMargin = 1e-3;
/// Near plane over far plane where the eye is inside the sphere: a 24-bit depth buffer still separates 0.01 % of the distance there.
constexpr double kLeastNearShare = 1e-3;
constexpr double kWidestLightCone = glm::radians(160.0);

/// A unit vector that is not parallel to `forward`, as near to `wanted` as may be.
glm::dvec3 usableUp(const glm::dvec3& forward, const glm::dvec3& wanted) {
    if (glm::length(glm::cross(forward, wanted)) > 1e-6 * glm::length(wanted)) return wanted;
    return std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, forward.y > 0 ? 1 : -1);
}

struct Frame {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 back;
    glm::dvec3 eye;
};

Frame lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    const glm::dvec3 offset = target - eye;
    const glm::dvec3 forward = glm::length(offset) > 0 ? glm::normalize(offset) : glm::dvec3(0, 0, -1);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, usableUp(forward, up)));
    return {.right = right, .up = glm::cross(right, forward), .back = -forward, .eye = eye};
}

/// Row-vector view matrix: the columns are the axes, the last row moves the eye to the origin.
glm::dmat4 viewMatrix(const Frame& frame) {
    glm::dmat4 m(1);
    for (int row = 0; row < 3; ++row)
        m[row] = glm::dvec4(frame.right[row], frame.up[row], frame.back[row], 0);
    m[3] = glm::dvec4(-glm::dot(frame.eye, frame.right), -glm::dot(frame.eye, frame.up), -glm::dot(frame.eye, frame.back), 1);
    return m;
}

/// Row-vector projection: x' = x cot(fov/2), y' = y aspect cot(fov/2), z' = -(z + near) far / (far - near), w' = -z.
glm::dmat4 projectionMatrix(double horizontalFov, double aspect, double nearPlane, double farPlane) {
    const double scale = 1 / std::tan(horizontalFov / 2);
    glm::dmat4 m(0);
    m[0][0] = scale;
    m[1][1] = scale * aspect;
    m[2][2] = farPlane / (nearPlane - farPlane);
    m[2][3] = -1;
    m[3][2] = nearPlane * farPlane / (nearPlane - farPlane);
    return m;
}

/// Row-vector parallel projection onto a square: x' = x / half, y' = y / half, z' = -(z + near) / (far - near), w' = 1.
glm::dmat4 parallelMatrix(double half, double nearPlane, double farPlane) {
    glm::dmat4 m(1);
    m[0][0] = 1 / half;
    m[1][1] = 1 / half;
    m[2][2] = 1 / (nearPlane - farPlane);
    m[3][2] = nearPlane / (nearPlane - farPlane);
    return m;
}

Matrices assemble(const Frame& frame, const glm::dmat4& projection, double horizontalFov, double nearPlane, double farPlane) {
    const glm::dmat4 view = viewMatrix(frame);
    const glm::dmat4 both = projection * view; // GLM's order: first view, then projection
    return {.view = glm::mat4(view),
            .projection = glm::mat4(projection),
            .viewProjection = glm::mat4(both),
            .inverseView = glm::mat4(glm::inverse(view)),
            .inverseProjection = glm::mat4(glm::inverse(projection)),
            .inverseViewProjection = glm::mat4(glm::inverse(both)),
            .position = glm::vec3(frame.eye),
            .horizontalFov = static_cast<float>(horizontalFov),
            .nearPlane = static_cast<float>(nearPlane),
            .farPlane = static_cast<float>(farPlane)};
}

Matrices perspective(const Frame& frame, double horizontalFov, double aspect, double nearPlane, double farPlane) {
    return assemble(frame, projectionMatrix(horizontalFov, aspect, nearPlane, farPlane), horizontalFov, nearPlane, farPlane);
}

struct Planes {
    double nearPlane;
    double farPlane;
};

/// Around a sphere whose centre lies `depth` in front of the eye. Inside or behind the eye the near plane becomes a small share of the far
/// plane.
Planes fitPlanes(double depth, double radius) {
    const double margin = std::max(radius * (1 + kPlaneMargin), std::abs(depth) * kPlaneMargin);
    double farPlane = depth + margin;
    if (!(farPlane > 0)) farPlane = std::max(margin, 1e-3); // the mesh is behind the eye: nothing is drawn, but the matrix stays regular
    return {std::max(depth - margin, farPlane * kLeastNearShare), farPlane};
}

/// The eye stands on the near plane, which touches the sphere, as the far plane does.
Matrices parallelLight(const Light& light, const glm::dvec3& centre, double radius) {
    const double reach = std::max(radius, 1e-6); // a mesh that is one point
    const glm::dvec3 direction = glm::normalize(glm::dvec3(*light.direction));
    const double half = light.width ? 0.5 * static_cast<double>(*light.width) : reach;
    const Frame frame = lookAt(centre - reach * direction, centre, glm::dvec3(0, 1, 0));
    return assemble(frame, parallelMatrix(half, 0, 2 * reach), 0, 0, 2 * reach);
}

} // namespace

Matrices cameraMatrices(const Camera& camera, double aspect) {
    assert(camera.nearPlane && camera.farPlane && aspect > 0);
    const Frame frame = lookAt(glm::dvec3(camera.position), glm::dvec3(camera.target), glm::dvec3(camera.up));
    return perspective(frame, glm::radians(static_cast<double>(camera.horizontalFov)), aspect, static_cast<double>(*camera.nearPlane),
                       static_cast<double>(*camera.farPlane));
}

Matrices lightMatrices(const Light& light, const Bounds& bounds) {
    const glm::dvec3 position(light.position);
    const glm::dvec3 centre(bounds.centre);
    const double radius = static_cast<double>(bounds.radius) * (1 + kPlaneMargin);
    if (light.direction) return parallelLight(light, centre, radius);
    const double distance = glm::distance(position, centre);
    const double fitted = distance > radius ? 2 * std::asin(radius / distance) : kWidestLightCone;
    const double cone = light.fov ? glm::radians(static_cast<double>(*light.fov)) : fitted;
    const Planes planes = fitPlanes(distance, static_cast<double>(bounds.radius));
    // A cone of no width (a mesh that is one point) has no projection: half a minute of arc is narrower than any real one.
    const double fov = std::clamp(cone, 1e-4, kWidestLightCone);
    return perspective(lookAt(position, centre, glm::dvec3(0, 1, 0)), fov, 1, planes.nearPlane, planes.farPlane);
}

PlacedScene seenFrom(const PlacedScene& scene, const Placement& placement) {
    Placement rigid = placement;
    rigid.scale = glm::vec3(1);
    if (rigid == Placement{}) return scene;
    const glm::dmat4 back = glm::inverse(worldMatrix(rigid));
    const auto moved = [&](glm::vec3& point) { point = glm::vec3(transformPoint(back, glm::dvec3(point))); };
    PlacedScene result = scene;
    moved(result.camera.position);
    moved(result.camera.target);
    moved(result.light.position);
    result.camera.up = glm::vec3(glm::dmat3(back) * glm::dvec3(scene.camera.up));
    if (scene.light.direction) result.light.direction = glm::vec3(glm::dmat3(back) * glm::dvec3(*scene.light.direction));
    return result;
}

PlacedScene inUnit(const PlacedScene& scene, float factor) {
    PlacedScene result = scene;
    for (glm::vec3* point : {&result.camera.position, &result.camera.target, &result.light.position})
        *point *= factor;
    for (std::optional<float>* length : {&result.camera.nearPlane, &result.camera.farPlane, &result.light.width})
        if (*length) **length *= factor;
    return result;
}

Bounds inUnit(const Bounds& bounds, float factor) {
    return {.minimum = factor * bounds.minimum,
            .maximum = factor * bounds.maximum,
            .centre = factor * bounds.centre,
            .radius = factor * bounds.radius};
}

PlacedScene placeScene(const Workspace& workspace, const Bounds& bounds) {
    PlacedScene scene{.camera = workspace.camera, .light = workspace.light};
    const float unit = bounds.radius > 0 ? bounds.radius : 1;
    if (workspace.cameraRelative) {
        scene.camera.position = bounds.centre + unit * scene.camera.position;
        scene.camera.target = bounds.centre + unit * scene.camera.target;
    }
    if (workspace.lightRelative) {
        scene.light.position = bounds.centre + unit * scene.light.position;
        if (scene.light.width) *scene.light.width *= unit;
    }

    const Camera& camera = scene.camera;
    const Frame frame = lookAt(glm::dvec3(camera.position), glm::dvec3(camera.target), glm::dvec3(camera.up));
    const double depth = glm::dot(glm::dvec3(bounds.centre) - frame.eye, -frame.back);
    const Planes planes = fitPlanes(depth, static_cast<double>(bounds.radius));
    if (!scene.camera.nearPlane) scene.camera.nearPlane = static_cast<float>(planes.nearPlane);
    if (!scene.camera.farPlane)
        scene.camera.farPlane = std::max(static_cast<float>(planes.farPlane), std::nextafter(*scene.camera.nearPlane, INFINITY));
    return scene;
}

} // namespace tegument
