#include "tools/view/state.h"

#include "host/support/text.h"
#include "tools/view/orbit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::view {

namespace {

constexpr double kTurn = 3.14159265358979323846; // radians for a drag over the window's height
constexpr double kNotch = 1.1;                   // of the distance for a notch of the wheel
constexpr double kNotches = 20;                  // for a drag over the window's height: a seventh of the distance
constexpr double kStops = 0.5;
constexpr const char* kSurroundingsTurn = "gSurroundingsTurn"; // degrees about the vertical: docs/settings.md
constexpr int kChannels = 5;
constexpr float kMostZoom = 32;

/// The element `step` places on, round the end; the first when `current` is not among them.
std::size_t stepped(std::size_t count, std::optional<std::size_t> current, int step) {
    if (!current) return step > 0 ? 0 : count - 1;
    return (*current + count + static_cast<std::size_t>(step + static_cast<int>(count))) % count;
}

std::optional<std::size_t> indexOf(const std::vector<std::string>& list, const std::string& name) {
    const auto found = std::ranges::find(list, name);
    return found == list.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - list.begin()));
}

void showAnew(ViewState& state) {
    state.stops = 0;
    state.channel = 0;
    state.level = 0;
    state.zoom = 1;
    state.mesh = MeshShow::None;
}

Request stepTechnique(ViewState& state, int step) {
    if (state.techniques.empty()) return Request::None;
    state.technique = state.techniques[stepped(state.techniques.size(), indexOf(state.techniques, state.technique), step)];
    state.show = Show::Picture;
    showAnew(state);
    return Request::Draw;
}

Request stepPass(ViewState& state, int step) {
    if (state.passes.empty()) return Request::None;
    const std::optional<std::size_t> current = state.show == Show::Pass ? std::optional(state.pass) : std::nullopt;
    state.pass = stepped(state.passes.size(), current, step);
    state.show = Show::Pass;
    showAnew(state);
    return Request::Draw;
}

Request stepTarget(ViewState& state, int step) {
    if (state.targets.empty()) return Request::None;
    const std::optional<std::size_t> current = state.show == Show::Target ? indexOf(state.targets, state.target) : std::nullopt;
    state.target = state.targets[stepped(state.targets.size(), current, step)];
    state.show = Show::Target;
    showAnew(state);
    return Request::Draw;
}

Request showPicture(ViewState& state) {
    state.show = Show::Picture;
    showAnew(state);
    return Request::Draw;
}

Request stepSetting(ViewState& state) {
    if (state.settings.empty()) return Request::None;
    state.setting = state.settings[stepped(state.settings.size(), indexOf(state.settings, state.setting), 1)];
    return Request::Load;
}

/// Behind the last preset: as at the start.
Request stepPreset(ViewState& state, const ViewState& start) {
    if (state.presets.empty()) return Request::None;
    const auto found = std::ranges::find(state.presets, state.preset, &Preset::name);
    const bool last = found != state.presets.end() && found + 1 == state.presets.end();
    const auto& next = found == state.presets.end() || last ? state.presets.front() : *(found + 1);
    choosePreset(state, last ? std::string() : next.name, start);
    return Request::Draw;
}

Request reset(ViewState& state, const ViewState& start) {
    state.workspace = start.workspace;
    choosePreset(state, {}, start);
    return Request::Draw;
}

/// What is under the cursor stays there.
Request zoomIn(ViewState& state) {
    if (state.zoom >= kMostZoom) return Request::None;
    const glm::dvec2 place = placeSeenAt(state, state.cursor);
    state.zoom *= 2;
    const auto zoom = static_cast<double>(state.zoom);
    state.zoomAt = glm::clamp((state.cursor - zoom * place) / (1 - zoom), 0.0, 1.0);
    return Request::Levels;
}

Request stepMesh(ViewState& state) {
    const int kinds = state.fur ? 5 : 4;
    state.mesh = static_cast<MeshShow>((static_cast<int>(state.mesh) + 1) % kinds);
    return Request::Levels;
}

