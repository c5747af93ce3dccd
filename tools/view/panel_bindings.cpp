// What each parameter of another host's effect got, and a list of what it may get instead.

#include "tools/view/panel.h"
#include "tools/view/panel_parts.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr const char* kAsFound = "as found";
constexpr float kChoiceLetters = 26; // "WORLDVIEWPROJECTIONINVERSE"

struct BindingColumns {
    float name = 0;
    float choice = 0;
    float rule = 0;
};

BindingColumns columnsOf(const std::vector<ParameterBinding>& bindings) {
    BindingColumns columns{.name = 0, .choice = kChoiceLetters * ImGui::CalcTextSize("W").x, .rule = 0};
    for (const ParameterBinding& binding : bindings) {
        columns.name = std::max(columns.name, ImGui::CalcTextSize(binding.parameter.c_str()).x);
        columns.choice = std::max(columns.choice, ImGui::CalcTextSize(binding.source.c_str()).x + 2 * ImGui::GetFrameHeight());
        columns.rule = std::max(columns.rule, ImGui::CalcTextSize(binding.rule.c_str()).x);
    }
    return columns;
}

/// What was chosen; an empty rule: what the effect's own words say.
std::optional<BindingChoice> chooseBinding(const ParameterBinding& binding, const Parameter& parameter, bool bound) {
    std::optional<BindingChoice> chosen;
    const std::string label = "##bind " + binding.parameter;
    if (!ImGui::BeginCombo(label.c_str(), binding.source.c_str())) return chosen;
    if (ImGui::Selectable(kAsFound, !bound)) chosen = {binding.parameter, {}};
    for (const std::string& choice : bindChoices(parameter))
        if (ImGui::Selectable(choice.c_str(), bound && choice == binding.source)) chosen = {binding.parameter, choice};
    ImGui::EndCombo();
    return chosen;
}

} // namespace

PanelSize bindingsSize(const std::vector<ParameterBinding>& bindings) {
    const BindingColumns columns = columnsOf(bindings);
    const ImGuiStyle& style = ImGui::GetStyle();
    const float height = static_cast<float>(bindings.size() + 1) * ImGui::GetFrameHeightWithSpacing() + 2 * style.WindowPadding.y;
    return {.width =
                columns.name + columns.choice + columns.rule + 2 * style.ItemSpacing.x + 2 * style.WindowPadding.x + style.ScrollbarSize,
            .height = [height](float) { return height; }};
}

std::optional<BindingChoice> drawBindings(const std::vector<ParameterBinding>& bindings, const Effect& effect,
                                          const std::map<std::string, std::string>& binds, const Area& area) {
    std::optional<BindingChoice> chosen;
    if (area.width <= 0 || area.height <= 0) return chosen;
    const BindingColumns columns = columnsOf(bindings);
    placePanel(area);
    ImGui::Begin("bindings", nullptr, kFixedPanel | ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::TextUnformatted("what each parameter got, by which rule");
    const float left = ImGui::GetCursorPosX();
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    for (const ParameterBinding& binding : bindings) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(binding.parameter.c_str());
        ImGui::SameLine(left + columns.name + gap);
        const Parameter* parameter = effect.findParameter(binding.parameter);
        ImGui::SetNextItemWidth(columns.choice);
        if (parameter && !bindChoices(*parameter).empty()) {
            if (auto choice = chooseBinding(binding, *parameter, binds.contains(binding.parameter))) chosen = std::move(choice);
        } else {
            ImGui::TextUnformatted(binding.source.c_str());
        }
        ImGui::SameLine(left + columns.name + columns.choice + 2 * gap);
        ImGui::TextUnformatted(binding.rule.c_str());
    }
    ImGui::End();
    return chosen;
}

} // namespace tegument::view
