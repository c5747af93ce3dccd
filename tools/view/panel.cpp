#include "tools/view/panel.h"

#include "tools/view/keys.h"
#include "tools/view/light_handles.h"
#include "tools/view/panel_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace tegument::view {

namespace {

const ImVec4 kRed(1.0F, 0.55F, 0.5F, 1.0F);
constexpr const char* kOwnEffect = "written for this host: its semantics say what each parameter gets";
constexpr float kHistogramHeight = 6; // em
constexpr float kDisc = 0.55F;        // em, of a light's handle
// Half transparent: what lies behind is seen.
constexpr ImU32 kGrey = IM_COL32(220, 220, 220, 200);
constexpr std::array<ImU32, Histogram::kChannels> kChannelColors = {IM_COL32(235, 70, 60, 150), IM_COL32(70, 200, 80, 150),
                                                                    IM_COL32(80, 130, 255, 150)};

void drawLines(const std::vector<std::string>& lines) {
    ImGui::PushTextWrapPos(0);
    for (const std::string& line : lines)
        ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
}

/// A name, and below it the numbers that stand two spaces behind it.
void drawValues(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
        const std::size_t end = std::min(line.find("  "), line.size());
        ImGui::TextUnformatted(line.c_str(), line.c_str() + end);
        const std::size_t numbers = line.find_first_not_of(' ', end);
        if (numbers == std::string::npos) continue;
        ImGui::Indent();
        ImGui::PushTextWrapPos(0);
        ImGui::TextDisabled("%s", line.c_str() + numbers);
        ImGui::PopTextWrapPos();
        ImGui::Unindent();
    }
}

void drawHistogram(const Histogram& histogram) {
    std::size_t most = 1;
    for (const auto& counts : histogram.counts)
        most = std::max(most, *std::ranges::max_element(counts));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = kHistogramHeight * ImGui::GetFontSize();
    const float width = ImGui::GetContentRegionAvail().x;
    const float step = width / static_cast<float>(Histogram::kBins);
    for (std::size_t c = 0; c < static_cast<std::size_t>(histogram.channels); ++c)
        for (std::size_t bin = 0; bin < Histogram::kBins; ++bin) {
            // The root: what few texels hold is seen, too.
            const float high = height * std::sqrt(static_cast<float>(histogram.counts[c][bin]) / static_cast<float>(most));
            const float left = corner.x + step * static_cast<float>(bin);
            ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(left, corner.y + height - high), ImVec2(left + step, corner.y + height),
                                                      histogram.channels == 1 ? kGrey : kChannelColors.at(c));
        }
    ImGui::Dummy(ImVec2(width, height));
    ImGui::Text("%.4g", static_cast<double>(histogram.low));
    noteItem("sheets/low");
    const std::string high = fmt::format("{:.4g}", histogram.high);
    ImGui::SameLine(std::max(0.0F, width - ImGui::CalcTextSize(high.c_str()).x + ImGui::GetStyle().WindowPadding.x));
    ImGui::TextUnformatted(high.c_str());
    noteItem("sheets/high");
    if (histogram.notFinite > 0) ImGui::TextColored(kRed, "%zu values are not finite", histogram.notFinite);
}

void drawRow(const char* label, const char* text, float column) {
    ImGui::TextColored(ImVec4(1, 1, 1, 1), "%s", label);
    ImGui::SameLine(column);
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("%s", text);
    ImGui::PopTextWrapPos();
}

void drawKeys() {
    const float em = ImGui::GetFontSize();
    for (const char* group : kKeyGroups) {
        ImGui::TextUnformatted(group);
        for (const KeyBinding& key : keyBindings())
            if (key.group == std::string_view(group)) drawRow(key.label, capital(key.text).c_str(), 4 * em);
        ImGui::Spacing();
    }
    ImGui::TextUnformatted("Mouse");
    for (const MouseBinding& mouse : mouseBindings()) {
        ImGui::TextColored(ImVec4(1, 1, 1, 1), "%s", mouse.label);
        ImGui::Indent();
        drawLines({mouse.text});
        ImGui::Unindent();
    }
}

void drawSheets(ViewState& state, const PanelScene& scene, const PanelText& text, const PanelPictures& pictures, PanelOutcome& outcome) {
    const FixedPanel panel("sheets", scene.layout.sheets);
    if (!panel) return;
    const auto sheet = [](const char* title, bool& shown) {
        bool stays = true;
        const bool open = shown && ImGui::CollapsingHeader(title, &stays, ImGuiTreeNodeFlags_DefaultOpen);
        if (shown) noteItem(std::string("sheet/") + title);
        if (!stays) shown = false;
        return open;
    };
    if (sheet("Keys", state.help)) drawKeys();
    if (sheet("Values", state.probe)) {
        if (pictures.histogram) drawHistogram(*pictures.histogram);
        drawValues(text.values);
    }
    if (sheet("Statistics", state.times)) {
        drawLines(text.lines);
        drawTimes(pictures.times);
    }
    bool mesh = !pictures.legend.empty();
    if (sheet("Mesh in false colours", mesh)) drawLegend(pictures);
    if (!pictures.legend.empty() && !mesh) outcome.command = Command::Picture;
    if (sheet("Textures", state.textures))
        drawTextures(pictures.textures, state.show == Show::Target ? state.target : std::string(), outcome);
    if (sheet("Bindings", state.bindings)) {
        if (scene.loaded.bindings.empty())
            drawLines({kOwnEffect});
        else
            outcome.bound = drawBindings(scene.loaded.bindings, scene.loaded.effect, state.binds);
    }
}

