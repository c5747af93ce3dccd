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
void label(const std::string& text, float x, float y, bool endsThere, float width) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float left = std::clamp(endsThere ? x - size.x : x, 0.0F, std::max(0.0F, width - size.x));
    list.AddRectFilled(ImVec2(left - 3, y - 1), ImVec2(left + size.x + 3, y + size.y + 1), kBehind);
    list.AddText(ImVec2(left, y), kLetters, text.c_str());
}

} // namespace

void drawBorder(double border, const BesideText& text, float width, float right, float bottom) {
    const float x = static_cast<float>(border) * width;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    label(text.error, kPanelMargin, bottom - line - kPanelMargin / 2, false, width);
    if (text.colours) {
        label("error of " + text.right + " against " + text.left, kPanelMargin, bottom - 2 * line - kPanelMargin / 2, false, width);
        label("black: a thousandth of the mean, red: all of it", kPanelMargin, bottom - 3 * line - kPanelMargin / 2, false, width);
        return;
    }
    label(text.left, x - kPanelMargin, bottom - 2 * line - kPanelMargin, true, width);
    const float needs = x + 2 * kPanelMargin + ImGui::CalcTextSize(text.right.c_str()).x;
    label(text.right, x + kPanelMargin, bottom - (needs > right ? 3 : 2) * line - kPanelMargin, false, right); // above the other's name
    ImGui::GetBackgroundDrawList()->AddLine(ImVec2(x, 0), ImVec2(x, ImGui::GetIO().DisplaySize.y), kLine, 1);
}

} // namespace tegument::view
