#include "lab/invariance/cases.h"

#include <algorithm>
#include <cmath>

namespace tegument::invariance {

namespace {

constexpr double kInch = 25.4;
constexpr glm::vec3 kTurns[] = {{37, -81, 123}, {-64.3F, 12.1F, -151.7F}, {5, 170, 88}}; // degrees
constexpr glm::vec3 kUpright{0, 73, 0};                                                  // about the vertical: the light's map keeps its up
constexpr glm::vec3 kOffset{310, -170, 530};                                             // mm
constexpr float kFar = 4; // of those: 2.6 m, 23 radii of the head. Farther away floats move outlines over single pixels

void everything(EngineScene& scene, const Subject& /*subject*/) {
    moveMesh(scene, kOffset);
    changeMeshUnit(scene, kInch);
    changeWorldUnit(scene, 1000);
    turnWorld(scene, kTurns[0], kOffset / 1000.0F);
}

void parallelLight(EngineScene& scene, const Subject& /*subject*/) {
    Light& light = scene.workspace.light;
    light.direction = glm::normalize(scene.workspace.camera.target - light.position);
}

/// A head of 40 mm, whose ears are as thin as real ones, and light from the other side, which shines through them.
void fromBehind(EngineScene& scene, const Subject& /*subject*/) {
    enlarge(scene, 0.2);
    glm::vec3& light = scene.workspace.light.position;
    light = 2.0F * scene.workspace.camera.target - light;
}

void inMetres(EngineScene& scene, const Subject& /*subject*/) {
    changeMeshUnit(scene, 1000);
    changeWorldUnit(scene, 1000);
}

/// Each slider that the shaders read, a little further; whole steps.
std::map<std::string, std::vector<double>> otherValues(const EngineScene& scene, const Subject& subject) {
    constexpr double kFurther = 0.05; // of what is left of its range
    std::map<std::string, std::vector<double>> values;
    for (const Parameter& parameter : subject.effect.parameters) {
        const auto most = parameter.annotations.numbers("UIMax");
        const auto least = parameter.annotations.numbers("UIMin");
        if (!most || !least || !subject.reads.contains(parameter.name) || !parameter.defaultValue) continue;
        const auto given = scene.workspace.parameters.find(parameter.name);
        const auto* numbers = std::get_if<std::vector<double>>(&*parameter.defaultValue);
        if (!numbers) continue;
        std::vector<double> value = given == scene.workspace.parameters.end() ? *numbers : given->second;
        const double step = parameter.annotations.numbers("UIStep").value_or(std::vector<double>{1}).front();
        for (double& v : value)
            v = std::min(most->front(), v + step * std::ceil(kFurther * (most->front() - v) / step));
        values[parameter.name] = std::move(value);
    }
    return values;
}

void byWorkspace(EngineScene& scene, const Subject& subject) {
    for (const auto& [name, value] : otherValues(scene, subject))
        scene.workspace.parameters[name] = value;
}

/// The workspace says other things, which --set overrules.
void bySet(EngineScene& scene, const Subject& subject) {
    for (const Parameter& parameter : subject.effect.parameters) {
        const auto value = scene.workspace.parameters.find(parameter.name);
        if (value == scene.workspace.parameters.end()) continue;
        scene.set[parameter.name] = value->second;
        if (const auto least = parameter.annotations.numbers("UIMin")) std::ranges::fill(value->second, least->front());
    }
}

template <class Function>
auto alone(Function function) {
    return [function](EngineScene& scene, const Subject&) { function(scene); };
}

std::vector<Case> unitCases() {
    std::vector<Case> cases;
    const std::pair<const char*, double> kUnits[] = {{"centimetres", 10}, {"metres", 1000}, {"inches", kInch}};
    for (const auto& [name, mm] : kUnits)
        cases.push_back({"mesh's unit",
                         std::string("mesh in ") + name,
                         Asks::Nothing,
                         alone([mm = mm](EngineScene& s) { changeMeshUnit(s, mm); }),
                         {}});
    for (const double mm : {1e-3, 1e-2, 0.37, 3.0})
        cases.push_back({"world matrix scales",
                         "world matrix scales by " + std::to_string(mm).substr(0, 5),
                         Asks::Nothing,
                         alone([mm](EngineScene& s) { changeMeshUnit(s, mm); }),
                         {}});
    for (const auto& [name, mm] : kUnits)
        cases.push_back({"world's unit",
                         std::string("world and mesh in ") + name,
                         Asks::Nothing,
                         alone([mm = mm](EngineScene& s) {
                             changeMeshUnit(s, mm);
                             changeWorldUnit(s, mm);
                         }),
                         {}});
    cases.push_back({"world's unit",
                     "world in metres, mesh in millimetres",
                     Asks::Nothing,
                     alone([](EngineScene& s) { changeWorldUnit(s, 1000); }),
                     {}});
    cases.push_back(
        {"world's unit", "world_unit_mm of the workspace is 10", Asks::Nothing, alone([](EngineScene& s) { changeHostUnit(s, 10); }), {}});
    cases.push_back({"world's unit", "world and mesh in metres, lit from behind", Asks::Nothing, inMetres, fromBehind});
    for (const double factor : {0.01, kInch})
        cases.push_back({"size",
                         "everything times " + std::to_string(factor).substr(0, 5),
                         Asks::NoLengths,
                         alone([factor](EngineScene& s) { enlarge(s, factor); }),
                         {}});
    return cases;
}

std::vector<Case> motionCases() {
    std::vector<Case> cases;
    for (std::size_t i = 0; i < std::size(kTurns); ++i)
        cases.push_back({"turned",
                         "scene turned, " + std::to_string(i + 1),
                         Asks::Nothing,
                         alone([i](EngineScene& s) { turnWorld(s, kTurns[i], glm::vec3(0)); }),
                         {}});
    cases.push_back(
        {"turned", "scene turned about the vertical", Asks::Nothing, alone([](EngineScene& s) { turnWorldAndAim(s, kUpright); }), {}});
    cases.push_back({"turned", "mesh with z up", Asks::NoMeshAxes, alone([](EngineScene& s) { turnMesh(s, {-90, 0, 0}); }), {}});
    cases.push_back({"turned", "mesh with odd axes", Asks::NoMeshAxes, alone([](EngineScene& s) { turnMesh(s, kTurns[1]); }), {}});
    cases.push_back({"moved", "scene moved", Asks::Nothing, alone([](EngineScene& s) { moveWorld(s, kOffset); }), {}});
    cases.push_back({"moved", "scene moved far", Asks::Nothing, alone([](EngineScene& s) { moveWorld(s, kFar * kOffset); }), {}});
    cases.push_back({"moved", "mesh with its origin elsewhere", Asks::Nothing, alone([](EngineScene& s) { moveMesh(s, kOffset); }), {}});
    cases.push_back({"mirrored", "mesh mirrored, and back", Asks::NoMeshAxes, alone([](EngineScene& s) { mirrorMesh(s); }), {}});
    cases.push_back({"mirrored", "scene in a mirror", Asks::MirrorPicture, alone([](EngineScene& s) { mirrorWorld(s); }), {}});
    return cases;
}

std::vector<Case> orderCases() {
    return {{"order", "triangles and vertices shuffled", Asks::Nothing, alone([](EngineScene& s) { shuffle(s); }), {}},
            {"two draws", "each draw in two", Asks::Nothing, alone([](EngineScene& s) { s.split = true; }), {}},
            {"values", "values by --set", Asks::Nothing, bySet, byWorkspace},
            {"all at once", "in inches in a world of metres, turned, moved", Asks::Nothing, everything, {}},
            {"all at once", "the same under parallel light", Asks::Nothing, everything, parallelLight}};
}

/// Every case again, in a scene with several lights.
std::vector<Case> withLamps(const std::vector<Case>& cases) {
    std::vector<Case> lit;
    for (const Case& each : cases) {
        Case copy = each;
        copy.limitsOf = each.column;
        copy.column = "several lights";
        copy.name = "several lights: " + each.name;
        copy.lamps = true;
        lit.push_back(std::move(copy));
    }
    return lit;
}

} // namespace

std::vector<std::pair<std::string, std::string>> lampDefines() {
    return {{"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_SOFT_SHADOWS", "1"}};
}

void addLamps(EngineScene& scene) {
    auto& values = scene.workspace.parameters;
    values["gLampPlace"] = {0.85, 0.1, 0.5, 0, -260, 160, -200, 1, 150, 40, 60, 1};
    values["gLampColor"] = {0.25, 0.27, 0.30, 0, 0.8, 0.7, 0.6, 300, 0.3, 0.5, 0.7, 120};
    const glm::dvec3 spot = glm::normalize(glm::dvec3(260, -160, 200)); // as long as transformLamps() leaves it
    values["gLampAxis"] = {0, 0, -1, 0.15, spot.x, spot.y, spot.z, 15, 0, 0, -1, 8};
    values["gLampSpot"] = {-1, -2, 1, 1, 0.98, 0.93, 1, 1, -1, -2, 1, 0.5};
}

const std::vector<Case>& allCases() {
    static const std::vector<Case> kCases = [] {
        std::vector<Case> cases;
        for (const auto& some : {unitCases(), motionCases(), orderCases()})
            cases.insert(cases.end(), some.begin(), some.end());
        const std::vector<Case> lit = withLamps(cases);
        cases.insert(cases.end(), lit.begin(), lit.end());
        return cases;
    }();
    return kCases;
}

} // namespace tegument::invariance
