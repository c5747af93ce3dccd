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

/// Those that are to be shown.
struct PanelSizes {
    std::optional<PanelSize> lines;
    std::optional<PanelSize> help;
    std::optional<PanelSize> sliders;
    std::optional<PanelSize> problem;
    std::optional<PanelSize> strip;
    std::optional<PanelSize> histogram;
    std::optional<PanelSize> times;
    bool linesTakeRoom = false; // they are more than a note on the picture
};

/// Pixels that panels take from the picture at the sides of the window.
struct Dock {
    float left = 0;
    float right = 0;
    float bottom = 0;
    bool operator==(const Dock&) const = default;
};

struct PanelAreas {
    std::optional<Area> lines;
    std::optional<Area> help;
    std::optional<Area> sliders;
    std::optional<Area> problem;
    std::optional<Area> strip;
    std::optional<Area> histogram;
    std::optional<Area> times;
    Dock dock; // nothing at a side where the picture would be left with less than two fifths of the window
};

inline constexpr float kPanelMargin = 8;

/// The problem at the bottom and the strip above it, the sliders to the right, times of passes and the histogram below them, the lines to
/// the left and the help below them. What has no room is cut: panels scroll. Lines and the problem lie on the picture.
[[nodiscard]] PanelAreas arrange(float width, float height, const PanelSizes& sizes);

} // namespace tegument::view
