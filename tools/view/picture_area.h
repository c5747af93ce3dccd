#pragma once
// Where the picture stands in the window, and how much of the scene it then shows. Needs no window.

#include "host/scene/workspace.h"
#include "tools/view/layout.h"
#include "tools/view/window.h"

#include <array>

namespace tegument::view {

struct PictureArea {
    PixelSize window;    // pixels
    glm::vec2 points{1}; // the window in the units of `layout`, which some screens have larger than pixels
    Layout layout;
    double shape = 1; // width over height of the picture that the workspace's field of view is meant for

    /// Shares of the window: left, top, right, bottom.
    [[nodiscard]] std::array<double, 4> shares() const;
    [[nodiscard]] PixelSize pixels() const;
    /// Share of the picture, from its left top, of a share of the window.
    [[nodiscard]] glm::dvec2 onPicture(glm::dvec2 onWindow) const;
    /// With a field of view that shows as much of the scene in a picture of this size, in width and in height.
    [[nodiscard]] Workspace seen(Workspace workspace, PixelSize picture) const;
};

} // namespace tegument::view
