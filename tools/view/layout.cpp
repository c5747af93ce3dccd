#include "tools/view/layout.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr float kWidestSliders = 0.6F;          // of the window, where something stands beside them
constexpr float kTallestProblem = 0.4F;         // of the window
constexpr float kTallestStrip = 0.4F;           // of the window
constexpr float kAboveStrip = 3 * kPanelMargin; // what stands above it keeps its margins
constexpr float kTallestLines = 0.5F;           // of what is above the problem, where the help stands below them

constexpr float kLeastPicture = 0.4F; // of the window

Dock dockOf(const PanelAreas& areas, bool linesTakeRoom, float width, float height) {
    Dock dock;
    if (areas.strip && areas.strip->y - kPanelMargin >= kLeastPicture * height) dock.bottom = height - areas.strip->y + kPanelMargin;
    float left = areas.help ? areas.help->x + areas.help->width + kPanelMargin : 0;
    if (areas.lines && (areas.help || linesTakeRoom)) left = std::max(left, areas.lines->x + areas.lines->width + kPanelMargin);
    float right = 0;
    for (const auto& area : {areas.sliders, areas.times, areas.histogram})
        if (area) right = std::max(right, width - area->x + kPanelMargin);
    const float room = (1 - kLeastPicture) * width;
    dock.right = right <= room ? right : 0;
    dock.left = left + dock.right <= room ? left : 0;
    return dock;
}

/// At most as large as the room, which may be none.
Area fitted(const PanelSize& size, float x, float y, float width, float height) {
    const float across = std::clamp(size.width, 0.0F, std::max(0.0F, width));
    return {.x = x, .y = y, .width = across, .height = std::clamp(size.height(across), 0.0F, std::max(0.0F, height))};
}

} // namespace

PanelAreas arrange(float width, float height, const PanelSizes& sizes) {
    const float across = width - 2 * kPanelMargin;
    float bottom = height - kPanelMargin;
    PanelAreas areas;
    if (sizes.problem) {
        Area area = fitted(*sizes.problem, kPanelMargin, 0, across, kTallestProblem * height);
        area.y = bottom - area.height;
        bottom = area.y - kPanelMargin;
        areas.problem = area;
    }
    if (sizes.strip) {
        Area area = fitted(*sizes.strip, kPanelMargin, 0, across, std::min(kTallestStrip * height, bottom - kAboveStrip));
        area.y = bottom - area.height;
        bottom = area.y - kPanelMargin;
        areas.strip = area;
    }
    float right = width - kPanelMargin;
    float under = bottom; // of the sliders
    if (sizes.histogram) {
        Area area = fitted(*sizes.histogram, 0, 0, kWidestSliders * across, kTallestLines * (bottom - kPanelMargin));
        area.x = right - area.width;
        area.y = bottom - area.height;
        under = area.y - kPanelMargin;
        areas.histogram = area;
    }
    if (sizes.times) {
        const float share = sizes.sliders ? kTallestLines : 1;
        Area area = fitted(*sizes.times, 0, 0, kWidestSliders * across, share * (under - kPanelMargin));
        area.x = right - area.width;
        area.y = under - area.height;
        under = area.y - kPanelMargin;
        areas.times = area;
    }
    if (sizes.sliders) {
        const bool alone = !sizes.lines && !sizes.help && !sizes.histogram && !sizes.times;
        Area area = fitted(*sizes.sliders, 0, kPanelMargin, alone ? across : kWidestSliders * across, under - kPanelMargin);
        area.x = right - area.width;
        areas.sliders = area;
    }
    for (const auto& beside : {areas.sliders, areas.histogram, areas.times})
        if (beside) right = std::min(right, beside->x - kPanelMargin);
    float top = kPanelMargin;
    if (sizes.lines) {
        const float room = (sizes.help ? kTallestLines : 1) * (bottom - top);
        areas.lines = fitted(*sizes.lines, kPanelMargin, top, right - kPanelMargin, room);
        top += areas.lines->height + kPanelMargin;
    }
    if (sizes.help) areas.help = fitted(*sizes.help, kPanelMargin, top, right - kPanelMargin, bottom - top);
    areas.dock = dockOf(areas, sizes.linesTakeRoom, width, height);
    return areas;
}

} // namespace tegument::view
