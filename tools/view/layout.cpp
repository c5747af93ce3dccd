#include "tools/view/layout.h"

#include <algorithm>
#include <cmath>

namespace tegument::view {

namespace {

constexpr float kControls = 25; // em
constexpr float kSheets = 26;
constexpr float kStrip = 11.5F;
constexpr float kColumns = 0.6F; // of the width
constexpr float kStacked = 0.4F; // of the height that is left
constexpr float kBar = 0.15F;    // likewise

float cut(float wanted, float room) {
    return std::floor(std::clamp(wanted, 0.0F, std::max(0.0F, room)));
}

} // namespace

Layout arrange(float width, float height, const Panels& panels) {
    Layout layout;
    float top = 0;
    float bottom = height;
    float left = 0;
    float right = width;
    const auto below = [&](float wanted, float share) {
        const float taken = cut(wanted, share * (bottom - top));
        bottom -= taken;
        return Area{.x = 0, .y = bottom, .width = right, .height = taken};
    };
    if (panels.frame) {
        layout.bar = {.x = 0, .y = 0, .width = width, .height = cut(kRowHeight * panels.em, kBar * height)};
        top = layout.bar.height;
        layout.status = below(kRowHeight * panels.em, kBar);
    }
    if (panels.source) {
        right = std::ceil(0.5F * width);
        layout.source = {.x = right, .y = top, .width = width - right, .height = bottom - top};
    }
    if (panels.problem > 0) layout.problem = below(panels.problem, kStacked);
    if (panels.strip) layout.strip = below(kStrip * panels.em, kStacked);
    const float room = kColumns * right;
    const bool both = (kControls + kSheets) * panels.em <= room;
    if (panels.controls && !panels.source && (both || !panels.sheets)) {
        const float taken = cut(kControls * panels.em, room);
        right -= taken;
        layout.controls = {.x = right, .y = top, .width = taken, .height = bottom - top};
    }
    if (panels.sheets) {
        left = cut(kSheets * panels.em, room);
        layout.sheets = {.x = 0, .y = top, .width = left, .height = bottom - top};
    }
    layout.picture = {.x = left, .y = top, .width = right - left, .height = bottom - top};
    return layout;
}

} // namespace tegument::view