Request brighten(ViewState& state, double stops) {
    state.stops = stops == 0 ? 0 : state.stops + stops;
    return Request::Levels;
}

/// By a share of the window's height.
void turnSurroundings(ViewState& state, double by) {
    double before = 0;
    for (const auto* values : {&state.workspace.parameters, &state.parameters})
        if (const auto found = values->find(kSurroundingsTurn); found != values->end()) before = found->second.front();
    state.parameters[kSurroundingsTurn] = {std::remainder(before + glm::degrees(kTurn) * by, 360.0)};
}

/// From an axis of the world, as far as before.
Request lookFrom(ViewState& state, const glm::vec3& side) {
    Camera& camera = state.workspace.camera;
    const float distance = glm::length(camera.position - camera.target);
    camera.up = {0, 1, 0};
    camera.position = camera.target + distance * glm::normalize(side);
    return Request::Move;
}

} // namespace

bool* switchOf(ViewState& state, Command command) {
    switch (command) {
    case Command::Help: return &state.help;
    case Command::Parameters: return &state.controls;
    case Command::Information: return &state.information;
    case Command::Probe: return &state.probe;
    case Command::Strip: return &state.strip;
    case Command::Times: return &state.times;
    case Command::Textures: return &state.textures;
    case Command::Bindings: return &state.bindings;
    case Command::Errors: return &state.errors;
    case Command::Source: return &state.source;
    default: return nullptr;
    }
}

Request apply(ViewState& state, Command command, const ViewState& start) {
    if (bool* flag = switchOf(state, command)) {
        *flag = !*flag;
        if (command == Command::Information) state.controls = state.information;
        return Request::None;
    }
    switch (command) {
    case Command::NextTechnique: return stepTechnique(state, 1);
    case Command::PreviousTechnique: return stepTechnique(state, -1);
    case Command::NextPass: return stepPass(state, 1);
    case Command::PreviousPass: return stepPass(state, -1);
    case Command::NextTarget: return stepTarget(state, 1);
    case Command::PreviousTarget: return stepTarget(state, -1);
    case Command::Picture: return showPicture(state);
    case Command::NextSetting: return stepSetting(state);
    case Command::NextChannel: state.channel = (state.channel + 1) % kChannels; return Request::Levels;
    case Command::NextLevel: state.level = (state.level + 1) % std::max(1, state.levels); return Request::Levels;
    case Command::Closer: return zoomIn(state);
    case Command::Whole: state.zoom = 1; return Request::Levels;
    case Command::Brighter: return brighten(state, kStops);
    case Command::Darker: return brighten(state, -kStops);
    case Command::Automatic: return brighten(state, 0);
    case Command::Front: return lookFrom(state, {0, 0, 1});
    case Command::Side: return lookFrom(state, {1, 0, 0});
    case Command::Top: return lookFrom(state, {0, 1, 0.02F}); // at the pole itself the picture would spin
    case Command::Reset: return reset(state, start);
    case Command::Reload: return Request::Load;
    case Command::Save: return Request::Save;
    case Command::NextPreset: return stepPreset(state, start);
    case Command::SaveWorkspace: return Request::SaveWorkspace;
    case Command::CopyCommand: return Request::CopyCommand;
    case Command::Mesh: return stepMesh(state);
    case Command::Keep: return Request::Keep;
    case Command::Quit: return Request::Quit;
    default: return Request::None;
    }
}

std::vector<double> valueOf(const ViewState& state, const Parameter& parameter) {
    for (const auto* values : {&state.parameters, &state.workspace.parameters})
        if (const auto found = values->find(parameter.name); found != values->end()) return found->second;
    const auto* numbers = parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr;
    return numbers ? *numbers : std::vector<double>();
}

glm::dvec2 placeSeenAt(const ViewState& state, glm::dvec2 seen) {
    return (seen - state.zoomAt) / static_cast<double>(state.zoom) + state.zoomAt;
}

Request showTarget(ViewState& state, const std::string& name) {
    if (name.empty()) return showPicture(state);
    if (!indexOf(state.targets, name) && !indexOf(state.sampled, name)) return Request::None;
    state.target = name;
    state.show = Show::Target;
    showAnew(state);
    return Request::Draw;
}

