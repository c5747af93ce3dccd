#include "tools/view/orbit.h"

#include <algorithm>
#include <cmath>

namespace tegument::view {

namespace {

constexpr double kHalfPi = 1.57079632679489661923;
constexpr double kPoleMargin = 0.02; // radians; at the pole itself the picture would spin
constexpr double kNearest = 1e-3;    // mm; nearer than that nothing is seen
constexpr double kFarthest = 1e6;    // mm; a kilometre

/// Rodrigues' formula; `axis` of length 1.
glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) + axis * glm::dot(axis, v) * (1 - std::cos(angle));
}

glm::vec3 single(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

double scaledDistance(double distance, double factor) {
    return std::clamp(distance * factor, kNearest, kFarthest);
}

} // namespace

Axes axesOf(const Camera& camera) {
    const glm::dvec3 back = glm::normalize(glm::dvec3(camera.position) - glm::dvec3(camera.target));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(camera.up), back));
    return {.right = right, .up = glm::cross(back, right), .back = back};
}

void orbit(Camera& camera, double right, double up) {
    const glm::dvec3 pole = glm::normalize(glm::dvec3(camera.up));
    const glm::dvec3 target(camera.target);
    const glm::dvec3 arm = rotated(glm::dvec3(camera.position) - target, pole, right);
    const double elevation = std::asin(std::clamp(glm::dot(glm::normalize(arm), pole), -1.0, 1.0));
    const double limit = kHalfPi - kPoleMargin;
    const double rise = std::clamp(elevation + up, -limit, limit) - elevation;
    const glm::dvec3 axis = glm::normalize(glm::cross(arm, pole)); // from the arm towards the pole
    camera.position = single(target + rotated(arm, axis, rise));
}

void pan(Camera& camera, double right, double up) {
    const Axes axes = axesOf(camera);
    const double distance = glm::length(glm::dvec3(camera.position) - glm::dvec3(camera.target));
    const double width = 2 * distance * std::tan(0.5 * glm::radians(static_cast<double>(camera.horizontalFov)));
    const glm::dvec3 move = width * (right * axes.right + up * axes.up);
    camera.position = single(glm::dvec3(camera.position) + move);
    camera.target = single(glm::dvec3(camera.target) + move);
}

void dolly(Camera& camera, double factor) {
    const glm::dvec3 target(camera.target);
    const glm::dvec3 arm = glm::dvec3(camera.position) - target;
    const double distance = glm::length(arm);
    camera.position = single(target + arm * (scaledDistance(distance, factor) / distance));
}

void orbitLight(Light& light, const Camera& camera, double right, double up) {
    const Axes axes = axesOf(camera);
    if (light.direction) {
        const glm::dvec3 aside = rotated(glm::dvec3(*light.direction), axes.up, right);
        light.direction = single(rotated(aside, axes.right, -up));
        return;
    }
    const glm::dvec3 target(camera.target);
    const glm::dvec3 turned = rotated(glm::dvec3(light.position) - target, axes.up, right);
    light.position = single(target + rotated(turned, axes.right, -up));
}

void dollyLight(Light& light, const Camera& camera, double factor) {
    const glm::dvec3 target(camera.target);
    const glm::dvec3 arm = glm::dvec3(light.position) - target;
    const double distance = glm::length(arm);
    if (distance > 0) light.position = single(target + arm * (scaledDistance(distance, factor) / distance));
}

} // namespace tegument::view
