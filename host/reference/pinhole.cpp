#include "host/reference/pinhole.h"

#include <cmath>

namespace tegument::reference {

glm::dvec3 Pinhole::ray(int x, int y) const {
    const double across = 2 * (x + 0.5) / width - 1;
    const double down = 2 * (y + 0.5) / height - 1;
    return glm::normalize(forward + across * tangentX * right - down * tangentY * up);
}

glm::dvec2 Pinhole::project(const glm::dvec3& point) const {
    const glm::dvec3 offset = point - eye;
    const double distance = glm::dot(offset, forward);
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
    const double angle = 2 * std::asin(radius * kEnlarged / glm::length(centre - eye));
    return pinhole(eye, centre, {0, 1, 0}, angle, size, size);
}

} // namespace tegument::reference
