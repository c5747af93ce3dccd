#pragma once
// What the sources of the panels share. Includes Dear ImGui: for tools/view/panel*.cpp alone.

#include "tools/view/layout.h"

#include <imgui.h>

namespace tegument::view {

inline constexpr ImGuiWindowFlags kFixedPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                                ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                                ImGuiWindowFlags_NoFocusOnAppearing;

/// Of the window that begins next.
inline void placePanel(const Area& area) {
    constexpr float kOpacity = 0.75F;
    ImGui::SetNextWindowPos(ImVec2(area.x, area.y), ImGuiCond_Always);
    ImGui::SetNextWindowSize(ImVec2(area.width, area.height), ImGuiCond_Always);
    ImGui::SetNextWindowBgAlpha(kOpacity);
}

} // namespace tegument::view