void choosePreset(ViewState& state, const std::string& name, const ViewState& start) {
    state.parameters = start.parameters;
    state.preset.clear();
    const auto found = std::ranges::find(state.presets, name, &Preset::name);
    if (name.empty() || found == state.presets.end()) return;
    state.preset = name;
    for (const auto& [parameter, numbers] : found->parameters)
        state.parameters[parameter] = numbers;
}

bool hasSurroundings(const ViewState& state) {
    return indexOf(state.read, kSurroundingsTurn).has_value();
}

bool movesLight(const Input& input) {
    return input.light != glm::dvec2(0) || input.lightWheel != 0 || input.surroundings != 0;
}

bool apply(ViewState& state, const Input& input) {
    const glm::dvec2 none(0);
    Camera& camera = state.workspace.camera;
    if (input.camera != none) orbit(camera, -kTurn * input.camera.x, -kTurn * input.camera.y);
    if (input.pan != none) pan(camera, -input.pan.x, -input.pan.y);
    if (input.wheel != 0 || input.dolly != 0) dolly(camera, std::pow(kNotch, -input.wheel - kNotches * input.dolly));
    if (input.light != none) orbitLight(state.workspace.light, camera, kTurn * input.light.x, kTurn * input.light.y);
    if (input.lightWheel != 0) dollyLight(state.workspace.light, camera, std::pow(kNotch, -input.lightWheel));
    const bool turns = input.surroundings != 0 && hasSurroundings(state);
    if (turns) turnSurroundings(state, input.surroundings);
    return turns || input.camera != none || input.pan != none || input.light != none || input.wheel != 0 || input.dolly != 0 ||
           input.lightWheel != 0;
}

void adopt(ViewState& state, const SessionFrame& frame) {
    state.technique = frame.technique;
    state.targets = frame.targets;
    state.read = frame.parameters;
    state.sampled.clear();
    for (const SessionTexture& texture : frame.textures)
        state.sampled.push_back(texture.name);
    state.passes.clear();
    for (const SessionPass& pass : frame.passes)
        state.passes.push_back(pass.name);
    if (state.show == Show::Pass && state.pass >= state.passes.size()) state.show = Show::Picture;
    if (state.show == Show::Target && !indexOf(state.targets, state.target) && !indexOf(state.sampled, state.target))
        state.show = Show::Picture;
}

void adopt(ViewState& state, const Effect& effect) {
    state.settings = effect.settings ? effect.settings->names : std::vector<std::string>();
    state.setting = effect.settings ? effect.settings->current : std::string();
    state.techniques.clear();
    for (const Technique& technique : effect.techniques)
        if (!technique.name.starts_with('<')) state.techniques.push_back(technique.name); // adopted() adds such
    state.technique = techniqueOf(effect, state.technique);
}

std::string techniqueOf(const Effect& effect, const std::string& asked) {
    const Technique* chosen = asked.empty() ? nullptr : effect.findTechnique(asked);
    if (!chosen) chosen = effect.defaultTechnique();
    return chosen ? chosen->name : std::string();
}

std::size_t passCount(const ViewState& state) {
    return state.show == Show::Pass ? state.pass + 1 : kAllPasses;
}

std::string shownTarget(const ViewState& state, const SessionFrame& frame) {
    if (state.show == Show::Target) return state.target;
    if (state.show == Show::Picture || state.pass >= frame.passes.size()) return {};
    return frame.passes[state.pass].targets.front();
}

std::string shownText(const ViewState& state, const SessionFrame& frame) {
    if (state.show == Show::Target) return fmt::format("{} {}", indexOf(state.sampled, state.target) ? "texture" : "target", state.target);
    if (state.show == Show::Picture) return "picture";
    const std::string target = shownTarget(state, frame);
    return fmt::format("pass {} of {}, {} into {}", state.pass + 1, state.passes.size(), state.passes[state.pass],
                       target.empty() ? "the picture" : target);
}

} // namespace tegument::view
