#include "tools/view/light_handles.h"

#include "tools/view/orbit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::view {

namespace {

constexpr double kCircle = 0.4; // of the picture's height, about the target
constexpr double kEdge = 0.04;  // of the picture, from its edge
constexpr double kHalfTurn = 3.14159265358979323846;

glm::vec3 withoutBrightness(const glm::vec3& color) {
    const float most = std::max({color.x, color.y, color.z});
    return most > 0 ? color / most : glm::vec3(0);
}

/// A lamp as the workspace's light is; millimetres.
Light lampAt(const std::vector<double>& places, std::size_t lamp, double unit) {
    const double* at = &places[kLampNumbers * (lamp - 1)];
    const glm::vec3 place(static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]));
    Light light;
    if (at[3] != 0)
        light.position = place * static_cast<float>(unit);
    else
        light.direction = -place;
    return light;
}

struct Sight {
    glm::dvec2 place{0.5};
    bool outside = false;
    bool behind = false;
};

Sight sightOf(const Light& light, const Camera& camera, double aspect) {
    const Axes axes = axesOf(camera);
    const glm::dvec3 target(camera.target);
    const double distance = glm::length(glm::dvec3(camera.position) - target);
    const double tangent = std::tan(0.5 * glm::radians(static_cast<double>(camera.horizontalFov)));
    const double circle = kCircle * 2 * distance * tangent / aspect;
    const glm::dvec3 place = light.direction ? target - circle * glm::normalize(glm::dvec3(*light.direction)) : glm::dvec3(light.position);
    const glm::dvec3 from = place - glm::dvec3(camera.position);
    const glm::dvec2 across(glm::dot(from, axes.right), -glm::dot(from, axes.up));
    const double depth = -glm::dot(from, axes.back);
    Sight sight{.place = {}, .outside = depth <= 0, .behind = depth > distance};
    glm::dvec2 seen(across.x, across.y * aspect); // shares of half the picture, but for what follows
    if (depth > 0) seen /= depth * tangent;
    const double most = std::max(std::abs(seen.x), std::abs(seen.y));
    sight.outside = sight.outside || most > 1;
    if (most > 1 - 2 * kEdge || sight.outside) seen *= (1 - 2 * kEdge) / std::max(most, 1e-9);
    sight.place = 0.5 + 0.5 * seen;
    return sight;
}

} // namespace

std::size_t lampCount(const ViewState& state, const Effect& effect) {
    const Parameter* places = effect.findParameter("gLampPlace");
    const bool read = places && std::ranges::find(state.read, places->name) != state.read.end();
    const auto lit = state.workspace.parameters.find("TEGUMENT_LAMPS");
    if (!read || lit == state.workspace.parameters.end() || lit->second.empty()) return 0;
    const std::size_t known = valueOf(state, *places).size() / kLampNumbers;
    return std::min(known, static_cast<std::size_t>(std::max(0.0, lit->second.front())));
}

std::vector<LightHandle> lightHandles(const ViewState& state, const Effect& effect, const Workspace& seen, double aspect) {
    std::vector<LightHandle> handles;
    const auto add = [&](std::string name, std::size_t lamp, const Light& light, const glm::vec3& color) {
        const Sight sight = sightOf(light, seen.camera, aspect);
        handles.push_back({std::move(name), lamp, withoutBrightness(color), sight.place, sight.outside, sight.behind});
    };
    add("light", 0, state.workspace.light, state.workspace.light.color);
    const std::size_t lamps = lampCount(state, effect);
    const Parameter* colors = effect.findParameter("gLampColor");
    if (lamps == 0 || !colors) return handles;
    const std::vector<double> places = valueOf(state, *effect.findParameter("gLampPlace"));
    const std::vector<double> values = valueOf(state, *colors);
    for (std::size_t lamp = 1; lamp <= lamps && kLampNumbers * lamp <= values.size(); ++lamp) {
        const double* color = &values[kLampNumbers * (lamp - 1)];
        add(fmt::format("lamp {}", lamp), lamp, lampAt(places, lamp, static_cast<double>(state.workspace.worldUnitMm)),
            {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])});
    }
    return handles;
}

void turnLight(ViewState& state, const Effect& effect, const LightHandle& handle, glm::dvec2 by) {
    const glm::dvec2 angle = kHalfTurn * by;
    if (handle.lamp == 0) return orbitLight(state.workspace.light, state.workspace.camera, angle.x, angle.y);
    const Parameter* parameter = effect.findParameter("gLampPlace");
    if (!parameter) return;
    std::vector<double> places = valueOf(state, *parameter);
    if (kLampNumbers * handle.lamp > places.size()) return;
    const auto unit = static_cast<double>(state.workspace.worldUnitMm);
    Light light = lampAt(places, handle.lamp, unit);
    orbitLight(light, state.workspace.camera, angle.x, angle.y);
    const glm::dvec3 place = light.direction ? -glm::dvec3(*light.direction) : glm::dvec3(light.position) / unit;
    for (int axis = 0; axis < 3; ++axis)
        places[kLampNumbers * (handle.lamp - 1) + static_cast<std::size_t>(axis)] = place[axis];
    state.parameters[parameter->name] = places;
}

} // namespace tegument::view
