#include "lab/reference/pinhole.h"

#include <algorithm>
#include <cmath>

namespace tegument::reference {

namespace {

constexpr double kWidest = glm::radians(160.0);

} // namespace

glm::dvec3 Pinhole::ray(int x, int y) const {
    return parallel ? forward : glm::normalize(forward + aside(x, y));
}

glm::dvec3 Pinhole::start(int x, int y) const {
    return parallel ? eye + aside(x, y) : eye;
}

glm::dvec3 Pinhole::aside(int x, int y) const {
    const double across = 2 * (x + 0.5) / width - 1;
    const double down = 2 * (y + 0.5) / height - 1;
    return across * tangentX * right - down * tangentY * up;
}

glm::dvec3 Pinhole::origin(const glm::dvec3& point) const {
    return parallel ? point - forward * glm::dot(point - eye, forward) : eye;
}

bool Pinhole::shows(const glm::dvec3& point, double margin) const {
    if (glm::dot(point - eye, forward) <= 0) return false;
    const glm::dvec2 place = project(point) * glm::dvec2(width, height);
    return place.x >= -margin && place.y >= -margin && place.x <= width + margin && place.y <= height + margin;
}

glm::dvec2 Pinhole::project(const glm::dvec3& point) const {
    const glm::dvec3 offset = point - eye;
    const double distance = parallel ? 1 : glm::dot(offset, forward);
    return {0.5 + 0.5 * glm::dot(offset, right) / (distance * tangentX), 0.5 - 0.5 * glm::dot(offset, up) / (distance * tangentY)};
}

glm::dvec3 Pinhole::onGrid(const glm::dvec3& point, double grid) const {
    const glm::dvec2 size(width, height);
    const glm::dvec2 place = grid * glm::floor(project(point) * size / grid + 0.5) / size;
    const double distance = glm::dot(point - eye, forward);
    return eye + distance * (forward + (2 * place.x - 1) * tangentX * right - (2 * place.y - 1) * tangentY * up);
}

Pinhole pinhole(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up, double horizontalFov, int width, int height) {
    Pinhole view{.eye = eye, .width = width, .height = height};
    view.forward = glm::normalize(target - eye);
    view.right = glm::normalize(glm::cross(view.forward, up));
    view.up = glm::cross(view.right, view.forward);
    view.tangentX = std::tan(horizontalFov / 2);
    view.tangentY = view.tangentX * height / width;
    return view;
}

Pinhole lightPyramid(const glm::dvec3& eye, const glm::dvec3& centre, double radius, int size) {
    constexpr double kEnlarged = 1.001;
    const double angle = std::min(2 * std::asin(std::min(radius * kEnlarged / glm::length(centre - eye), 1.0)), kWidest);
    return pinhole(eye, centre, {0, 1, 0}, angle, size, size);
}

Pinhole lightView(const Light& light, const Bounds& bounds, int size) {
    const glm::dvec3 centre(bounds.centre);
    const auto radius = static_cast<double>(bounds.radius);
    if (light.direction) {
        Pinhole view = lightBox(glm::dvec3(*light.direction), centre, radius, size);
        if (light.width) view.tangentX = view.tangentY = static_cast<double>(*light.width) / 2;
        return view;
    }
    const glm::dvec3 eye(light.position);
    if (light.fov) return pinhole(eye, centre, {0, 1, 0}, glm::radians(static_cast<double>(*light.fov)), size, size);
    return lightPyramid(eye, centre, radius, size);
}

Pinhole lightBox(const glm::dvec3& direction, const glm::dvec3& centre, double radius, int size) {
    constexpr double kEnlarged = 1.001;
    const double half = radius * kEnlarged;
    Pinhole view = pinhole(centre - half * glm::normalize(direction), centre, {0, 1, 0}, 1, size, size);
    view.tangentX = half;
    view.tangentY = half;
    view.parallel = true;
    return view;
}

} // namespace tegument::reference
