// The border between what was kept and the picture.

#include "tools/view/panel.h"

#include <imgui.h>

#include <algorithm>

namespace tegument::view {

namespace {

constexpr ImU32 kLine = IM_COL32(255, 255, 255, 220);
constexpr ImU32 kBehind = IM_COL32(15, 15, 15, 190);
constexpr ImU32 kLetters = IM_COL32(255, 255, 255, 255);

/// From `least` to `most`, where a label may stand.
struct Span {
    float least = 0;
    float most = 0;
    [[nodiscard]] float width() const { return std::max(1.0F, most - least); }
};

float heightOf(const std::string& text, const Span& span) {
    return ImGui::CalcTextSize(text.c_str(), nullptr, false, span.width()).y;
}

/// With its right or left end at x, and its lower one at `bottom`; of several lines where there is no room for one.
void label(const std::string& text, float x, float bottom, bool endsThere, const Span& span) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, span.width());
    const float left = std::clamp(endsThere ? x - size.x : x, span.least, std::max(span.least, span.most - size.x));
    const float top = bottom - size.y;
    list.AddRectFilled(ImVec2(left - 3, top - 1), ImVec2(left + size.x + 3, bottom + 1), kBehind);
    list.AddText(nullptr, 0, ImVec2(left, top), kLetters, text.c_str(), nullptr, span.width());
}

} // namespace

void drawBorder(double border, const BesideText& text, const Area& picture) {
    const float margin = 0.5F * ImGui::GetFontSize();
    float bottom = picture.y + picture.height - margin;
    const Span all{.least = picture.x + 3, .most = picture.x + picture.width - 3};
    const float x = picture.x + static_cast<float>(border) * picture.width;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    label(text.error, all.least + margin, bottom, false, all);
    bottom -= heightOf(text.error, all) + 0.4F * line;
    if (text.colours) {
        const std::string what = "error of " + text.right + " against " + text.left;
        label(what, all.least + margin, bottom, false, all);
        label("black: a thousandth of the mean, red: all of it", all.least + margin, bottom - heightOf(what, all) - 0.4F * line, false,
              all);
        return;
    }
    label(text.left, x - margin, bottom, true, all);
    const float needs = x + 2 * margin + ImGui::CalcTextSize(text.right.c_str()).x;
    // Above the other's name where there is no room.
    label(text.right, x + margin, needs > all.most ? bottom - heightOf(text.left, all) - 0.4F * line : bottom, false, all);
    ImGui::GetBackgroundDrawList()->AddLine(ImVec2(x, picture.y), ImVec2(x, picture.y + picture.height), kLine, 1);
}

} // namespace tegument::view
