// The border between what was kept and the picture.

#include "tools/view/panel.h"

#include <imgui.h>

#include <algorithm>

namespace tegument::view {

namespace {

constexpr ImU32 kLine = IM_COL32(255, 255, 255, 220);
constexpr ImU32 kBehind = IM_COL32(15, 15, 15, 190);
constexpr ImU32 kLetters = IM_COL32(255, 255, 255, 255);

} // namespace

void drawBorder(double border, const BesideText& text, const Area& picture) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float margin = 0.5F * ImGui::GetFontSize();
    const float room = std::max(1.0F, picture.width - 2 * margin);
    float bottom = picture.y + picture.height - margin;
    // Beginning at x, or ending there, in as many lines as it takes; what comes next stands above it.
    const auto label = [&](const std::string& words, float x, bool endsThere) {
        const ImVec2 size = ImGui::CalcTextSize(words.c_str(), nullptr, false, room);
        const float least = picture.x + margin;
        const float left = std::clamp(endsThere ? x - size.x : x, least, std::max(least, least + room - size.x));
        list.AddRectFilled(ImVec2(left - 3, bottom - size.y - 1), ImVec2(left + size.x + 3, bottom + 1), kBehind);
        list.AddText(nullptr, 0, ImVec2(left, bottom - size.y), kLetters, words.c_str(), nullptr, room);
        bottom -= size.y + 0.3F * ImGui::GetFontSize();
    };
    label(text.error, picture.x, false);
    if (text.colours) {
        label("error of " + text.right + " against " + text.left, picture.x, false);
        label("black: a thousandth of the mean, red: all of it", picture.x, false);
        return;
    }
    const float x = picture.x + static_cast<float>(border) * picture.width;
    label(text.left, x - margin, true);
    label(text.right, x + margin, false);
    list.AddLine(ImVec2(x, picture.y), ImVec2(x, picture.y + picture.height), kLine, 1);
}

} // namespace tegument::view
