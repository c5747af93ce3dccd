#include "lab/bench/scenes.h"

#include "host/support/file.h"
#include "host/support/text.h"
#include "lab/bench/shapes.h"
#include "meshprep/assets/names.h"
#include "meshprep/assets/scene.h"
#include "meshprep/write/write_mesh.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace tegument::bench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kDistance = 600; // mm from the middle to camera and light
constexpr double kBehind = 165;   // degrees
constexpr double kLargestAngle = 180;
constexpr double kFill = 0.9; // of the picture's smaller side that a body takes
constexpr const char* kVariants = "NAME[@LIGHT][+shadow][+bumps][+checker][+Npx], for example sphere-10@90+checker+4px";

std::optional<double> number(std::string_view text) {
    double value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

bool isPlane(const std::string& shape) {
    return shape == "plane-edge" || shape == "plane-disc";
}

std::optional<std::string> addLight(SceneName& name, std::string_view word) {
    const auto angle = word == "behind" ? std::optional(kBehind) : number(word);
    if (!angle || *angle < 0 || *angle > kLargestAngle)
        return fmt::format("'@{}' is no light: 0 to 180 degrees from the camera, or behind", word);
    if (isPlane(name.shape) && (*angle < 15 || *angle > 75)) return "a plane's light stands 15 to 75 degrees from the camera";
    name.light = angle;
    return std::nullopt;
}

std::optional<std::string> addVariant(SceneName& name, std::string_view word) {
    if (word == "shadow") {
        name.shadow = true;
    } else if (word == "bumps") {
        name.bumps = true;
    } else if (word == "checker") {
        name.checker = true;
    } else {
        const bool pixels = word.ends_with("px");
        name.pixelsPerMm = pixels ? number(word.substr(0, word.size() - 2)) : std::nullopt;
        if (!name.pixelsPerMm || *name.pixelsPerMm < 0.01 || *name.pixelsPerMm > 1000) return fmt::format("no variant '+{}'", word);
    }
    return std::nullopt;
}

Mesh shapeOf(const SceneName& name, double light) {
    if (name.shape == "plane-edge") return planeWithEdge(light);
    if (name.shape == "plane-disc") return planeWithDisc(light);
    if (name.shape == "cylinder") return cylinder();
    if (name.shape == "lobes") return lobes();
    return sphere(*number(std::string_view(name.shape).substr(std::string_view("sphere-").size())));
}

/// Side of what should be seen, mm.
double extentOf(const SceneName& name, const Mesh& mesh) {
    if (isPlane(name.shape)) return 24;
    const glm::vec3 size = mesh.bounds.maximum - mesh.bounds.minimum;
    return static_cast<double>(std::max(size.x, size.y));
}

void replaceTexture(Mesh& mesh, const std::string& role, Image image) {
    std::erase_if(mesh.textures, [&](const EmbeddedTexture& texture) { return texture.role == role; });
    mesh.textures.push_back({.role = role, .image = std::move(image)});
}

/// Where camera and light of a named scene stand.
struct View {
    glm::dvec3 eye{0, 0, kDistance};
    glm::dvec3 target{0};
    glm::dvec3 up{0, 1, 0};
    double horizontalFov = 25; // degrees
    glm::dvec3 light{0};
    glm::dvec3 colour{1.5};
    glm::dvec3 background{0};

    [[nodiscard]] glm::dvec3 towardsEye() const { return glm::normalize(eye - target); }
};

/// From the camera's direction towards the right, a little upwards; for the planes straight to the left, as their shadows want it.
glm::dvec3 lightDirection(const View& view, double degrees, bool plane) {
    const glm::dvec3 forward = view.towardsEye();
    const glm::dvec3 right = glm::normalize(glm::cross(view.up, forward));
    const glm::dvec3 up = glm::cross(forward, right);
    const double rise = plane ? 0 : glm::radians(30.0);
    const glm::dvec3 side = plane ? -right : right * std::cos(rise) + up * std::sin(rise);
    return forward * std::cos(glm::radians(degrees)) + side * std::sin(glm::radians(degrees));
}

/// The field of view in which a millimetre at the target has so many pixels.
double fovFor(const View& view, double pixelsPerMm, int width) {
    return glm::degrees(2 * std::atan(width / (2 * pixelsPerMm * glm::length(view.eye - view.target))));
}

std::string viewJson(const SceneName& name, const fs::path& mesh, const std::string& attribution, const View& view) {
    const auto list = [](const glm::dvec3& v) { return Json{v.x, v.y, v.z}; };
    Json json{{"mesh", mesh.string()}, {"head", name.shape == "head"}};
    if (!attribution.empty()) json["attribution"] = attribution;
    if (name.shape != "head") json["unit_mm"] = 1000;
    json["camera"] = {{"frame", "world"},
                      {"position", list(view.eye)},
                      {"target", list(view.target)},
                      {"up", list(view.up)},
                      {"horizontal_fov", view.horizontalFov}};
    json["light"] = {{"frame", "world"}, {"position", list(view.light)}, {"color", list(view.colour)}};
    json["background"] = list(view.background);
    return json.dump(2) + "\n";
}

/// What makes two meshes the same file.
std::string meshHash(const Mesh& mesh) {
    std::string bytes;
    const auto add = [&](const auto& values) {
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
    };
    add(mesh.positions);
    add(mesh.normals);
    add(mesh.uvs);
    add(mesh.indices);
    for (const EmbeddedTexture& texture : mesh.textures) {
        bytes += texture.role;
        add(texture.image.pixels);
    }
    return contentHash(bytes).substr(0, 8);
}

/// Writes mesh and workspace where they are not yet.
Result<fs::path> writeScene(const SceneName& name, const std::string& text, const Mesh& mesh, const View& view,
                            const SceneOptions& options) {
    const fs::path folder = options.folder.empty() ? cacheFolder() / "bench" / "scenes" : options.folder;
    const fs::path glb = fmt::format("{}-{}.glb", name.shape, meshHash(mesh));
    std::error_code code;
    if (!fs::exists(folder / glb, code)) {
        fs::create_directories(folder, code);
        if (const auto written = writeGlb(folder / glb, mesh); !written) return written.error();
    }
    const fs::path file = folder / fmt::format("{}-{}x{}.json", text, options.width, options.height);
    if (const auto written = writeFile(file, viewJson(name, glb, mesh.attribution, view)); !written) return written.error();
    return file;
}

void decorate(const SceneName& name, Mesh& mesh) {
    if (name.checker) replaceTexture(mesh, "color", checkerMap());
    if (name.bumps) replaceTexture(mesh, "normal", bumpMap());
}

Result<fs::path> makeShape(const SceneName& name, const std::string& text, const SceneOptions& options) {
    const double light = name.light.value_or(isPlane(name.shape) ? 45 : 60);
    Mesh mesh = shapeOf(name, light);
    View view;
    const double fit = kFill * std::min(options.width, options.height) / extentOf(name, mesh);
    view.horizontalFov = fovFor(view, name.pixelsPerMm.value_or(fit), options.width);
    const glm::dvec3 direction = lightDirection(view, light, isPlane(name.shape));
    view.light = direction * kDistance;
    decorate(name, mesh);
    if (name.shadow && !addBar(mesh, direction)) return usageError(8073, fmt::format("{}: its texture has no room for a bar", text), {});
    return writeScene(name, text, mesh, view, options);
}

Result<fs::path> makeHead(const SceneName& name, const std::string& text, const SceneOptions& options) {
    const fs::path portrait = options.effects / "workspaces" / "human.json";
    if (!name.light && !name.shadow && !name.bumps && !name.checker && !name.pixelsPerMm) return portrait;
    const auto workspace = loadWorkspace(portrait, assets::workspaceOptions());
    if (!workspace) return workspace.error();
    auto mesh = loadMesh(workspace->meshPath, meshOptions(*workspace));
    if (!mesh) return mesh.error();
    const PlacedScene placed = placeScene(*workspace, mesh->bounds);
    View view{.eye = placed.camera.position,
              .target = placed.camera.target,
              .up = placed.camera.up,
              .horizontalFov = static_cast<double>(placed.camera.horizontalFov),
              .light = placed.light.position,
              .colour = placed.light.color,
              .background = workspace->background};
    if (name.pixelsPerMm) view.horizontalFov = fovFor(view, *name.pixelsPerMm, options.width);
    const glm::dvec3 centre(mesh->bounds.centre);
    if (name.light) view.light = centre + lightDirection(view, *name.light, false) * glm::length(view.light - centre);
    decorate(name, *mesh);
    if (name.shadow && !addBar(*mesh, glm::normalize(view.light - centre)))
        return usageError(8073, fmt::format("{}: the head's texture has no room for a bar", text), "leave +shadow out");
    return writeScene(name, text, *mesh, view, options);
}

/// The workspace that it names as a file, or by its name as -w takes it where no scene is called so.
std::optional<fs::path> workspaceOf(const std::string& text) {
    std::error_code code;
    if (text.ends_with(".json") || fs::is_regular_file(text, code)) return fs::path(text);
    if (parseSceneName(text)) return std::nullopt;
    const auto found = assets::findWorkspace(text, {});
    return found ? std::optional(*found) : std::nullopt;
}

/// The workspace's textures win over the mesh file's, as when an effect is drawn.
Result<void> takeTextures(Scene& scene) {
    for (const auto& [role, names] : {std::pair{"color", std::pair{"DIFFUSE", "gSkinMap"}}, {"normal", {"NORMAL", "gNormalMap"}}})
        for (const auto& [name, file] : scene.workspace.textures) {
            if (!equalsIgnoreCase(name, names.first) && name != names.second) continue;
            auto image = loadImage(scene.workspace.file.parent_path() / file);
            if (!image) return image.error();
            replaceTexture(scene.mesh, role, std::move(*image));
        }
    return {};
}

Result<Scene> read(const std::string& name, const fs::path& file, bool needsUvs) {
    auto workspace = loadWorkspace(file, assets::workspaceOptions());
    if (!workspace) return workspace.error();
    if (!workspace->objects.empty())
        return usageError(8074, fmt::format("{} has {} objects: a comparison has one mesh", file.string(), workspace->objects.size()),
                          "give a workspace of one mesh");
    auto mesh = loadMesh(file.parent_path() / workspace->meshPath, [&] {
        MeshOptions options = meshOptions(*workspace);
        options.requireUvs = needsUvs;
        return options;
    }());
    if (!mesh) return mesh.error();
    Scene scene{.name = name, .file = file, .workspace = std::move(*workspace), .mesh = std::move(*mesh)};
    if (!scene.workspace.attribution.empty()) scene.mesh.attribution = scene.workspace.attribution;
    if (const auto taken = takeTextures(scene); !taken) return taken.error();
    return scene;
}

} // namespace

