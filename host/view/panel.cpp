#include "host/view/panel.h"

#include "host/support/text.h"
#include "host/view/keys.h"

#include <imgui.h>

#include <algorithm>

namespace tegument::view {

namespace {

constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
constexpr float kMargin = 8;
constexpr float kOpacity = 0.75F;
const ImVec4 kRed(1.0F, 0.55F, 0.5F, 1.0F);

/// A window in a corner: 0 left or top, 1 right or bottom.
void corner(float x, float y) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const ImVec2 at(kMargin + x * (size.x - 2 * kMargin), kMargin + y * (size.y - 2 * kMargin));
    ImGui::SetNextWindowPos(at, ImGuiCond_Always, ImVec2(x, y));
    ImGui::SetNextWindowBgAlpha(kOpacity);
}

void drawLines(const PanelText& text) {
    corner(0, 0);
    ImGui::Begin("shown", nullptr, kPlain);
    for (const std::string& line : text.lines)
        ImGui::TextUnformatted(line.c_str());
    if (!text.notice.empty()) ImGui::TextUnformatted(text.notice.c_str());
    ImGui::End();
}

void drawProblem(const std::string& problem) {
    corner(0, 1);
    const float width = ImGui::GetIO().DisplaySize.x - 2 * kMargin;
    ImGui::SetNextWindowSize(ImVec2(width, 0));
    ImGui::Begin("problem", nullptr, kPlain & ~ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushTextWrapPos(width - kMargin);
    ImGui::PushStyleColor(ImGuiCol_Text, kRed);
    ImGui::TextUnformatted(problem.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::End();
}

void drawHelp() {
    corner(0.5F, 0.5F);
    ImGui::Begin("help", nullptr, kPlain);
    ImGui::TextUnformatted(bindingsHelp().c_str());
    ImGui::End();
}

std::vector<double> valueOf(const ViewState& state, const Parameter& parameter) {
    for (const auto* values : {&state.parameters, &state.workspace.parameters})
        if (const auto found = values->find(parameter.name); found != values->end()) return found->second;
    const auto* numbers = parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr;
    return numbers ? *numbers : std::vector<double>();
}

double annotated(const Parameter& parameter, std::string_view name, double otherwise) {
    const auto numbers = parameter.annotations.numbers(name);
    return numbers && !numbers->empty() ? numbers->front() : otherwise;
}

bool hasSlider(const Parameter& parameter) {
    const std::string widget = toLower(parameter.annotations.string("UIWidget").value_or(""));
    return parameter.type.isNumeric() && parameter.type.scalarCount() <= 4 && parameter.defaultValue &&
           (widget == "slider" || widget == "color" || widget == "checkbox");
}

bool editNumber(const char* label, const Parameter& parameter, std::vector<double>& value) {
    auto number = static_cast<float>(value.front());
    const auto low = static_cast<float>(annotated(parameter, "UIMin", 0));
    const auto high = static_cast<float>(annotated(parameter, "UIMax", 1));
    bool changed = false;
    if (parameter.type.base == BaseType::Float) {
        changed = ImGui::SliderFloat(label, &number, low, high, "%.3f");
    } else {
        int whole = static_cast<int>(number);
        changed = ImGui::SliderInt(label, &whole, static_cast<int>(low), static_cast<int>(high));
        number = static_cast<float>(whole);
    }
    if (changed) value.front() = static_cast<double>(number);
    return changed;
}

bool editCheckBox(const char* label, std::vector<double>& value) {
    bool checked = value.front() != 0;
    const bool changed = ImGui::Checkbox(label, &checked);
    if (changed) value.front() = checked ? 1 : 0;
    return changed;
}

bool editColor(const char* label, std::vector<double>& value) {
    float numbers[4] = {};
    for (std::size_t i = 0; i < value.size(); ++i)
        numbers[i] = static_cast<float>(value[i]);
    constexpr ImGuiColorEditFlags kLinear = ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR;
    const bool changed = value.size() == 4 ? ImGui::ColorEdit4(label, numbers, kLinear) : ImGui::ColorEdit3(label, numbers, kLinear);
    for (std::size_t i = 0; changed && i < value.size(); ++i)
        value[i] = static_cast<double>(numbers[i]);
    return changed;
}

bool edit(ViewState& state, const Parameter& parameter) {
    std::vector<double> value = valueOf(state, parameter);
    if (value.empty()) return false;
    const std::string widget = toLower(parameter.annotations.string("UIWidget").value_or(""));
    const std::string label = parameter.annotations.string("UIName").value_or(parameter.name) + "##" + parameter.name;
    bool changed = false;
    if (widget == "color" && value.size() >= 3)
        changed = editColor(label.c_str(), value);
    else if (widget == "checkbox")
        changed = editCheckBox(label.c_str(), value);
    else if (value.size() == 1)
        changed = editNumber(label.c_str(), parameter, value);
    const std::string help = parameter.annotations.string("UIHelp").value_or("");
    if (ImGui::IsItemHovered() && !help.empty()) ImGui::SetTooltip("%s: %s", parameter.name.c_str(), help.c_str());
    if (changed) state.parameters[parameter.name] = value;
    return changed;
}

bool drawSliders(ViewState& state, const Effect& effect) {
    corner(1, 0);
    ImGui::Begin("parameters", nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoCollapse);
    bool changed = false;
    for (const Parameter& parameter : effect.parameters)
        if (hasSlider(parameter)) changed = edit(state, parameter) || changed;
    ImGui::End();
    return changed;
}

} // namespace

bool drawPanel(ViewState& state, const Effect& effect, const PanelText& text) {
    if (state.information) drawLines(text);
    if (!text.problem.empty()) drawProblem(text.problem);
    if (state.help) drawHelp();
    return state.sliders && drawSliders(state, effect);
}

} // namespace tegument::view
