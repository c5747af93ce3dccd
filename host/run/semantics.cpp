#include "host/run/semantics.h"

#include "host/mesh/pose.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

namespace tegument::run {

namespace {

using Numbers = std::vector<double>;

Numbers numbers(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

/// Rows of the row-vector matrix: `m[row][column]` (host/scene/view.h).
Numbers numbers(const glm::mat4& m) {
    Numbers result;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            result.push_back(m[row][column]);
    return result;
}

struct MatrixName {
    std::string_view name;
    bool world;                        // begins with the object's own matrix
    const glm::mat4 Matrices::*matrix; // null: identity
    const glm::mat4 Matrices::*inverse;
};

constexpr std::array kMatrices = {
    MatrixName{"WORLD", true, nullptr, nullptr},
    MatrixName{"VIEW", false, &Matrices::view, &Matrices::inverseView},
    MatrixName{"PROJECTION", false, &Matrices::projection, &Matrices::inverseProjection},
    MatrixName{"WORLDVIEW", true, &Matrices::view, &Matrices::inverseView},
    MatrixName{"VIEWPROJECTION", false, &Matrices::viewProjection, &Matrices::inverseViewProjection},
    MatrixName{"WORLDVIEWPROJECTION", true, &Matrices::viewProjection, &Matrices::inverseViewProjection},
    MatrixName{"PREVIOUSWORLD", true, nullptr, nullptr}, // of the frame before: a picture by itself stands still
    MatrixName{"PREVIOUSVIEWPROJECTION", false, &Matrices::viewProjection, &Matrices::inverseViewProjection},
};

struct MatrixForm {
    std::string_view suffix;
    bool inverse;
    bool transpose;
};

constexpr std::array kForms = {MatrixForm{"", false, false}, MatrixForm{"INVERSE", true, false}, MatrixForm{"TRANSPOSE", false, true},
                               MatrixForm{"INVERSETRANSPOSE", true, true}};

constexpr std::array<std::string_view, 15> kOthers = {"POSITION",       "DIFFUSE",         "CAMERAPOSITION",     "NEARCLIP",
                                                      "FARCLIP",        "FIELDOFVIEW",     "BOUNDINGCENTER",     "BOUNDINGBOXMIN",
                                                      "BOUNDINGBOXMAX", "BOUNDINGBOXSIZE", "BOUNDINGSPHERESIZE", "UNITMM",
                                                      "LIGHTDIRECTION", "TOLIGHT",         "CAMERADIRECTION"};
constexpr std::array<std::string_view, 3> kFrame = {"TIME", "ELAPSEDTIME", "VIEWPORTPIXELSIZE"};

/// A mesh that stands where its file has it keeps the matrices of the view bit for bit.
glm::mat4 withWorld(const glm::mat4& view, const glm::dmat4& world, bool inverse) {
    if (world == glm::dmat4(1)) return view;
    if (inverse) return glm::mat4(glm::inverse(world) * glm::dmat4(view));
    return glm::mat4(glm::dmat4(view) * world); // GLM's order: first world, then view
}

std::optional<glm::mat4> matrixOf(std::string_view semantic, const Matrices& view, const glm::dmat4& world) {
    for (const MatrixName& base : kMatrices)
        for (const MatrixForm& form : kForms) {
            if (!equalsIgnoreCase(semantic, fmt::format("{}{}", base.name, form.suffix))) continue;
            const glm::mat4 Matrices::*member = form.inverse ? base.inverse : base.matrix;
            glm::mat4 matrix = member ? view.*member : glm::mat4(1);
            if (base.world) matrix = withWorld(matrix, world, form.inverse);
            return form.transpose ? glm::transpose(matrix) : matrix;
        }
    return std::nullopt;
}

enum class Owner { Camera, Light };

Result<Owner> ownerOf(const Parameter& parameter) {
    const std::string object = parameter.annotations.string("Object").value_or("Camera");
    for (const std::string_view light : {"PointLight0", "PointLight", "Light0", "Light"})
        if (equalsIgnoreCase(object, light)) return Owner::Light;
    for (const std::string_view camera : {"Camera", "Geometry"})
        if (equalsIgnoreCase(object, camera)) return Owner::Camera;
    const std::vector<std::string> known = {"PointLight0", "Camera", "Geometry"};
    const std::string near = didYouMean(object, known);
    return inputError(4014, parameter.at, fmt::format("{} names an unknown object '{}'", parameter.name, object),
                      near.empty() ? "this host has PointLight0, Camera and Geometry" : near);
}

std::optional<Numbers> ofOwner(std::string_view semantic, Owner owner, const SceneView& scene) {
    const bool light = owner == Owner::Light;
    const Matrices& view = light ? scene.light : scene.camera;
    if (semantic == "position" && light) return numbers(view.position);
    if (semantic == "cameraposition") return numbers(scene.camera.position);
    if (semantic == "diffuse" && light) return numbers(scene.placed.light.color);
    if (semantic == "nearclip") return Numbers{view.nearPlane};
    if (semantic == "farclip") return Numbers{view.farPlane};
    if (semantic == "fieldofview") return Numbers{view.horizontalFov};
    if (semantic == "unitmm") return Numbers{scene.unitMm};
    if (semantic == "time" || semantic == "elapsedtime") return Numbers{0.0};
    return std::nullopt;
}

/// Unit vectors: where light goes at the mesh's centre, where it comes from, where the camera looks.
std::optional<Numbers> directionOf(std::string_view semantic, const SceneView& scene) {
    const glm::vec3 light =
        scene.placed.light.direction ? *scene.placed.light.direction : scene.bounds.centre - scene.placed.light.position;
    const glm::vec3 view = scene.placed.camera.target - scene.placed.camera.position;
    if (semantic == "lightdirection") return numbers(glm::normalize(light));
    if (semantic == "tolight") return numbers(-glm::normalize(light));
    if (semantic == "cameradirection") return numbers(glm::normalize(view));
    return std::nullopt;
}

std::optional<Numbers> ofBounds(std::string_view semantic, const Bounds& bounds) {
    if (semantic == "boundingcenter") return numbers(bounds.centre);
    if (semantic == "boundingboxmin") return numbers(bounds.minimum);
    if (semantic == "boundingboxmax") return numbers(bounds.maximum);
    if (semantic == "boundingboxsize") return numbers(bounds.maximum - bounds.minimum);
    if (semantic == "boundingspheresize") return Numbers{bounds.radius};
    return std::nullopt;
}

/// The top left corner of a matrix, for float3x3 and float4x3.
Numbers corner(const Numbers& matrix, const Type& type) {
    Numbers result;
    for (int row = 0; row < type.rows; ++row)
        for (int column = 0; column < type.columns; ++column)
            result.push_back(matrix[static_cast<std::size_t>(row * 4 + column)]);
    return result;
}

/// float4 takes a float3 with 1 behind it: a position's w, a colour's alpha.
Result<std::optional<Numbers>> fitted(const Parameter& parameter, Numbers value) {
    const Type& type = parameter.type;
    if (type.elements == 0 && value.size() == 16 && type.rows > 1) return std::optional(corner(value, type));
    if (type.elements == 0 && type.rows == 1 && type.columns == 4 && value.size() == 3) value.push_back(1);
    if (type.elements != 0 || type.base != BaseType::Float || type.scalarCount() != static_cast<int>(value.size()))
        return inputError(
            4013, parameter.at,
            fmt::format("{} is a {}; the semantic {} has {} numbers", parameter.name, type.name, parameter.semantic, value.size()),
            "docs/conventions.md lists the types");
    return std::optional(std::move(value));
}

/// From mm. With 1 mm in a unit nothing is rounded.
void intoWorldUnits(SceneView& scene) {
    const float factor = 1 / scene.unitMm;
    scene.bounds = inUnit(scene.bounds, factor);
    scene.seen = inUnit(scene.seen, factor);
    scene.placed = inUnit(scene.placed, factor);
    for (glm::length_t row = 0; row < 4; ++row)
        scene.world[row] *= glm::dvec4(glm::dvec3(1 / static_cast<double>(scene.unitMm)), 1);
}

void fillMatrices(SceneView& scene, Extent picture) {
    if (scene.unitMm != 1) intoWorldUnits(scene);
    scene.camera = cameraMatrices(scene.placed.camera, static_cast<double>(picture.width) / picture.height);
    scene.light = lightMatrices(scene.placed.light, scene.seen);
}

Bounds unitBounds() {
    return {.minimum = glm::vec3(-1), .maximum = glm::vec3(1), .centre = glm::vec3(0), .radius = 1};
}

} // namespace

SceneView viewScene(const Workspace& workspace, const Mesh* mesh, Extent picture) {
    SceneView scene{.hasMesh = mesh != nullptr,
                    .unitMm = workspace.worldUnitMm,
                    .bounds = mesh ? mesh->bounds : unitBounds(),
                    .seen = mesh ? seenBounds(*mesh) : unitBounds(),
                    .camera = {},
                    .light = {}};
    scene.placed = placeScene(workspace, scene.seen);
    fillMatrices(scene, picture);
    return scene;
}

SceneView viewScene(const PlacedObject& object, const Mesh& mesh, Extent picture) {
    SceneView scene{.hasMesh = true,
                    .unitMm = object.worldUnitMm,
                    .bounds = placedBounds(mesh, object.placement),
                    .seen = placedBounds(mesh, object.placement),
                    .world = worldMatrix(object.placement),
                    .placed = object.scene,
                    .camera = {},
                    .light = {}};
    fillMatrices(scene, picture);
    return scene;
}

bool isMirrored(const SceneView& scene) {
    return glm::determinant(glm::dmat3(scene.world)) < 0;
}

Result<std::optional<std::vector<double>>> semanticValue(const Parameter& parameter, const SceneView& scene) {
    if (parameter.semantic.empty() || !parameter.type.isNumeric()) return std::optional<Numbers>();
    const auto owner = ownerOf(parameter);
    if (!owner) return owner.error();
    const std::string semantic = toLower(parameter.semantic);
    if (const auto matrix = matrixOf(semantic, *owner == Owner::Light ? scene.light : scene.camera, scene.world))
        return fitted(parameter, numbers(*matrix));
    if (auto value = ofOwner(semantic, *owner, scene)) return fitted(parameter, std::move(*value));
    if (auto value = directionOf(semantic, scene)) {
        if (parameter.type.columns == 4) value->push_back(0); // a direction is not moved
        return fitted(parameter, std::move(*value));
    }
    if (auto value = ofBounds(semantic, scene.bounds); value && scene.hasMesh) return fitted(parameter, std::move(*value));
    return std::optional<Numbers>();
}

bool asksForMesh(const Parameter& parameter) {
    return ofBounds(toLower(parameter.semantic), {}).has_value();
}

bool isViewportSize(const Parameter& parameter) {
    return parameter.type.isNumeric() && equalsIgnoreCase(parameter.semantic, "VIEWPORTPIXELSIZE");
}

const std::vector<std::string>& numericSemantics() {
    static const std::vector<std::string> kNames = [] {
        std::vector<std::string> names;
        for (const MatrixName& base : kMatrices)
            for (const MatrixForm& form : kForms)
                names.push_back(fmt::format("{}{}", base.name, form.suffix));
        names.insert(names.end(), kOthers.begin(), kOthers.end());
        names.insert(names.end(), kFrame.begin(), kFrame.end());
        return names;
    }();
    return kNames;
}

Bounds boundsOf(const SessionScene& scene) {
    if (!scene.objects.empty()) {
        std::vector<PlacedMesh> meshes;
        for (const RunObject& object : scene.objects)
            meshes.push_back({.mesh = object.mesh, .placement = object.placement});
        return boundsOfAll(meshes);
    }
    if (scene.mesh) return scene.mesh->bounds;
    return {.minimum = glm::vec3(-1), .maximum = glm::vec3(1), .centre = glm::vec3(0), .radius = 1};
}

Workspace inWorld(const Workspace& workspace, const SessionScene& scene) {
    const PlacedScene placed = placeScene(workspace, boundsOf(scene));
    Workspace world = workspace;
    world.cameraRelative = false;
    world.lightRelative = false;
    world.camera = placed.camera;
    world.camera.nearPlane = workspace.camera.nearPlane;
    world.camera.farPlane = workspace.camera.farPlane;
    world.light = placed.light;
    return world;
}

} // namespace tegument::run
