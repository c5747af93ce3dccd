#include "tools/view/picture_area.h"

#include <algorithm>
#include <cmath>

namespace tegument::view {

namespace {

constexpr double kWidestFov = 170; // degrees, as in workspaces

} // namespace

std::array<double, 4> PictureArea::shares() const {
    const Area& picture = layout.picture;
    const double width = std::max(1.0F, points.x);
    const double height = std::max(1.0F, points.y);
    return {picture.x / width, picture.y / height, (picture.x + picture.width) / width, (picture.y + picture.height) / height};
}

PixelSize PictureArea::pixels() const {
    const auto [left, top, right, bottom] = shares();
    const auto pixels = [](double share, std::uint32_t all) {
        return all == 0 ? 0U : std::max(1U, static_cast<std::uint32_t>(std::lround(share * all)));
    };
    return {pixels(right - left, window.width), pixels(bottom - top, window.height)};
}

glm::dvec2 PictureArea::onPicture(glm::dvec2 onWindow) const {
    const auto [left, top, right, bottom] = shares();
    return {(onWindow.x - left) / std::max(1e-9, right - left), (onWindow.y - top) / std::max(1e-9, bottom - top)};
}

Workspace PictureArea::seen(Workspace workspace, PixelSize picture) const {
    if (picture.width == 0 || picture.height == 0) return workspace;
    const double wider = static_cast<double>(picture.width) / picture.height / shape;
    if (wider <= 1) return workspace; // as wide, and higher
    const double half = glm::radians(0.5 * static_cast<double>(workspace.camera.horizontalFov));
    workspace.camera.horizontalFov = static_cast<float>(std::min(kWidestFov, glm::degrees(2 * std::atan(wider * std::tan(half)))));
    return workspace;
}

} // namespace tegument::view
