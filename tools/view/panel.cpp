#include "tools/view/panel.h"

#include "host/support/text.h"
#include "tools/view/keys.h"
#include "tools/view/layout.h"
#include "tools/view/panel_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::view {

namespace {

constexpr ImGuiWindowFlags kPlain = kFixedPanel | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoScrollbar;
constexpr float kSliderShare = 0.5F; // of the panel's width; the rest is the name
const ImVec4 kRed(1.0F, 0.55F, 0.5F, 1.0F);
constexpr const char* kOwnEffect = "written for this host: its semantics say what each parameter gets\n";
constexpr float kHistogramWidth = 280;
constexpr float kHistogramHeight = 80;
// Half transparent: what lies behind is seen.
constexpr ImU32 kGrey = IM_COL32(220, 220, 220, 200);
constexpr std::array<ImU32, Histogram::kChannels> kChannelColors = {IM_COL32(235, 70, 60, 150), IM_COL32(70, 200, 80, 150),
                                                                    IM_COL32(80, 130, 255, 150)};

/// Text with a window's padding around it.
PanelSize sizeOf(const std::string& text) {
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    const auto height = [text, padding](float width) {
        return ImGui::CalcTextSize(text.c_str(), nullptr, false, std::max(1.0F, width - 2 * padding.x)).y + 2 * padding.y;
    };
    return {.width = ImGui::CalcTextSize(text.c_str()).x + 2 * padding.x + 1, .height = height};
}

void drawText(const char* name, const Area& area, const std::string& text) {
    if (area.width <= 0 || area.height <= 0) return;
    placePanel(area);
    ImGui::Begin(name, nullptr, kPlain);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
}

std::string linesOf(const PanelText& text) {
    std::string all;
    for (const std::string& line : text.lines)
        all += (all.empty() ? "" : "\n") + line;
    return text.notice.empty() ? all : all + '\n' + text.notice;
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

/// As many digits as the parameter's steps need.
std::string formatOf(const Parameter& parameter) {
    constexpr double kUsualStep = 0.001;
    constexpr int kMostDigits = 6;
    const double step = annotated(parameter, "UIStep", kUsualStep);
    const int digits = step > 0 ? static_cast<int>(std::ceil(-std::log10(step) - 1e-9)) : 3;
    return fmt::format("%.{}f", std::clamp(digits, 0, kMostDigits));
}

bool editNumber(const char* label, const Parameter& parameter, std::vector<double>& value) {
    const double low = annotated(parameter, "UIMin", 0);
    const double high = annotated(parameter, "UIMax", 1);
    bool changed = false;
    if (isWhole(parameter)) {
        int whole = static_cast<int>(std::lround(value.front()));
        changed = ImGui::SliderInt(label, &whole, static_cast<int>(low), static_cast<int>(high));
        if (changed) value.front() = whole;
    } else {
        auto number = static_cast<float>(value.front());
        changed = ImGui::SliderFloat(label, &number, static_cast<float>(low), static_cast<float>(high), formatOf(parameter).c_str());
        if (changed) value.front() = static_cast<double>(number);
    }
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

/// The presets as a list to choose from; the first entry is none of them.
bool choosePresetFromList(ViewState& state, const ViewState& start) {
    if (state.presets.empty()) return false;
    constexpr const char* kNone = "as at the start";
    bool changed = false;
    if (!ImGui::BeginCombo("preset", state.preset.empty() ? kNone : state.preset.c_str())) return false;
    const auto offer = [&](const std::string& name, const std::string& comment) {
        if (ImGui::Selectable(name.empty() ? kNone : name.c_str(), name == state.preset)) {
            choosePreset(state, name, start);
            changed = true;
        }
        if (ImGui::IsItemHovered() && !comment.empty()) ImGui::SetTooltip("%s", comment.c_str());
    };
    offer({}, {});
    for (const Preset& preset : std::vector<Preset>(state.presets))
        offer(preset.name, preset.comment);
    ImGui::EndCombo();
    return changed;
}

PanelSize sliderSize(const ViewState& state, const std::vector<const Parameter*>& parameters) {
    const float rows = static_cast<float>(parameters.size() + (state.presets.empty() ? 0 : 1));
    const ImGuiStyle& style = ImGui::GetStyle();
    float widest = ImGui::CalcTextSize("no parameters").x;
    for (const Parameter* parameter : parameters)
        widest = std::max(widest, ImGui::CalcTextSize(parameter->annotations.string("UIName").value_or(parameter->name).c_str()).x);
    const float width = widest / (1 - kSliderShare) + 2 * style.WindowPadding.x + style.ScrollbarSize;
    const float height = std::max(1.0F, rows) * ImGui::GetFrameHeightWithSpacing() + 2 * style.WindowPadding.y;
    return {.width = width, .height = [height](float) { return height; }};
}

bool drawSliders(ViewState& state, const ViewState& start, const std::vector<const Parameter*>& parameters, const Area& area) {
    if (area.width <= 0 || area.height <= 0) return false;
    placePanel(area);
    ImGui::Begin("parameters", nullptr, kFixedPanel);
    ImGui::PushItemWidth(kSliderShare * (area.width - 2 * ImGui::GetStyle().WindowPadding.x));
    bool changed = choosePresetFromList(state, start);
    if (parameters.empty() && state.presets.empty()) ImGui::TextUnformatted("no parameters");
    for (const Parameter* parameter : parameters)
        changed = edit(state, *parameter) || changed;
    ImGui::PopItemWidth();
    ImGui::End();
    return changed;
}

PanelSize histogramSize() {
    const float line = ImGui::GetTextLineHeightWithSpacing();
    return {.width = kHistogramWidth,
            .height = [line](float) { return kHistogramHeight + 2 * line + 2 * ImGui::GetStyle().WindowPadding.y; }};
}

void drawHistogram(const Histogram& histogram, const Area& area) {
    if (area.width <= 0 || area.height <= 0) return;
    placePanel(area);
    ImGui::Begin("values", nullptr, kPlain);
    std::size_t most = 1;
    for (const auto& counts : histogram.counts)
        most = std::max(most, *std::ranges::max_element(counts));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float step = width / static_cast<float>(Histogram::kBins);
    for (std::size_t c = 0; c < static_cast<std::size_t>(histogram.channels); ++c)
        for (std::size_t bin = 0; bin < Histogram::kBins; ++bin) {
            // The root: what few texels hold is seen, too.
            const float height = kHistogramHeight * std::sqrt(static_cast<float>(histogram.counts[c][bin]) / static_cast<float>(most));
            const float left = corner.x + step * static_cast<float>(bin);
            const float bottom = corner.y + kHistogramHeight;
            ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(left, bottom - height), ImVec2(left + step, bottom),
                                                      histogram.channels == 1 ? kGrey : kChannelColors.at(c));
        }
    ImGui::Dummy(ImVec2(width, kHistogramHeight));
    ImGui::Text("%.4g", static_cast<double>(histogram.low));
    const std::string high = fmt::format("{:.4g}", histogram.high);
    ImGui::SameLine(std::max(0.0F, width - ImGui::CalcTextSize(high.c_str()).x + ImGui::GetStyle().WindowPadding.x));
    ImGui::TextUnformatted(high.c_str());
    if (histogram.notFinite > 0) ImGui::TextColored(kRed, "%zu values are not finite", histogram.notFinite);
    ImGui::End();
}

/// Which panels stand, on how large a window.
unsigned signatureOf(const PanelSizes& sizes, const ImVec2& window) {
    unsigned number = 0;
    for (const bool there :
         {sizes.strip.has_value(), sizes.histogram.has_value(), sizes.times.has_value(), sizes.lines.has_value() && sizes.linesTakeRoom})
        number = 2 * number + (there ? 1 : 0);
    const auto width = [](const std::optional<PanelSize>& size) { return size ? size->width : 0; };
    for (const float pixels : {width(sizes.help), width(sizes.sliders), window.x, window.y})
        number = number * 65599U + static_cast<unsigned>(pixels);
    return number;
}

} // namespace

bool isWhole(const Parameter& parameter) {
    if (parameter.type.base != BaseType::Float) return true;
    const auto whole = [&](std::string_view name) {
        const double number = annotated(parameter, name, 0.5);
        return number == std::floor(number);
    };
    return whole("UIMin") && whole("UIMax") && whole("UIStep") && annotated(parameter, "UIStep", 0) >= 1;
}

std::vector<const Parameter*> slidersOf(const ViewState& state, const Effect& effect) {
    std::vector<const Parameter*> parameters;
    for (const Parameter& parameter : effect.parameters)
        if (hasSlider(parameter) && std::ranges::find(state.read, parameter.name) != state.read.end()) parameters.push_back(&parameter);
    return parameters;
}

PanelOutcome drawPanel(ViewState& state, const ViewState& start, const Loaded& loaded, const PanelText& text, const PanelPictures& pictures,
                       SourceText& source) {
    const float width = text.pictureShare * ImGui::GetIO().DisplaySize.x;
    const float height = ImGui::GetIO().DisplaySize.y;
    const std::vector<const Parameter*> parameters = slidersOf(state, loaded.effect);
    const std::string lines = linesOf(text);
    PanelSizes sizes;
    if (state.information) sizes.lines = sizeOf(lines);
    const bool bindings = !state.help && state.bindings && !loaded.bindings.empty();
    const std::string help = state.help ? bindingsHelp() : state.bindings ? kOwnEffect : std::string();
    if (bindings)
        sizes.help = bindingsSize(loaded.bindings);
    else if (!help.empty())
        sizes.help = sizeOf(help);
    const bool textures = !sizes.help && !pictures.textures.empty();
    if (textures) sizes.help = texturesSize(pictures.textures);
    const bool legend = !sizes.help && !pictures.legend.empty();
    if (legend) sizes.help = legendSize(pictures);
    if (!pictures.thumbnails.empty()) sizes.strip = stripSize(pictures);
    if (pictures.histogram) sizes.histogram = histogramSize();
    if (!pictures.times.empty()) sizes.times = timesSize(pictures.times);
    if (state.sliders) sizes.sliders = sliderSize(state, parameters);
    if (!text.problem.empty()) {
        sizes.problem = sizeOf(text.problem);
        sizes.problem->width = ImGui::GetIO().DisplaySize.x;
    }
    sizes.linesTakeRoom = state.probe;
    const PanelAreas areas = arrange(width, height, sizes);
    if (areas.lines) drawText("shown", *areas.lines, lines);
    if (areas.problem) {
        ImGui::PushStyleColor(ImGuiCol_Text, kRed);
        drawText("problem", *areas.problem, text.problem);
        ImGui::PopStyleColor();
    }
    if (areas.help && legend) drawLegend(pictures, *areas.help);
    if (areas.help && !bindings && !legend && !textures) drawText("help", *areas.help, help);
    if (areas.histogram) drawHistogram(*pictures.histogram, *areas.histogram);
    if (areas.times) drawTimes(pictures.times, *areas.times);
    PanelOutcome outcome;
    outcome.dock = areas.dock;
    outcome.docked = signatureOf(sizes, ImGui::GetIO().DisplaySize);
    if (areas.help && bindings) outcome.bound = drawBindings(loaded.bindings, loaded.effect, state.binds, *areas.help);
    if (areas.strip) outcome.opened = drawStrip(pictures, *areas.strip);
    if (areas.help && textures)
        drawTextures(pictures.textures, state.show == Show::Target ? state.target : std::string(), *areas.help, outcome);
    outcome.moved = areas.sliders && drawSliders(state, start, parameters, *areas.sliders);
    if (text.beside) {
        float bottom = text.picture.y + text.picture.height;
        for (const auto& area : {areas.strip, areas.problem})
            if (area) bottom = std::min(bottom, area->y);
        float right = text.picture.x + text.picture.width;
        for (const auto& area : {areas.histogram, areas.times})
            if (area) right = std::min(right, area->x - kPanelMargin);
        drawBorder(state.border, *text.beside, text.picture, right, bottom);
    }
    if (state.source) drawSource(source, {.x = width, .y = 0, .width = ImGui::GetIO().DisplaySize.x - width, .height = height});
    return outcome;
}

} // namespace tegument::view
