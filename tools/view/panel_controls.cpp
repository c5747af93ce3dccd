// Controls beside the picture, in sections: scene, technique, skin or fur, lights, surroundings, output; and a search through all of them.

#include "tools/view/panel.h"
#include "tools/view/panel_parts.h"

#include "host/support/text.h"
#include "tools/view/light_handles.h"

#include <fmt/format.h>
#include <imgui_internal.h> // text that ends in dots
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tegument::view {

namespace {

constexpr float kNarrow = 17;   // em: labels stand above their controls
constexpr float kLabel = 0.48F; // of a row
constexpr double kUsualStep = 0.001;
constexpr int kMostNumbers = 4; // of a parameter, or of one of its elements
constexpr const char* kEnvironment = "gEnvironmentMap";
constexpr const char* kSurroundingsFile = "more_light"; // whose parameters stand in the section of the surroundings

double annotated(const Parameter& parameter, std::string_view name, double otherwise) {
    const auto numbers = parameter.annotations.numbers(name);
    return numbers && !numbers->empty() ? numbers->front() : otherwise;
}

std::string widgetOf(const Parameter& parameter) {
    return toLower(parameter.annotations.string("UIWidget").value_or(""));
}

std::string helpOf(const Parameter& parameter) {
    return parameter.annotations.string("UIHelp").value_or("");
}

bool isRead(const ViewState& state, const Parameter& parameter) {
    return std::ranges::find(state.read, parameter.name) != state.read.end();
}

bool hasSlider(const Parameter& parameter) {
    const std::string widget = widgetOf(parameter);
    return parameter.type.isNumeric() && parameter.type.scalarCount() <= kMostNumbers && parameter.defaultValue &&
           (widget == "slider" || widget == "color" || widget == "checkbox");
}

/// Of the scene's light: it stands among the lights.
bool isLightColor(const Parameter& parameter) {
    return parameter.hasSemantic("DIFFUSE") && parameter.type.isNumeric() &&
           toLower(parameter.annotations.string("Object").value_or("")).find("light") != std::string::npos;
}

/// The first word of the help that is a unit.
std::string unitOf(const Parameter& parameter) {
    if (const auto unit = parameter.annotations.string("UIUnit")) return *unit;
    constexpr std::array kUnits = {"mm", "mm^2", "degrees", "rad", "radians", "pixels", "pixel", "texels", "spacings", "lengths"};
    std::string word;
    for (const char c : helpOf(parameter) + " ") {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '^') {
            word += c;
            continue;
        }
        if (std::ranges::find(kUnits, word) != kUnits.end()) return word;
        word.clear();
    }
    return {};
}

/// As many digits as the parameter's steps need, and its unit.
std::string formatOf(const Parameter& parameter) {
    constexpr int kMostDigits = 6;
    const double step = annotated(parameter, "UIStep", kUsualStep);
    const int digits = step > 0 ? static_cast<int>(std::ceil(-std::log10(step) - 1e-9)) : 3;
    const std::string unit = unitOf(parameter);
    return fmt::format("%.{}f{}", std::clamp(digits, 0, kMostDigits), unit.empty() ? "" : " " + unit);
}

std::string lowered(std::string_view text) {
    return toLower(std::string(text));
}

/// What a row says of itself.
struct Row {
    std::string label;
    std::string help{};
    std::string name{}; // of a parameter or a switch
};

class ControlRows {
public:
    ControlRows(ViewState& state, PanelMemory& memory, const PanelScene& scene, PanelOutcome& outcome)
        : state_(state), memory_(memory), scene_(scene), effect_(scene.loaded.effect), outcome_(outcome), search_(toLower(memory.search)) {}

    void draw() {
        ImGui::SetNextItemWidth(-1);
        ImGui::InputTextWithHint("##search", "search all parameters", &memory_.search);
        noteItem("search");
        ImGui::BeginChild("sections", ImVec2(0, 0), false);
        narrow_ = ImGui::GetContentRegionAvail().x < kNarrow * ImGui::GetFontSize();
        if (section("Scene", false)) scene();
        if (section("Technique", true)) technique();
        const bool fur = std::ranges::any_of(state_.read, [](const std::string& name) {
            return name.starts_with("gFur") || name.starts_with("gCoat") || name.starts_with("gRibbon");
        });
        if (section(fur ? "Fur" : "Skin", true)) material();
        if (section("Lights", true)) lights();
        if (section("Surroundings", false)) surroundings();
        if (!scene_.request.switches.empty() && section("Switches", false))
            for (const Switch& one : scene_.request.switches)
                if (!one.ofLight) choice(one);
        if (section("Output", false)) output();
        if (!search_.empty() && section("More parameters", true))
            for (const Parameter* parameter : othersOf(state_, effect_))
                if (!parameter->name.starts_with("gLamp")) anyParameter(*parameter);
        if (!search_.empty() && found_ == 0) ImGui::TextDisabled("nothing is called so");
        ImGui::EndChild();
    }

private:
    /// While something is searched all are open, and have a heading only above what was found.
    bool section(const char* name, bool open) {
        section_ = name;
        group_.clear();
        headed_ = false;
        if (!search_.empty()) return true;
        const bool isOpen = ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
        noteItem(std::string("section/") + name);
        return isOpen;
    }

    void group(const std::string& name) {
        group_ = name;
        if (search_.empty() && name != section_) heading(name);
    }

    static void heading(const std::string& text) {
        ImGui::Spacing();
        ImGui::TextDisabled("%s", text.c_str());
    }

    /// The label; false: the search leaves it out. The next item is the row's control.
    bool row(Row row) {
        item_ = section_ + "/" + (row.name.empty() ? row.label : row.name);
        row.label.insert(0, prefix_);
        help_ = row.help;
        if (!row.name.empty()) help_ = row.name + (row.help.empty() ? "" : ": " + row.help);
        if (!search_.empty()) {
            const std::string all = lowered(row.label + " " + row.name + " " + row.help + " " + group_ + " " + section_);
            if (all.find(search_) == std::string::npos) return false;
            ++found_;
            if (!headed_) heading(section_);
            headed_ = true;
        }
        const float width = ImGui::GetContentRegionAvail().x;
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float room = narrow_ ? width : kLabel * width - ImGui::GetStyle().ItemSpacing.x;
        const ImVec2 size = ImGui::CalcTextSize(row.label.c_str());
        const bool isCut = size.x > room;
        ImGui::Dummy(ImVec2(std::min(size.x, room), narrow_ ? size.y : ImGui::GetFrameHeight()));
        const float top = corner.y + (narrow_ ? 0 : ImGui::GetStyle().FramePadding.y);
        ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), ImVec2(corner.x, top), ImVec2(corner.x + room, top + 1.3F * size.y),
                                  corner.x + room, corner.x + room, row.label.c_str(), nullptr, &size);
        if (ImGui::IsItemHovered() && (isCut || !help_.empty())) tooltip(isCut ? row.label + "\n" + help_ : help_);
        if (!narrow_) ImGui::SameLine(kLabel * width);
        ImGui::SetNextItemWidth(-1);
        return true;
    }

    static void tooltip(const std::string& text) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(24 * ImGui::GetFontSize());
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }

    /// After each control.
    bool done(bool changed, Moving what = Moving::Rest) {
        noteItem(item_);
        if (ImGui::IsItemHovered() && !help_.empty()) tooltip(help_);
        if (changed && outcome_.moved != Moving::Rest) outcome_.moved = what;
        return changed;
    }

    [[nodiscard]] std::string id() const { return "##" + item_; }

    bool vector(const Row& about, glm::vec3& value, float speed, const char* format, Moving what = Moving::Rest) {
        return row(about) && done(ImGui::DragFloat3(id().c_str(), &value.x, speed, 0, 0, format), what);
    }

    bool number(const Row& about, float& value, float low, float high, const char* format, Moving what = Moving::Rest, bool drags = false) {
        if (!row(about)) return false;
        const float speed = (high - low) / 300;
        return done(drags ? ImGui::DragFloat(id().c_str(), &value, speed, low, high, format)
                          : ImGui::SliderFloat(id().c_str(), &value, low, high, format),
                    what);
    }

    bool number(const Row& about, double& value, float low, float high, const char* format, bool drags = false) {
        auto single = static_cast<float>(value);
        const bool changed = number(about, single, low, high, format, Moving::Rest, drags);
        if (changed) value = static_cast<double>(single);
        return changed;
    }

    /// Of light: its largest channel is the intensity.
    bool light(glm::vec3& color, std::string_view help) {
        const float most = std::max({color.x, color.y, color.z});
        glm::vec3 tint = most > 0 ? color / most : glm::vec3(1);
        float intensity = most;
        bool changed = false;
        if (row({"Colour", "linear; its largest channel is 1"}))
            changed =
                done(ImGui::ColorEdit3(id().c_str(), &tint.x, ImGuiColorEditFlags_Float | (narrow_ ? ImGuiColorEditFlags_NoInputs : 0)));
        changed = number({"Intensity", std::string(help)}, intensity, 0, 8, "%.3f", Moving::Rest, true) || changed;
        if (changed) color = tint / std::max(1e-6F, std::max({tint.x, tint.y, tint.z})) * intensity;
        return changed;
    }

    bool button(const char* label, const std::string& about, bool sameLine = false) {
        item_ = section_ + "/" + label;
        help_ = about;
        if (!search_.empty()) return false;
        const float needs = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
        if (sameLine) {
            ImGui::SameLine();
            if (ImGui::GetContentRegionAvail().x < needs) ImGui::NewLine();
        }
        const bool clicked = ImGui::Button(label);
        done(false);
        return clicked;
    }

    void command(const char* label, Command command, bool sameLine = false) {
        const auto keys = keyBindings();
        const auto key = std::ranges::find(keys, command, &KeyBinding::command);
        if (button(label, fmt::format("{} (key {})", key->text, key->label), sameLine)) outcome_.command = command;
    }

    void fact(const char* label, const std::string& text) {
        if (!row({label})) return;
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(text.c_str());
        help_ = text;
        done(false);
    }

    void scene() {
        const Workspace& workspace = scene_.request.workspace;
        const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
        fact("Mesh", workspace.meshPath.empty() ? fmt::format("{} objects", workspace.objects.size()) : name(workspace.meshPath));
        if (button("Open mesh ...", "obj, glb, ply, stl ...")) memory_.dialog.open(FileUse::Mesh, folderOf(workspace.meshPath));
        if (button("Open workspace ...", "mesh, camera, lights, values", true))
            memory_.dialog.open(FileUse::Workspace, workspace.file.parent_path());
        Camera& camera = state_.workspace.camera;
        const float arm = glm::length(camera.position - camera.target);
        Camera moved = camera;
        const bool changed =
            vector({"Camera", "where it stands, mm in the world"}, moved.position, 0.003F * arm, "%.1f", Moving::Camera) |
            vector({"Target", "what it looks at and turns about, mm"}, moved.target, 0.003F * arm, "%.1f", Moving::Camera) |
            number({"Field of view", "degrees across a picture of the shape that was asked for; a wider one shows more"},
                   moved.horizontalFov, 1, 120, "%.1f degrees", Moving::Camera);
        if (changed && glm::length(moved.position - moved.target) > 1e-3F) camera = moved;
        command("Front", Command::Front);
        command("Right", Command::Side, true);
        command("Above", Command::Top, true);
        command("Reset", Command::Reset, true);
    }

    [[nodiscard]] std::filesystem::path folderOf(const std::string& path) const {
        return (scene_.request.workspace.file.parent_path() / path).parent_path();
    }

    /// `comments`: of each name, or none.
    bool choose(const Row& about, const std::vector<std::string>& names, std::string& current,
                const std::vector<std::string>& comments = {}) {
        if (names.empty() || !row(about)) return false;
        const std::string before = current;
        const bool open = ImGui::BeginCombo(id().c_str(), current.c_str());
        done(false);
        if (!open) return false;
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (ImGui::Selectable(names[i].c_str(), names[i] == before)) current = names[i];
            noteItem(item_ + "=" + names[i]);
            if (ImGui::IsItemHovered() && i < comments.size() && !comments[i].empty()) tooltip(comments[i]);
        }
        ImGui::EndCombo();
        return current != before;
    }

    void technique() {
        Wanted wanted{.technique = state_.technique, .setting = state_.setting, .binds = state_.binds};
        if (choose({"Technique"}, state_.techniques, wanted.technique)) outcome_.wanted = wanted;
        if (choose({"Setting", "a reading of the sources: docs/settings.md"}, state_.settings, wanted.setting)) outcome_.wanted = wanted;
        preset();
        std::vector<std::string> targets = {"picture"};
        targets.insert(targets.end(), state_.targets.begin(), state_.targets.end());
        std::string shown = state_.show == Show::Target ? state_.target : targets.front();
        if (choose({"Shown", "the picture, or a target that it is made of"}, targets, shown))
            outcome_.opened = shown == targets.front() ? std::string() : shown;
    }

    void preset() {
        std::vector<std::string> names = {"as at the start"};
        std::vector<std::string> comments = {{}};
        for (const Preset& preset : state_.presets) {
            names.push_back(preset.name);
            comments.push_back(preset.comment);
        }
        std::string chosen = state_.preset.empty() ? names.front() : state_.preset;
        if (names.size() == 1 || !choose({"Preset", "values that belong together"}, names, chosen, comments)) return;
        choosePreset(state_, chosen == names.front() ? std::string() : chosen, scene_.start);
        outcome_.moved = Moving::Rest;
    }

    /// A macro of the effect, which is then read again.
    void choice(const Switch& one) {
        if (!row({one.label, one.help, one.name})) return;
        const auto found = state_.workspace.parameters.find(one.name);
        int value =
            found == state_.workspace.parameters.end() || found->second.empty() ? one.usual : static_cast<int>(found->second.front());
        bool changed = false;
        if (one.least == 0 && one.most == 1) {
            bool on = value != 0;
            changed = ImGui::Checkbox(id().c_str(), &on);
            value = on ? 1 : 0;
        } else {
            ImGui::InputInt(id().c_str(), &value, one.step, one.step);
            changed = ImGui::IsItemDeactivatedAfterEdit();
        }
        noteItem(item_);
        if (ImGui::IsItemHovered()) tooltip(help_);
        if (changed) outcome_.asked = {.file = {}, .sets = {fmt::format("{}={}", one.name, std::clamp(value, one.least, one.most))}};
    }

    void material() {
        std::string last;
        for (const Parameter* parameter : slidersOf(state_, effect_)) {
            if (isLightColor(*parameter) || isOfSurroundings(*parameter)) continue;
            if (const std::string name = groupOf(*parameter); name != last) group(last = name);
            this->parameter(*parameter);
        }
        if (last.empty() && search_.empty()) ImGui::TextDisabled("no parameters");
    }

    static bool isOfSurroundings(const Parameter& parameter) {
        return std::filesystem::path(parameter.at.file).stem() == kSurroundingsFile;
    }

    [[nodiscard]] static std::string labelOf(const Parameter& parameter) {
        return parameter.annotations.string("UIName").value_or(parameter.name);
    }

    bool edit(const Parameter& parameter, const std::string& widget, double* value, std::size_t count) {
        std::array<float, kMostNumbers> numbers{};
        std::transform(value, value + count, numbers.begin(), [](double number) { return static_cast<float>(number); });
        const auto low = static_cast<float>(annotated(parameter, "UIMin", 0));
        const auto high = static_cast<float>(annotated(parameter, "UIMax", widget == "slider" ? 1 : 0));
        constexpr ImGuiColorEditFlags kLinear = ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR;
        bool changed = false;
        if (widget == "color" && count >= 3) {
            const ImGuiColorEditFlags flags = kLinear | (narrow_ ? ImGuiColorEditFlags_NoInputs : 0);
            changed = count == 4 ? ImGui::ColorEdit4(id().c_str(), numbers.data(), flags)
                                 : ImGui::ColorEdit3(id().c_str(), numbers.data(), flags);
        } else if (widget == "checkbox") {
            bool checked = numbers[0] != 0;
            changed = ImGui::Checkbox(id().c_str(), &checked);
            numbers[0] = checked ? 1 : 0;
        } else if (isWhole(parameter) && count == 1) {
            int whole = static_cast<int>(std::lround(numbers[0]));
            changed = high > low ? ImGui::SliderInt(id().c_str(), &whole, static_cast<int>(low), static_cast<int>(high))
                                 : ImGui::DragInt(id().c_str(), &whole, 0.05F);
            numbers[0] = static_cast<float>(whole);
        } else if (high > low) {
            changed = ImGui::SliderScalarN(id().c_str(), ImGuiDataType_Float, numbers.data(), static_cast<int>(count), &low, &high,
                                           formatOf(parameter).c_str());
        } else {
            const float speed = std::max(1e-4F, 0.005F * std::abs(numbers[0]));
            changed = ImGui::DragScalarN(id().c_str(), ImGuiDataType_Float, numbers.data(), static_cast<int>(count), speed, nullptr,
                                         nullptr, "%.4g");
        }
        if (changed)
            std::transform(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count), value, [](float f) { return f; });
        return done(changed);
    }

    void parameter(const Parameter& parameter) {
        std::vector<double> value = valueOf(state_, parameter);
        if (value.empty() || value.size() > kMostNumbers || !row({labelOf(parameter), helpOf(parameter), parameter.name})) return;
        if (edit(parameter, widgetOf(parameter), value.data(), value.size())) state_.parameters[parameter.name] = value;
    }

    /// Of several elements a row each.
    void anyParameter(const Parameter& parameter) {
        std::vector<double> value = valueOf(state_, parameter);
        const auto elements = static_cast<std::size_t>(std::max(1, parameter.type.elements * parameter.type.rows));
        const std::size_t each = value.size() / elements;
        if (each == 0 || each > kMostNumbers) return;
        for (std::size_t i = 0; i < elements; ++i) {
            const std::string index = elements > 1 ? fmt::format("[{}]", i) : std::string();
            if (!row({labelOf(parameter) + index, helpOf(parameter), parameter.name + index})) continue;
            if (edit(parameter, {}, &value[i * each], each)) state_.parameters[parameter.name] = value;
        }
    }

    void lights() {
        for (const Switch& one : scene_.request.switches)
            if (one.ofLight && one.name != "TEGUMENT_SURROUNDINGS") choice(one);
        group("Light");
        Light& light = state_.workspace.light;
        const float reach = glm::length(light.position - state_.workspace.camera.target);
        if (light.direction) {
            glm::vec3 towards = -*light.direction;
            if (vector({"Direction", "that the light comes from; its disc on the picture can be dragged"}, towards, 0.01F, "%.3f") &&
                glm::length(towards) > 1e-3F)
                light.direction = -towards;
        } else {
            vector({"Position", "mm in the world; its disc on the picture can be dragged"}, light.position, std::max(0.01F, 0.003F * reach),
                   "%.1f");
        }
        lightColor(light);
        float extent = light.direction ? light.width.value_or(0) : light.fov.value_or(0);
        const Row size{"Shadow map", light.direction ? "mm across; 0: as large as the mesh" : "degrees across; 0: as wide as the mesh"};
        if (number(size, extent, 0, light.direction ? 2000.0F : 170.0F, light.direction ? "%.0f mm" : "%.1f degrees")) {
            auto& kept = light.direction ? light.width : light.fov;
            kept = extent > 0.1F ? std::optional(extent) : std::nullopt;
        }
        for (std::size_t lamp = 1; lamp <= lampCount(state_, effect_); ++lamp)
            this->lamp(lamp);
    }

    /// A value of the effect's own wins over the scene's light: it goes.
    void lightColor(Light& light) {
        for (const Parameter& parameter : effect_.parameters) {
            const auto set = isLightColor(parameter) ? state_.parameters.find(parameter.name) : state_.parameters.end();
            if (set == state_.parameters.end() || set->second.size() < 3) continue;
            for (int i = 0; i < 3; ++i)
                light.color[i] = static_cast<float>(set->second[static_cast<std::size_t>(i)]);
        }
        if (!this->light(light.color, "irradiance / pi of a surface that faces it")) return;
        for (const Parameter& parameter : effect_.parameters)
            if (isLightColor(parameter)) {
                state_.parameters.erase(parameter.name);
                state_.workspace.parameters.erase(parameter.name);
            }
    }

    /// The four numbers of one lamp in a parameter; null: there is none of that name.
    double* ofLamp(const char* name, std::size_t lamp, std::vector<double>& values) const {
        const Parameter* parameter = effect_.findParameter(name);
        if (parameter) values = valueOf(state_, *parameter);
        return kLampNumbers * lamp <= values.size() ? &values[kLampNumbers * (lamp - 1)] : nullptr;
    }

    void lamp(std::size_t lamp) {
        group(fmt::format("Lamp {}", lamp));
        prefix_ = search_.empty() ? std::string() : group_ + ": ";
        ImGui::PushID(static_cast<int>(lamp));
        const std::string section = std::exchange(section_, section_ + "/" + std::to_string(lamp));
        std::vector<double> places;
        std::vector<double> colors;
        std::vector<double> axes;
        std::vector<double> spots;
        double* place = ofLamp("gLampPlace", lamp, places);
        double* color = ofLamp("gLampColor", lamp, colors);
        double* axis = ofLamp("gLampAxis", lamp, axes);
        double* spot = ofLamp("gLampSpot", lamp, spots);
        if (place && color && axis && spot) {
            const auto three = [](const double* from) {
                return glm::vec3(static_cast<float>(from[0]), static_cast<float>(from[1]), static_cast<float>(from[2]));
            };
            const auto put = [](const glm::vec3& from, double* into) {
                for (int i = 0; i < 3; ++i)
                    into[i] = static_cast<double>(from[i]);
            };
            const bool point = place[3] != 0;
            glm::vec3 at = three(place);
            glm::vec3 light = three(color);
            glm::vec3 aim = three(axis);
            const float speed = point ? std::max(0.01F, 0.003F * glm::length(at)) : 0.01F;
            if (vector({point ? "Position" : "Direction", point ? "world units" : "that its light comes from"}, at, speed, "%.3f"))
                keep(
                    "gLampPlace", [&] { put(at, place); }, places);
            if (this->light(light, "irradiance / pi of a surface that faces it"))
                keep(
                    "gLampColor", [&] { put(light, color); }, colors);
            if (number({"Size", point ? "radius, world units: how soft its shadow is" : "sine of its half angle: how soft its shadow is"},
                       axis[3], 0, point ? 500.0F : 1.0F, "%.3f", true))
                keep(
                    "gLampAxis", [] {}, axes);
            if (point && number({"Bright at", "distance of that intensity, world units; then inverse square; 0: everywhere"}, color[3], 0,
                                5000, "%.0f", true))
                keep(
                    "gLampColor", [] {}, colors);
            if (point && vector({"Aim", "the way that a spot shines"}, aim, 0.01F, "%.3f") && glm::length(aim) > 1e-3F)
                keep(
                    "gLampAxis", [&] { put(glm::normalize(aim), axis); }, axes);
            if (point) cone(spot, spots);
            if (number({"Shadow", "its weight, where it throws one"}, spot[2], 0, 1, "%.2f"))
                keep(
                    "gLampSpot", [] {}, spots);
            if (number({"Highlight", "its weight"}, spot[3], 0, 4, "%.2f"))
                keep(
                    "gLampSpot", [] {}, spots);
        }
        section_ = section;
        prefix_.clear();
        ImGui::PopID();
    }

    template <class Change>
    void keep(const char* name, const Change& change, const std::vector<double>& values) {
        change();
        state_.parameters[name] = values;
    }

    /// Half angles; as cosines in the parameter. -2, below every cosine: no spot.
    void cone(double* spot, std::vector<double>& values) {
        constexpr double kDegrees = 180 / std::numbers::pi;
        double inner = std::acos(std::clamp(spot[0], -1.0, 1.0)) * kDegrees;
        double outer = spot[1] < -1 ? 180 : std::acos(std::clamp(spot[1], -1.0, 1.0)) * kDegrees;
        const bool changed = number({"Cone", "half angle that is lit in full; 180: no spot"}, inner, 0, 180, "%.0f degrees") |
                             number({"Cone's edge", "half angle where its light ends"}, outer, 0, 180, "%.0f degrees");
        if (!changed) return;
        spot[0] = std::cos(std::min(inner, outer) / kDegrees);
        spot[1] = outer >= 180 ? -2 : std::min(std::cos(outer / kDegrees), spot[0] - 1e-3);
        state_.parameters["gLampSpot"] = values;
    }

    void surroundings() {
        for (const Switch& one : scene_.request.switches)
            if (one.name == "TEGUMENT_SURROUNDINGS") choice(one);
        const auto& textures = scene_.request.run.textures;
        const auto given = textures.find(kEnvironment);
        const bool own = given != textures.end();
        fact("File", own ? std::filesystem::path(given->second).filename().string() : "the studio");
        if (button("Choose ...", "a cube map (.dds) or a panorama (.hdr, .exr)"))
            memory_.dialog.open(FileUse::Environment, own ? std::filesystem::path(given->second).parent_path() : std::filesystem::path());
        if (own && button("Studio", "the usual surroundings", true))
            outcome_.asked = {.file = {}, .sets = {std::string(kEnvironment) + "="}};
        for (const Parameter* parameter : slidersOf(state_, effect_))
            if (isOfSurroundings(*parameter)) this->parameter(*parameter);
    }

    void output() {
        fact("Size", fmt::format("{} x {} pixels", scene_.size.width, scene_.size.height));
        auto stops = static_cast<float>(state_.stops);
        if (row({"Exposure", "stops; of what is seen here, and of the picture that is saved"})) {
            const bool changed = ImGui::SliderFloat(id().c_str(), &stops, -8, 8, "%.1f stops");
            noteItem(item_);
            if (changed) {
                state_.stops = static_cast<double>(stops);
                outcome_.painted = true;
            }
        }
        command("Save picture", Command::Save);
        if (button("as ...", "a file of your choice", true)) memory_.dialog.open(FileUse::SavePicture, scene_.request.pictures);
        command("Save workspace", Command::SaveWorkspace);
        if (button("as ... ", "a file of your choice", true)) memory_.dialog.open(FileUse::SaveWorkspace, scene_.request.pictures);
        command("Copy command line", Command::CopyCommand);
    }

    ViewState& state_;
    PanelMemory& memory_;
    const PanelScene& scene_;
    const Effect& effect_;
    PanelOutcome& outcome_;
    std::string search_; // in small letters
    std::string section_;
    std::string group_;
    std::string prefix_; // of labels, while something is searched
    std::string item_;   // "Lights/Intensity"
    std::string help_;
    int found_ = 0;
    bool headed_ = false;
    bool narrow_ = false;
};

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
        if (hasSlider(parameter) && isRead(state, parameter)) parameters.push_back(&parameter);
    return parameters;
}

std::vector<const Parameter*> othersOf(const ViewState& state, const Effect& effect) {
    std::vector<const Parameter*> parameters;
    for (const Parameter& parameter : effect.parameters)
        if (parameter.type.isNumeric() && parameter.defaultValue && !hasSlider(parameter) && isRead(state, parameter))
            parameters.push_back(&parameter);
    return parameters;
}

std::string groupOf(const Parameter& parameter) {
    if (const auto group = parameter.annotations.string("UIGroup")) return *group;
    std::string name = std::filesystem::path(parameter.at.file).stem().string();
    constexpr std::string_view kUsualEnd = "_parameters";
    if (name.ends_with(kUsualEnd)) name.resize(name.size() - kUsualEnd.size());
    std::ranges::replace(name, '_', ' ');
    if (!name.empty()) name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    return name;
}

void drawControls(ViewState& state, PanelMemory& memory, const PanelScene& scene, PanelOutcome& outcome) {
    if (const FixedPanel panel("controls", scene.layout.controls, ImGuiWindowFlags_NoScrollbar); panel)
        ControlRows(state, memory, scene, outcome).draw();
}

} // namespace tegument::view
