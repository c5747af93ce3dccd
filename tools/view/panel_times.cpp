// Times of passes: a row for each.

#include "tools/view/panel.h"
#include "tools/view/panel_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::view {

namespace {

const ImVec4 kPassKept(0.72F, 0.72F, 0.72F, 1.0F);

/// Neighbours differ by the golden section of the circle of hues.
ImU32 colorOfPass(std::size_t index) {
    constexpr double kGolden = 0.61803398875;
    const auto hue = static_cast<float>(std::fmod(0.58 + kGolden * static_cast<double>(index), 1.0));
    return ImColor::HSV(hue, index % 2 == 0 ? 0.62F : 0.45F, 0.92F);
}

std::string nameOf(const PassTime& pass) {
    return pass.runs > 1 ? fmt::format("{} x {}", pass.name, pass.runs) : pass.name;
}

/// Its colour, its name, its time, and that as a bar of the longest pass.
void drawRow(const PassTime& pass, std::size_t index, double longest) {
    const float width = ImGui::GetContentRegionAvail().x;
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float numbers = ImGui::CalcTextSize("00000.00").x;
    const auto share = static_cast<float>(pass.milliseconds / std::max(longest, 1e-9));
    ImU32 color = colorOfPass(index);
    if (pass.kept) color = (color & ~IM_COL32_A_MASK) | (IM_COL32_A_MASK & IM_COL32(0, 0, 0, 90));
    list.AddRectFilled(ImVec2(corner.x, corner.y + 0.15F * line), ImVec2(corner.x + 0.7F * line, corner.y + 0.85F * line), color);
    const float barLeft = corner.x + 0.72F * width;
    list.AddRectFilled(ImVec2(barLeft, corner.y + 0.2F * line),
                       ImVec2(barLeft + std::max(1.0F, 0.28F * width * share), corner.y + 0.8F * line), color);
    const std::string time = fmt::format("{:.2f}", pass.milliseconds);
    const float timeLeft = barLeft - 0.4F * line - ImGui::CalcTextSize(time.c_str()).x;
    const ImU32 letters = ImGui::ColorConvertFloat4ToU32(pass.kept ? kPassKept : ImVec4(1, 1, 1, 1));
    list.PushClipRect(corner, ImVec2(barLeft - 0.6F * line - numbers, corner.y + line), true);
    list.AddText(ImVec2(corner.x + line, corner.y), letters, nameOf(pass).c_str());
    list.PopClipRect();
    list.AddText(ImVec2(timeLeft, corner.y), letters, time.c_str());
    ImGui::Dummy(ImVec2(width, line));
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s: %.3f ms%s", nameOf(pass).c_str(), pass.milliseconds,
                          pass.kept ? "\nnot drawn for this frame: its targets hold what it would draw" : "");
}

std::string sumLine(const TimesOfSide& side) {
    const double drawn = side.times->drawn();
    const double all = side.times->all();
    if (std::abs(all - drawn) < 1e-9) return fmt::format("{:.2f} ms", all);
    return fmt::format("{:.2f} ms, {:.2f} with what was kept", drawn, all);
}

} // namespace

void drawTimes(const std::vector<TimesOfSide>& sides) {
    double longestPass = 0;
    for (const TimesOfSide& side : sides) { // one scale for both
        for (const PassTime& pass : side.times->passes())
            longestPass = std::max(longestPass, pass.milliseconds);
    }
    for (const TimesOfSide& side : sides) {
        if (!side.name.empty()) ImGui::TextUnformatted(side.name.c_str());
        ImGui::TextUnformatted(sumLine(side).c_str());
        for (std::size_t i = 0; i < side.times->passes().size(); ++i)
            drawRow(side.times->passes()[i], i, longestPass);
    }
}

} // namespace tegument::view
