#pragma once
// What the sources of the panels share. Includes Dear ImGui: for tools/view/panel*.cpp alone.

#include "tools/view/layout.h"
#include "tools/view/places.h"

#include <imgui.h>

#include <cctype>
#include <string>

namespace tegument::view {

inline constexpr ImGuiWindowFlags kFixedPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                                ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                                ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// A window there, until the end of the block; false: it has no room.
class FixedPanel {
public:
    FixedPanel(const char* name, const Area& area, ImGuiWindowFlags more = 0) : room_(area.width >= 1 && area.height >= 1) {
        if (!room_) return;
        ImGui::SetNextWindowPos(ImVec2(area.x, area.y), ImGuiCond_Always);
        ImGui::SetNextWindowSize(ImVec2(area.width, area.height), ImGuiCond_Always);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
        ImGui::Begin(name, nullptr, kFixedPanel | more);
        ImGui::PopStyleVar();
        notePlace(name, area);
    }
    FixedPanel(const FixedPanel&) = delete;
    FixedPanel& operator=(const FixedPanel&) = delete;
    ~FixedPanel() {
        if (room_) ImGui::End();
    }
    explicit operator bool() const { return room_; }

private:
    bool room_;
};

/// As a line of its own begins.
inline std::string capital(std::string text) {
    if (!text.empty()) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

/// Of the control that was drawn last, where it is seen.
inline void noteItem(const std::string& name) {
    if (!ImGui::IsItemVisible()) return;
    const ImVec2 from = ImGui::GetItemRectMin();
    const ImVec2 to = ImGui::GetItemRectMax();
    notePlace(name, {.x = from.x, .y = from.y, .width = to.x - from.x, .height = to.y - from.y});
}

} // namespace tegument::view
