// The border between what was kept and the picture.

#include "host/view/panel.h"

#include <imgui.h>

#include <algorithm>

namespace tegument::view {

namespace {

constexpr ImU32 kLine = IM_COL32(255, 255, 255, 220);
constexpr ImU32 kBehind = IM_COL32(15, 15, 15, 190);
constexpr ImU32 kLetters = IM_COL32(255, 255, 255, 255);

/// One line with its right or left end at x.
void label(const std::string& text, float x, float y, bool endsThere, float least, float most) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float left = std::clamp(endsThere ? x - size.x : x, least, std::max(least, most - size.x));
    list.AddRectFilled(ImVec2(left - 3, y - 1), ImVec2(left + size.x + 3, y + size.y + 1), kBehind);
    list.AddText(ImVec2(left, y), kLetters, text.c_str());
}

} // namespace

void drawBorder(double border, const BesideText& text, const Area& picture, float right, float bottom) {
    const float left = picture.x;
    const float end = picture.x + picture.width;
    const float x = left + static_cast<float>(border) * picture.width;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    label(text.error, left + kPanelMargin, bottom - line - kPanelMargin / 2, false, left, end);
    if (text.colours) {
        label("error of " + text.right + " against " + text.left, left + kPanelMargin, bottom - 2 * line - kPanelMargin / 2, false, left,
              end);
        label("black: a thousandth of the mean, red: all of it", left + kPanelMargin, bottom - 3 * line - kPanelMargin / 2, false, left,
              end);
        return;
    }
    label(text.left, x - kPanelMargin, bottom - 2 * line - kPanelMargin, true, left, end);
    const float needs = x + 2 * kPanelMargin + ImGui::CalcTextSize(text.right.c_str()).x;
    // Above the other's name where there is no room.
    label(text.right, x + kPanelMargin, bottom - (needs > right ? 3 : 2) * line - kPanelMargin, false, left, right);
    ImGui::GetBackgroundDrawList()->AddLine(ImVec2(x, picture.y), ImVec2(x, picture.y + picture.height), kLine, 1);
}

} // namespace tegument::view