const std::vector<std::string>& sceneShapes() {
    static const std::vector<std::string> kShapes = {"plane-edge", "plane-disc", "sphere-5", "sphere-10",
                                                     "sphere-20",  "cylinder",   "lobes",    "head"};
    return kShapes;
}

Result<SceneName> parseSceneName(const std::string& text) {
    const std::size_t end = std::min(text.find_first_of("@+"), text.size());
    SceneName name{.shape = text.substr(0, end), .light = {}};
    if (std::ranges::find(sceneShapes(), name.shape) == sceneShapes().end())
        return usageError(8072, fmt::format("--scene {}: neither a scene's name nor a workspace file", text),
                          fmt::format("the scenes are {}", fmt::join(sceneShapes(), ", ")));
    for (std::size_t at = end; at < text.size();) {
        const std::size_t next = std::min(text.find_first_of("@+", at + 1), text.size());
        const std::string_view word = std::string_view(text).substr(at + 1, next - at - 1);
        if (const auto wrong = text[at] == '@' ? addLight(name, word) : addVariant(name, word))
            return usageError(8073, fmt::format("--scene {}: {}", text, *wrong), kVariants);
        at = next;
    }
    return name;
}

Result<void> checkSceneName(const std::string& text) {
    if (workspaceOf(text)) return {};
    const auto name = parseSceneName(text);
    return name ? Result<void>() : name.error();
}

Result<Scene> loadScene(const std::string& text, const SceneOptions& options) {
    if (const auto file = workspaceOf(text)) return read(file->stem().string(), *file, options.needsUvs);
    const auto name = parseSceneName(text);
    if (!name) return name.error();
    const auto file = name->shape == "head" ? makeHead(*name, text, options) : makeShape(*name, text, options);
    if (!file) return file.error();
    return read(text, *file, options.needsUvs);
}

} // namespace tegument::bench
