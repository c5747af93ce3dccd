// What each parameter of another host's effect got, and a list of what it may get instead.

#include "tools/view/panel.h"
#include "tools/view/panel_parts.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr const char* kAsFound = "as found";
constexpr float kName = 0.4F; // of the width

/// What was chosen; an empty rule: what the effect's own words say.
std::optional<BindingChoice> chooseBinding(const ParameterBinding& binding, const Parameter& parameter, bool bound) {
    std::optional<BindingChoice> chosen;
    const std::string label = "##bind " + binding.parameter;
    const bool open = ImGui::BeginCombo(label.c_str(), binding.source.c_str());
    noteItem("bind/" + binding.parameter);
    if (!open) return chosen;
    if (ImGui::Selectable(kAsFound, !bound)) chosen = {binding.parameter, {}};
    for (const std::string& choice : bindChoices(parameter)) {
        if (ImGui::Selectable(choice.c_str(), bound && choice == binding.source)) chosen = {binding.parameter, choice};
        noteItem("bind/" + binding.parameter + "=" + choice);
    }
    ImGui::EndCombo();
    return chosen;
}

} // namespace

std::optional<BindingChoice> drawBindings(const std::vector<ParameterBinding>& bindings, const Effect& effect,
                                          const std::map<std::string, std::string>& binds) {
    std::optional<BindingChoice> chosen;
    const float column = kName * ImGui::GetContentRegionAvail().x;
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted("what each parameter got, by which rule");
    for (const ParameterBinding& binding : bindings) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(binding.parameter.c_str());
        ImGui::SameLine(column);
        const Parameter* parameter = effect.findParameter(binding.parameter);
        ImGui::SetNextItemWidth(-1);
        if (parameter && !bindChoices(*parameter).empty()) {
            if (auto choice = chooseBinding(binding, *parameter, binds.contains(binding.parameter))) chosen = std::move(choice);
        } else {
            ImGui::TextUnformatted(binding.source.c_str());
        }
        ImGui::TextDisabled("    %s", binding.rule.c_str());
    }
    ImGui::PopTextWrapPos();
    return chosen;
}

} // namespace tegument::view