void drawLine(const char* name, const Area& area, const std::string& text) {
    const FixedPanel panel(name, area, ImGuiWindowFlags_NoScrollbar);
    if (!panel) return;
    ImGui::SetCursorPosY(0.5F * (area.height - ImGui::GetTextLineHeight()));
    ImGui::TextUnformatted(text.c_str());
    if (ImGui::IsWindowHovered() && ImGui::GetItemRectSize().x > area.width) ImGui::SetTooltip("%s", text.c_str());
}

void drawProblem(const Area& area, const std::string& text) {
    const FixedPanel panel("problem", area);
    if (!panel) return;
    ImGui::PushStyleColor(ImGuiCol_Text, kRed);
    drawLines({text});
    ImGui::PopStyleColor();
}

ImU32 displayed(const glm::vec3& color) {
    const auto encoded = [](float value) { return value <= 0 ? 0.0F : std::pow(std::min(1.0F, value), 1 / 2.2F); };
    return ImGui::ColorConvertFloat4ToU32(ImVec4(encoded(color.x), encoded(color.y), encoded(color.z), 1));
}

} // namespace

void drawLightHandles(ViewState& state, const PanelScene& scene, PanelOutcome& outcome) {
    const Area& picture = scene.layout.picture;
    if (picture.width < 1 || picture.height < 1) return;
    const float radius = kDisc * ImGui::GetFontSize();
    const float grip = 1.6F * radius;
    for (const LightHandle& handle :
         lightHandles(state, scene.loaded.effect, scene.seen, static_cast<double>(picture.width / picture.height))) {
        const ImVec2 at(picture.x + static_cast<float>(handle.place.x) * picture.width,
                        picture.y + static_cast<float>(handle.place.y) * picture.height);
        ImGui::SetNextWindowPos(ImVec2(at.x - grip, at.y - grip), ImGuiCond_Always);
        ImGui::SetNextWindowSize(ImVec2(2 * grip, 2 * grip), ImGuiCond_Always);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
        ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
        ImGui::Begin(("light " + handle.name).c_str(), nullptr, kFixedPanel | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar);
        ImGui::PopStyleVar(2);
        ImGui::InvisibleButton("disc", ImVec2(2 * grip, 2 * grip));
        noteItem("disc/" + handle.name);
        const bool held = ImGui::IsItemActive();
        const bool hot = held || ImGui::IsItemHovered();
        const ImVec2 by = ImGui::GetIO().MouseDelta;
        if (held && (by.x != 0 || by.y != 0)) {
            turnLight(state, scene.loaded.effect, handle, {by.x / picture.height, -by.y / picture.height});
            outcome.moved = Moving::Rest;
        }
        if (hot) ImGui::SetTooltip("%s: drag turns it", handle.name.c_str());
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float thick = std::max(1.0F, 0.12F * ImGui::GetFontSize());
        const float shown = handle.outside ? 0.75F * radius : radius;
        list.AddCircleFilled(at, shown + 1.5F * thick, IM_COL32(10, 10, 10, 190));
        if (handle.behind && !handle.outside)
            list.AddCircle(at, shown - 0.5F * thick, displayed(handle.color), 0, 2 * thick);
        else
            list.AddCircleFilled(at, shown, displayed(handle.color));
        list.AddCircle(at, shown + 0.5F * thick, hot ? IM_COL32(255, 255, 255, 255) : IM_COL32(200, 200, 200, 220), 0, thick);
        ImGui::End();
    }
}

float problemHeight(const std::string& problem, float width, float em) {
    constexpr float kLetter = 0.62F; // em, across
    constexpr float kLine = 1.2F;
    float lines = 0;
    for (std::size_t at = 0; at < problem.size();) {
        const std::size_t end = std::min(problem.find('\n', at), problem.size());
        lines += std::max(1.0F, std::ceil(static_cast<float>(end - at) * kLetter * em / std::max(1.0F, width - 2 * em)));
        at = end + 1;
    }
    return lines > 0 ? (kLine * lines + 1.2F) * em : 0;
}

PanelOutcome drawPanel(ViewState& state, PanelMemory& memory, const PanelScene& scene, const PanelText& text, const PanelPictures& pictures,
                       SourceText& source) {
    PanelOutcome outcome;
    const Layout& layout = scene.layout;
    notePlace("picture", layout.picture);
    if (state.information && state.show == Show::Picture && state.mesh == MeshShow::None) drawLightHandles(state, scene, outcome);
    drawMenus(state, memory, scene, outcome);
    drawControls(state, memory, scene, outcome);
    drawSheets(state, scene, text, pictures, outcome);
    drawLine("status", layout.status, text.status);
    if (!text.problem.empty()) drawProblem(layout.problem, text.problem);
    if (!pictures.thumbnails.empty())
        if (auto opened = drawStrip(pictures, layout.strip)) outcome.opened = std::move(opened);
    if (text.beside) drawBorder(state.border, *text.beside, layout.picture);
    if (state.source) drawSource(source, layout.source);
    drawDialog(memory.dialog, outcome);
    return outcome;
}

} // namespace tegument::view
