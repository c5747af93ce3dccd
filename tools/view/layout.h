#pragma once
// Where the panels stand in the window: none covers another, and none the picture. Needs no window.

namespace tegument::view {

/// Of the window, from its left top corner.
struct Area {
    float x = 0;
    float y = 0;
    float width = 0;
    float height = 0;
    bool operator==(const Area&) const = default;
};

/// What is to be shown.
struct Panels {
    float em = 14;      // height of a letter's box
    bool frame = false; // menus above, the line of state below
    bool controls = false;
    bool sheets = false; // keys, values, times, textures ...
    bool strip = false;  // targets as small pictures
    bool source = false; // the effect's text
    float problem = 0;   // height of its text
};

/// Of each panel; without width and height: it is not shown.
struct Layout {
    Area bar;
    Area controls;
    Area sheets;
    Area strip;
    Area problem;
    Area status;
    Area source;
    Area picture; // the rest: at least two fifths of the width beside the source, and more than a sixth of the height
    bool operator==(const Layout&) const = default;
};

inline constexpr float kRowHeight = 1.6F; // em: a line with its frame

/// Controls to the right, sheets to the left; in a window too narrow for both the sheets alone, and beside the source no controls. What has
/// no room is cut: panels scroll.
[[nodiscard]] Layout arrange(float width, float height, const Panels& panels);

} // namespace tegument::view
