// The effect's text beside the picture.

#include "tools/view/panel.h"
#include "tools/view/panel_parts.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <string>

namespace tegument::view {

namespace {

constexpr ImU32 kNumber = IM_COL32(130, 130, 130, 255);
constexpr ImU32 kWrong = IM_COL32(150, 30, 25, 190);
const ImVec4 kComplaint(1.0F, 0.55F, 0.5F, 1.0F);
constexpr int kDigits = 5;
constexpr int kLinesAbove = 6; // of one that is brought into sight

void chooseFile(SourceText& source) {
    ImGui::PushItemWidth(-1);
    const std::string shown = (source.edited() ? "* " : "") + source.file.filename().string();
    if (ImGui::BeginCombo("##file", shown.c_str())) {
        for (const auto& file : std::vector<std::filesystem::path>(source.files))
            if (ImGui::Selectable(file.string().c_str(), file == source.file)) {
                if (source.edited())
                    source.problem = "not written yet: Ctrl+S, or Ctrl+Z as often as it takes";
                else
                    openSource(source, file);
            }
        ImGui::EndCombo();
    }
    ImGui::PopItemWidth();
}

/// Numbers of the lines that are seen, and what is wrong with them.
void drawGutter(const SourceText& source, const ImVec2& corner, float width, int lines) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float line = ImGui::GetTextLineHeight();
    for (const SourceMark& mark : source.marks) {
        const float top = corner.y + line * static_cast<float>(mark.line - 1);
        list.AddRectFilled(ImVec2(corner.x, top), ImVec2(corner.x + width, top + line), kWrong);
    }
    const int first = std::max(0, static_cast<int>(ImGui::GetScrollY() / line));
    const int last = std::min(lines, first + static_cast<int>(ImGui::GetWindowHeight() / line) + 2);
    for (int i = first; i < last; ++i) {
        const std::string number = std::to_string(i + 1);
        const float left = corner.x + ImGui::CalcTextSize("0").x * static_cast<float>(kDigits - static_cast<int>(number.size()));
        list.AddText(ImVec2(left, corner.y + line * static_cast<float>(i)), kNumber, number.c_str());
    }
}

void drawText(SourceText& source) {
    const float line = ImGui::GetTextLineHeight();
    const int lines = 1 + static_cast<int>(std::ranges::count(source.text, '\n'));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float gutter = ImGui::CalcTextSize("0").x * (kDigits + 1);
    if (source.goTo) ImGui::SetScrollY(std::max(0.0F, line * static_cast<float>(*source.goTo - 1 - kLinesAbove)));
    source.goTo.reset();
    const float width = ImGui::GetContentRegionAvail().x;
    drawGutter(source, corner, width, lines);
    ImGui::SetCursorScreenPos(ImVec2(corner.x + gutter, corner.y));
    ImGui::PushStyleColor(ImGuiCol_FrameBg, ImVec4(0, 0, 0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, 0));
    const std::string before = source.text;
    ImGui::InputTextMultiline("##text", &source.text, ImVec2(width - gutter, line * static_cast<float>(lines + 1)),
                              ImGuiInputTextFlags_AllowTabInput);
    noteItem("source/text");
    // Dear ImGui takes back what was typed when Esc leaves the text.
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) source.text = before;
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

} // namespace

void drawSource(SourceText& source, const Area& area) {
    const FixedPanel panel("source", area, ImGuiWindowFlags_NoScrollbar);
    if (!panel) return;
    chooseFile(source);
    if (!source.problem.empty()) {
        ImGui::PushTextWrapPos(0);
        ImGui::TextColored(kComplaint, "%s", source.problem.c_str());
        ImGui::PopTextWrapPos();
    }
    for (const SourceMark& mark : source.marks) {
        ImGui::PushTextWrapPos(0);
        ImGui::TextColored(kComplaint, "%d: %s", mark.line, mark.text.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::BeginChild("lines", ImVec2(0, 0), false, ImGuiWindowFlags_HorizontalScrollbar);
    drawText(source);
    ImGui::EndChild();
}

} // namespace tegument::view
