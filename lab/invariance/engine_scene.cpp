#include "lab/invariance/engine_scene.h"

#include "host/scene/view.h"
#include "meshprep/fur/ribbons/ribbons.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <utility>

namespace tegument::invariance {

namespace {

constexpr const char* kUnit = "gUnitMm";
constexpr const char* kDown = "gFurDown"; // where tips of fur hang, in the world
constexpr const char* kLightMatrix = "gLightViewProjection";

const glm::dmat3 kMirror(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1));

void transformMesh(Mesh& mesh, const glm::dmat3& linear, const glm::dvec3& offset) {
    const double sign = glm::determinant(linear) < 0 ? -1 : 1;
    const glm::dmat3 normals = glm::transpose(glm::inverse(linear));
    for (glm::vec3& p : mesh.positions)
        p = glm::vec3(linear * glm::dvec3(p) + offset);
    for (glm::vec3& n : mesh.normals)
        n = glm::vec3(glm::normalize(normals * glm::dvec3(n)));
    for (glm::vec4& t : mesh.tangents)
        t = glm::vec4(glm::vec3(glm::normalize(linear * glm::dvec3(t))), static_cast<float>(sign) * t.w);
    if (sign < 0)
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    computeBounds(mesh);
    for (MeshPart& part : mesh.parts)
        computeClusters(mesh, part);
}

/// Four numbers of each lamp, as the effects have them (docs/settings.md).
void transformLamps(Workspace& workspace, const glm::dmat3& linear, const glm::dvec3& offset) {
    const auto places = workspace.parameters.find("gLampPlace");
    if (places == workspace.parameters.end()) return;
    std::vector<double>& colours = workspace.parameters.at("gLampColor");
    std::vector<double>& axes = workspace.parameters.at("gLampAxis");
    const double factor = std::cbrt(std::abs(glm::determinant(linear)));
    for (std::size_t i = 0; i + 3 < places->second.size(); i += 4) {
        double* place = places->second.data() + i;
        const bool point = place[3] > 0.5;
        const glm::dvec3 to = linear * glm::dvec3(place[0], place[1], place[2]) + (point ? offset : glm::dvec3(0));
        const glm::dvec3 axis = glm::normalize(linear * glm::dvec3(axes[i], axes[i + 1], axes[i + 2]));
        for (glm::length_t c = 0; c < 3; ++c) {
            place[c] = to[c];
            axes[i + static_cast<std::size_t>(c)] = axis[c];
        }
        colours[i + 3] *= factor;
        if (point) axes[i + 3] *= factor;
    }
}

/// Of points: p becomes linear p + offset; directions are turned only.
void transformView(Workspace& workspace, const glm::dmat3& linear, const glm::dvec3& offset) {
    const auto moved = [&](glm::vec3& p) { p = glm::vec3(linear * glm::dvec3(p) + offset); };
    moved(workspace.camera.position);
    moved(workspace.camera.target);
    moved(workspace.light.position);
    transformLamps(workspace, linear, offset);
    workspace.camera.up = glm::vec3(glm::normalize(linear * glm::dvec3(workspace.camera.up)));
    const auto factor = static_cast<float>(std::cbrt(std::abs(glm::determinant(linear))));
    if (workspace.light.direction) *workspace.light.direction = glm::vec3(glm::normalize(linear * glm::dvec3(*workspace.light.direction)));
    if (workspace.light.width) *workspace.light.width *= factor;
    if (workspace.camera.nearPlane) *workspace.camera.nearPlane *= factor;
    if (workspace.camera.farPlane) *workspace.camera.farPlane *= factor;
}

glm::dmat3 turning(const glm::vec3& degrees) {
    return glm::dmat3(worldMatrix({.position = {}, .rotation = degrees}));
}

glm::dmat4 lightMatrix(const EngineScene& scene) {
    const auto set = scene.set.find(kLightMatrix);
    if (set == scene.set.end())
        return glm::dmat4(lightMatrices(scene.workspace.light, placedBounds(scene.mesh, scene.placement)).viewProjection);
    glm::dmat4 m;
    for (glm::length_t row = 0; row < 4; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            m[row][column] = set->second[static_cast<std::size_t>(4 * row + column)];
    return m;
}

void setLightMatrix(EngineScene& scene, const glm::dmat4& m) {
    std::vector<double>& values = scene.set[kLightMatrix];
    values.clear();
    for (glm::length_t row = 0; row < 4; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            values.push_back(m[row][column]);
}

void turnDown(EngineScene& scene, const glm::dmat3& turn) {
    std::vector<double>& down = scene.workspace.parameters.try_emplace(kDown, std::vector<double>{0, -1, 0}).first->second;
    const glm::dvec3 turned = turn * glm::dvec3(down[0], down[1], down[2]);
    down = {turned.x, turned.y, turned.z};
}

double unitOf(const EngineScene& scene) {
    const auto unit = scene.workspace.parameters.find(kUnit);
    return unit == scene.workspace.parameters.end() ? 1 : unit->second.front();
}

/// Not std::shuffle, whose order the standard leaves open: the same on every machine.
template <class T>
void mix(std::vector<T>& values, std::mt19937& random) {
    for (std::size_t i = values.size(); i > 1; --i)
        std::swap(values[i - 1], values[random() % i]);
}

template <class T>
void permute(std::vector<T>& values, const std::vector<std::uint32_t>& from) {
    if (values.empty()) return;
    std::vector<T> old = std::exchange(values, {});
    for (const std::uint32_t i : from)
        values.push_back(old[i]);
}

} // namespace

void changeMeshUnit(EngineScene& scene, double millimetres) {
    transformMesh(scene.mesh, glm::dmat3(1 / millimetres), glm::dvec3(0));
    scene.placement.scale *= static_cast<float>(millimetres);
}

void changeWorldUnit(EngineScene& scene, double millimetres) {
    assert(!scene.set.contains(kLightMatrix));
    enlarge(scene, 1 / millimetres);
    scene.workspace.parameters[kUnit] = {unitOf(scene) * millimetres};
}

void changeHostUnit(EngineScene& scene, double millimetres) {
    scene.workspace.worldUnitMm = static_cast<float>(millimetres);
    transformLamps(scene.workspace, glm::dmat3(1 / millimetres), glm::dvec3(0));
}

void enlarge(EngineScene& scene, double factor) {
    transformView(scene.workspace, glm::dmat3(factor), glm::dvec3(0));
    scene.placement.scale *= static_cast<float>(factor);
    scene.placement.position *= static_cast<float>(factor);
}

void turnWorld(EngineScene& scene, const glm::vec3& degrees, const glm::vec3& offset) {
    assert(scene.placement.rotation == glm::vec3(0));
    const glm::dmat4 motion = worldMatrix({.position = offset, .rotation = degrees});
    setLightMatrix(scene, lightMatrix(scene) * glm::inverse(motion)); // GLM's order: first back, then into the light's space
    transformView(scene.workspace, glm::dmat3(motion), glm::dvec3(offset));
    scene.placement.position = glm::vec3(transformPoint(motion, glm::dvec3(scene.placement.position)));
    scene.placement.rotation = degrees;
    turnDown(scene, glm::dmat3(motion));
}

void turnWorldAndAim(EngineScene& scene, const glm::vec3& degrees) {
    assert(!scene.set.contains(kLightMatrix));
    turnWorld(scene, degrees, glm::vec3(0));
    scene.set.erase(kLightMatrix);
}

void moveWorld(EngineScene& scene, const glm::vec3& offset) {
    assert(!scene.set.contains(kLightMatrix));
    transformView(scene.workspace, glm::dmat3(1), glm::dvec3(offset));
    scene.placement.position += offset;
}

void turnMesh(EngineScene& scene, const glm::vec3& degrees) {
    assert(scene.placement.rotation == glm::vec3(0));
    transformMesh(scene.mesh, glm::transpose(turning(degrees)), glm::dvec3(0));
    scene.placement.rotation = degrees;
}

void moveMesh(EngineScene& scene, const glm::vec3& offset) {
    const glm::dmat3 linear(worldMatrix(scene.placement));
    transformMesh(scene.mesh, glm::dmat3(1), glm::dvec3(offset));
    scene.placement.position -= glm::vec3(linear * glm::dvec3(offset));
}

void mirrorMesh(EngineScene& scene) {
    assert(scene.placement.rotation == glm::vec3(0));
    transformMesh(scene.mesh, kMirror, glm::dvec3(0));
    scene.placement.scale.x *= -1;
}

void mirrorWorld(EngineScene& scene) {
    assert(!scene.set.contains(kLightMatrix));
    transformView(scene.workspace, kMirror, glm::dvec3(0));
    scene.placement.scale.x *= -1;
    scene.placement.position.x *= -1;
    scene.placement.rotation *= glm::vec3(1, -1, -1);
    turnDown(scene, kMirror);
    scene.mirrored = !scene.mirrored;
}

/// Strands are blended in the order of their triangles, which is theirs to choose: it stays.
void shuffle(EngineScene& scene) {
    Mesh& mesh = scene.mesh;
    std::mt19937 random(1);
    std::vector<MeshPart> ribbons;
    std::ranges::copy_if(mesh.parts, std::back_inserter(ribbons), isRibbons);
    const std::size_t skin = ribbons.empty() ? mesh.indices.size() : ribbons.front().firstIndex; // ribbons are a mesh's last parts
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i + 2 < skin; i += 3) {
        const std::size_t first = random() % 3;
        triangles.push_back({mesh.indices[i + first], mesh.indices[i + (first + 1) % 3], mesh.indices[i + (first + 2) % 3]});
    }
    mix(triangles, random);
    for (std::size_t i = skin; i + 2 < mesh.indices.size(); i += 3)
        triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
    std::vector<std::uint32_t> from(mesh.positions.size());
    std::iota(from.begin(), from.end(), 0U);
    mix(from, random);
    std::vector<std::uint32_t> to(from.size());
    for (std::uint32_t i = 0; i < from.size(); ++i)
        to[from[i]] = i;
    permute(mesh.positions, from);
    permute(mesh.normals, from);
    permute(mesh.tangents, from);
    permute(mesh.uvs, from);
    mesh.indices.clear();
    for (const auto& triangle : triangles)
        for (const std::uint32_t corner : triangle)
            mesh.indices.push_back(to[corner]);
    mesh.parts = {{.name = mesh.name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(skin)}};
    mesh.parts.insert(mesh.parts.end(), ribbons.begin(), ribbons.end());
    computeBounds(mesh);
}

} // namespace tegument::invariance
