#pragma once
// Where the panels stand on the window: none covers another, and none the picture where both have room. Needs no window.

#include <functional>
#include <optional>

namespace tegument::view {

/// Pixels of the window, from its left top corner.
struct Area {
    float x = 0;
    float y = 0;
    float width = 0;
    float height = 0;
};

/// What a panel would take: its width, and its height at a width.
struct PanelSize {
    float width = 0;
    std::function<float(float width)> height;
};

/// Of each panel that is to be shown.
template <class Property>
struct Panels {
    std::optional<Property> lines;
    std::optional<Property> help;
    std::optional<Property> sliders;
    std::optional<Property> problem;
    std::optional<Property> strip;
    std::optional<Property> histogram;
    std::optional<Property> times;
};

struct PanelSizes : Panels<PanelSize> {
    bool linesTakeRoom = false; // they are more than a note on the picture
};

/// Pixels that panels take from the picture at the sides of the window.
struct Dock {
    float left = 0;
    float right = 0;
    float bottom = 0;
    bool operator==(const Dock&) const = default;
};

struct PanelAreas : Panels<Area> {
    Dock dock; // nothing at a side where the picture would be left with less than two fifths of the window
};

inline constexpr float kPanelMargin = 8;

/// The problem at the bottom and the strip above it, the sliders to the right, times of passes and the histogram below them, the lines to
/// the left and the help below them. What has no room is cut: panels scroll. Lines and the problem lie on the picture.
[[nodiscard]] PanelAreas arrange(float width, float height, const PanelSizes& sizes);

} // namespace tegument::view
