// Menus, whose items show their keys, the dialog for files, and the sheet of keys.

#include "tools/view/panel.h"
#include "tools/view/panel_parts.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <string_view>

namespace tegument::view {

namespace {

constexpr float kDialogWidth = 36; // em
constexpr float kDialogHeight = 28;
const ImVec4 kWarning(1.0F, 0.55F, 0.5F, 1.0F);

void drawGroup(ViewState& state, std::string_view group, PanelOutcome& outcome) {
    for (const KeyBinding& key : keyBindings()) {
        if (key.group != group) continue;
        const bool* on = switchOf(state, key.command);
        if (ImGui::MenuItem(capital(key.text).c_str(), key.label, on && *on)) outcome.command = key.command;
        noteItem(std::string("menu/") + key.label);
    }
}

bool beginMenu(const char* name) {
    const bool open = ImGui::BeginMenu(name);
    noteItem(std::string("menu/") + name);
    return open;
}

} // namespace

void drawMenus(ViewState& state, PanelMemory& memory, const PanelScene& scene, PanelOutcome& outcome) {
    const FixedPanel bar("menus", scene.layout.bar, ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoScrollbar);
    if (!bar || !ImGui::BeginMenuBar()) return;
    if (beginMenu("File")) {
        const auto dialog = [&](FileUse use, const char* name, const std::filesystem::path& near) {
            if (ImGui::MenuItem(name)) memory.dialog.open(use, near);
            noteItem(std::string("menu/") + name);
        };
        const std::filesystem::path& workspace = scene.request.workspace.file;
        dialog(FileUse::Mesh, "Open mesh ...", (workspace.parent_path() / scene.request.workspace.meshPath).parent_path());
        dialog(FileUse::Effect, "Open effect ...", scene.request.effect.parent_path());
        dialog(FileUse::Workspace, "Open workspace ...", workspace.parent_path());
        dialog(FileUse::Environment, "Open surroundings ...", {});
        ImGui::Separator();
        dialog(FileUse::SavePicture, "Save picture as ...", scene.request.pictures);
        dialog(FileUse::SaveWorkspace, "Save workspace as ...", scene.request.pictures);
        ImGui::Separator();
        drawGroup(state, "File", outcome);
        ImGui::EndMenu();
    }
    if (beginMenu("View")) {
        for (const char* group : {"Picture", "Camera", "Compare"})
            if (beginMenu(group)) {
                drawGroup(state, group, outcome);
                ImGui::EndMenu();
            }
        ImGui::EndMenu();
    }
    for (const char* group : {"Panels", "Help"})
        if (beginMenu(group)) {
            drawGroup(state, group, outcome);
            ImGui::EndMenu();
        }
    ImGui::EndMenuBar();
}

void drawDialog(FileDialog& dialog, PanelOutcome& outcome) {
    if (dialog.use == FileUse::None) return;
    constexpr const char* kName = "files";
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    const bool fresh = !ImGui::IsPopupOpen(kName);
    if (fresh) ImGui::OpenPopup(kName);
    const ImVec2 size(std::min(kDialogWidth * em, 0.96F * window.x), std::min(kDialogHeight * em, 0.94F * window.y));
    ImGui::SetNextWindowPos(ImVec2(0.5F * (window.x - size.x), 0.5F * (window.y - size.y)));
    ImGui::SetNextWindowSize(size);
    if (!ImGui::BeginPopupModal(kName, nullptr, kFixedPanel & ~ImGuiWindowFlags_NoBringToFrontOnFocus)) return;
    ImGui::TextUnformatted(dialog.title());
    ImGui::SameLine();
    ImGui::TextDisabled("%s", dialog.folder.string().c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", dialog.folder.string().c_str());
    bool chosen = false;
    const float below = 2 * ImGui::GetFrameHeightWithSpacing() + (dialog.problem.empty() ? 0 : ImGui::GetTextLineHeightWithSpacing());
    ImGui::BeginChild("list", ImVec2(0, -below), true);
    const auto enter = [&](const std::string& name) {
        dialog.typed = name;
        chosen = true;
    };
    if (ImGui::Selectable(".. (the folder above)")) enter("..");
    noteItem("dialog/..");
    for (const FileDialog::Entry& entry : std::vector<FileDialog::Entry>(dialog.entries)) {
        const std::string label = entry.folder ? entry.name + "/" : entry.name;
        if (ImGui::Selectable(label.c_str(), entry.name == dialog.typed, ImGuiSelectableFlags_AllowDoubleClick)) {
            dialog.typed = entry.name;
            chosen = entry.folder || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        }
        noteItem("dialog/" + entry.name);
    }
    ImGui::EndChild();
    if (!dialog.problem.empty()) ImGui::TextColored(kWarning, "%s", dialog.problem.c_str());
    if (fresh) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    chosen = ImGui::InputTextWithHint("##path", "file or folder", &dialog.typed, ImGuiInputTextFlags_EnterReturnsTrue) || chosen;
    noteItem("dialog/path");
    chosen = ImGui::Button(dialog.saves() ? "Save" : "Open") || chosen;
    noteItem("dialog/do");
    ImGui::SameLine();
    bool closed = ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    noteItem("dialog/cancel");
    ImGui::SameLine();
    if (ImGui::Checkbox("all files", &dialog.all)) dialog.list();
    noteItem("dialog/all");
    ImGui::SameLine();
    ImGui::TextDisabled("%s", dialog.filter().c_str());
    if (const auto path = chosen ? dialog.choose() : std::filesystem::path(); !path.empty()) {
        if (dialog.saves())
            outcome.saved = path;
        else if (dialog.use == FileUse::Environment)
            outcome.asked = {.file = {}, .sets = {"TEGUMENT_SURROUNDINGS=1", "gEnvironmentMap=" + path.string()}};
        else
            outcome.asked = {.file = path, .sets = {}};
        closed = true;
    }
    if (closed) {
        dialog.use = FileUse::None;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

} // namespace tegument::view
