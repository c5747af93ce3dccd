// Workspace files: JSON -> Workspace, key by key. docs/workspace.md is the schema.

#include "host/scene/workspace.h"

#include "host/scene/located_json.h"
#include "host/support/file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

namespace tegument {

namespace fs = std::filesystem;

namespace {

/// The command that fills this file's folder of the cache; empty for other files.
std::string commandThatMakes(const fs::path& file, const WorkspaceOptions& options) {
    const fs::path inCache = file.lexically_normal().lexically_relative(cacheFolder().lexically_normal());
    const auto found = options.makers.find(inCache.empty() ? std::string() : inCache.begin()->string());
    return found == options.makers.end() ? std::string() : found->second;
}

/// Reads the tree into the workspace.
class WorkspaceReader : LocatedReader {
public:
    WorkspaceReader(std::string_view text, const fs::path& path, const WorkspaceOptions& options)
        : LocatedReader(text, path), options_(options) {}

    Result<Workspace> read(const LocatedJson& root) {
        workspace_.file = path_;
        readObject(root, "the workspace",
                   withMeshKeys(
                       workspace_,
                       {{"objects", [&](const LocatedJson& v) { readObjects(v); }},
                        {"world_unit_mm", [&](const LocatedJson& v) { workspace_.worldUnitMm = real(v, "world_unit_mm", kLeast, kMost); }},
                        {"camera", [&](const LocatedJson& v) { readCamera(v); }},
                        {"light", [&](const LocatedJson& v) { readLight(v); }},
                        {"background", [&](const LocatedJson& v) { workspace_.background = color(v, "background"); }},
                        {"textures", [&](const LocatedJson& v) { readTextures(v, workspace_.textures); }},
                        {"parameters", [&](const LocatedJson& v) { readParameters(v, workspace_.parameters); }},
                        {"technique", [&](const LocatedJson& v) { workspace_.technique = string(v, "technique"); }},
                        {"setting", [&](const LocatedJson& v) { workspace_.setting = string(v, "setting"); }},
                        {"size", [&](const LocatedJson& v) { readSize(v); }},
                        {"samples", [&](const LocatedJson& v) { readSamples(v); }},
                        {"bind", [&](const LocatedJson& v) { readBinds(v); }},
                        {"pose", [&](const LocatedJson& v) { workspace_.pose = expandedPath(v, "pose"); }},
                        {"pose_before", [&](const LocatedJson& v) { workspace_.poseBefore = expandedPath(v, "pose_before"); }}}));
        refuseMeshBesideObjects(root);
        if (error_) return *error_;
        inMillimetres();
        return std::move(workspace_);
    }

private:
    static constexpr double kLeast = 1e-6; // of lengths and units; nothing smaller is meant
    static constexpr double kMost = 1e9;
    static constexpr std::size_t kMostObjects = 256; // the script runs once for each

    /// Lengths of the world are written in its unit; those in the frame "mesh" have none.
    void inMillimetres() {
        const float unit = workspace_.worldUnitMm;
        Camera& camera = workspace_.camera;
        Light& light = workspace_.light;
        for (SceneObject& object : workspace_.objects)
            object.placement.position *= unit;
        for (std::optional<float>* plane : {&camera.nearPlane, &camera.farPlane})
            if (*plane) **plane *= unit;
        if (!workspace_.cameraRelative) {
            camera.position *= unit;
            camera.target *= unit;
        }
        if (workspace_.lightRelative) return;
        light.position *= unit;
        if (light.width) *light.width *= unit;
    }

    struct Key {
        std::string name;
        std::function<void(const LocatedJson&)> read;
    };

    /// Until the first error; "comment" is allowed everywhere and means nothing.
    template <class Visit>
    void forEachMember(const LocatedJson& object, Visit visit) {
        for (std::size_t i = 0; i < object.items.size() && !error_; ++i)
            if (object.keys[i] != "comment") visit(object.keys[i], object.items[i]);
    }

    /// Hands each member to its key.
    void readObject(const LocatedJson& value, const std::string& what, const std::vector<Key>& keys) {
        if (!expect(value, LocatedJson::Kind::Object, what)) return;
        forEachMember(value, [&](const std::string& name, const LocatedJson& member) {
            const auto key = std::ranges::find(keys, name, &Key::name);
            if (key == keys.end()) return unknownKey(name, member, what, keys);
            key->read(member);
        });
    }

    void unknownKey(const std::string& name, const LocatedJson& member, const std::string& what, const std::vector<Key>& keys) {
        std::vector<std::string> names;
        std::string all;
        for (const Key& key : keys) {
            names.push_back(key.name);
            all += (all.empty() ? "" : ", ") + key.name;
        }
        const std::string near = didYouMean(name, names);
        fail(5401, member, fmt::format("unknown key '{}' in {}", name, what), near.empty() ? "known keys: " + all + ", comment" : near);
    }

    /// The keys that say which mesh, in front of others.
    std::vector<Key> withMeshKeys(MeshSource& source, const std::vector<Key>& others) {
        std::vector<Key> keys = {{"mesh", [&](const LocatedJson& v) { readMeshPath(v, source); }},
                                 {"unit_mm", [&](const LocatedJson& v) { source.unitMm = number(v, "unit_mm", kLeast, kMost); }},
                                 {"flip_v", [&](const LocatedJson& v) { source.flipV = boolean(v, "flip_v"); }},
                                 {"head", [&](const LocatedJson& v) { source.head = boolean(v, "head"); }},
                                 {"attribution", [&](const LocatedJson& v) { source.attribution = string(v, "attribution"); }}};
        keys.insert(keys.end(), others.begin(), others.end());
        return keys;
    }

    void readObjects(const LocatedJson& value) {
        if (!expect(value, LocatedJson::Kind::List, "objects")) return;
        if (value.items.empty()) fail(5403, value, "objects is an empty list", "name one mesh at least, or leave objects out");
        if (value.items.size() > kMostObjects)
            fail(5403, value, fmt::format("{} objects, but {} at most can be drawn", value.items.size(), kMostObjects), {});
        for (const LocatedJson& item : value.items)
            if (!error_) readObject(item);
    }

    void readObject(const LocatedJson& value) {
        const std::string what = fmt::format("objects[{}]", workspace_.objects.size());
        SceneObject object;
        readObject(value, what,
                   withMeshKeys(object, {{"position", [&](const LocatedJson& v) { object.placement.position = vector(v, "position"); }},
                                         {"rotation", [&](const LocatedJson& v) { object.placement.rotation = vector(v, "rotation"); }},
                                         {"scale", [&](const LocatedJson& v) { object.placement.scale = scale(v); }},
                                         {"textures", [&](const LocatedJson& v) { readTextures(v, object.textures); }},
                                         {"parameters", [&](const LocatedJson& v) { readParameters(v, object.parameters); }}}));
        if (!error_ && object.meshPath.empty()) fail(5407, value, fmt::format("{} names no mesh", what), "give its \"mesh\"");
        workspace_.objects.push_back(std::move(object));
    }

    /// One number, or one for each axis; a negative one mirrors.
    glm::vec3 scale(const LocatedJson& value) {
        constexpr double kLeastScale = 1e-6;
        constexpr double kMostScale = 1e6;
        const glm::vec3 factors = value.kind == LocatedJson::Kind::Number ? glm::vec3(real(value, "scale", -kMostScale, kMostScale))
                                                                          : vector(value, "scale", -kMostScale, kMostScale);
        for (glm::length_t axis = 0; axis < 3; ++axis)
            if (!(std::abs(static_cast<double>(factors[axis])) >= kLeastScale * (1 - 1e-6)))
                fail(5403, value, fmt::format("scale is {:g} along an axis, which leaves nothing of the mesh", factors[axis]),
                     fmt::format("{:g} to {:g}, or that much negative: mirrored", kLeastScale, kMostScale));
        return factors;
    }

    /// What describes the one mesh belongs into each of several objects.
    void refuseMeshBesideObjects(const LocatedJson& root) {
        if (error_ || workspace_.objects.empty()) return;
        for (std::size_t i = 0; i < root.keys.size(); ++i)
            for (const char* name : {"mesh", "unit_mm", "flip_v", "head", "attribution"})
                if (root.keys[i] == name)
                    fail(5407, root.items[i], fmt::format("'{}' stands beside 'objects'", name), "write it into each of the objects");
    }

    void readMeshPath(const LocatedJson& value, MeshSource& source) {
        const std::string path = expandedPath(value, "mesh");
        if (error_) return;
        source.meshPath = path;
        if (options_.requireMesh) requireFile(value, path);
    }

    void readCamera(const LocatedJson& value) {
        Camera& camera = workspace_.camera;
        readObject(value, "camera",
                   {{"frame", [&](const LocatedJson& v) { workspace_.cameraRelative = frameIsMesh(v); }},
                    {"position", [&](const LocatedJson& v) { camera.position = vector(v, "position"); }},
                    {"target", [&](const LocatedJson& v) { camera.target = vector(v, "target"); }},
                    {"up", [&](const LocatedJson& v) { camera.up = vector(v, "up"); }},
                    {"horizontal_fov", [&](const LocatedJson& v) { camera.horizontalFov = real(v, "horizontal_fov", 0.1, 170); }},
                    {"near", [&](const LocatedJson& v) { camera.nearPlane = real(v, "near", kLeast, kMost); }},
                    {"far", [&](const LocatedJson& v) { camera.farPlane = real(v, "far", kLeast, kMost); }}});
        requirePositionInWorld(value, "camera", workspace_.cameraRelative);
        if (camera.position == camera.target) fail(5407, value, "the camera's position is its target", "move one of them");
        if (camera.up == glm::vec3(0)) fail(5407, value, "the camera's up has no length", "the default is [0, 1, 0]");
        if (camera.nearPlane && camera.farPlane && !(*camera.nearPlane < *camera.farPlane))
            fail(5407, value, "the camera's near plane is not before its far plane", "leave both out: they are then fitted to the mesh");
    }

    void readLight(const LocatedJson& value) {
        readObject(value, "light",
                   {{"frame", [&](const LocatedJson& v) { workspace_.lightRelative = frameIsMesh(v); }},
                    {"position", [&](const LocatedJson& v) { workspace_.light.position = vector(v, "position"); }},
                    {"direction", [&](const LocatedJson& v) { workspace_.light.direction = vector(v, "direction"); }},
                    {"fov", [&](const LocatedJson& v) { workspace_.light.fov = real(v, "fov", 0.1, 160); }},
                    {"width", [&](const LocatedJson& v) { workspace_.light.width = real(v, "width", kLeast, kMost); }},
                    {"color", [&](const LocatedJson& v) { workspace_.light.color = color(v, "color"); }}});
        const Light& light = workspace_.light;
        if (!light.direction) requirePositionInWorld(value, "light", workspace_.lightRelative);
        refuseMixedLight(value, light);
    }

    /// A position and an angle belong to a point light, a direction and a width to parallel light.
    void refuseMixedLight(const LocatedJson& value, const Light& light) {
        const bool positioned = std::ranges::find(value.keys, "position") != value.keys.end();
        if (light.direction && (positioned || light.fov))
            fail(5407, value, fmt::format("the light has a direction and {}", positioned ? "a position" : "an fov"),
                 "parallel light has \"direction\" and \"width\", a point light \"position\" and \"fov\"");
        if (light.width && !light.direction)
            fail(5407, value, "the light has a width but no direction", "a point light's map is as wide as its \"fov\"");
        if (light.direction && *light.direction == glm::vec3(0))
            fail(5407, value, "the light's direction has no length", "it says which way the light goes: [0, -1, 0] is from above");
    }

    /// The default positions are in radii.
    void requirePositionInWorld(const LocatedJson& value, const std::string& what, bool relative) {
        if (!error_ && !relative && std::ranges::find(value.keys, "position") == value.keys.end())
            fail(5407, value, fmt::format("the {} has the frame \"world\" but no position", what),
                 "give its position in units of the world");
    }

    void readSize(const LocatedJson& value) {
        constexpr double kMostPixels = 65536;
        if (!expect(value, LocatedJson::Kind::List, "size")) return;
        if (value.items.size() != 2)
            return fail(5402, value, fmt::format("size is a list of {}, but must be one of 2 numbers", value.items.size()), {});
        const auto pixels = [&](std::size_t i) {
            return static_cast<int>(number(value.items[i], fmt::format("size[{}]", i), 1, kMostPixels));
        };
        workspace_.size = {pixels(0), pixels(1)};
    }

    void readSamples(const LocatedJson& value) {
        const double samples = number(value, "samples", 1, 8);
        workspace_.samples = static_cast<int>(samples);
        if (!error_ && samples != 1 && samples != 2 && samples != 4 && samples != 8)
            fail(5403, value, fmt::format("samples is {:g}, but must be 1, 2, 4 or 8", samples), {});
    }

    void readBinds(const LocatedJson& value) {
        if (!expect(value, LocatedJson::Kind::Object, "bind")) return;
        forEachMember(value,
                      [&](const std::string& name, const LocatedJson& member) { workspace_.binds[name] = string(member, "bind." + name); });
    }

    void readTextures(const LocatedJson& value, std::map<std::string, std::string>& textures) {
        if (!expect(value, LocatedJson::Kind::Object, "textures")) return;
        forEachMember(value, [&](const std::string& name, const LocatedJson& member) {
            const std::string path = expandedPath(member, "textures." + name);
            if (error_) return;
            if (options_.requireMesh) requireFile(member, path);
            textures[name] = path;
        });
    }

    void readParameters(const LocatedJson& value, std::map<std::string, std::vector<double>>& parameters) {
        if (!expect(value, LocatedJson::Kind::Object, "parameters")) return;
        forEachMember(value, [&](const std::string& name, const LocatedJson& member) {
            parameters[name] = parameterValue(member, "parameters." + name);
        });
    }

    std::vector<double> parameterValue(const LocatedJson& value, const std::string& what) {
        auto read = parameterNumbers(value);
        if (!read) fail(5402, value, fmt::format("{} must be a number, true, false or a list of numbers", what), {});
        return std::move(read).value_or(std::vector<double>());
    }

    bool frameIsMesh(const LocatedJson& value) {
        const std::string frame = string(value, "frame");
        if (!error_ && frame != "mesh" && frame != "world")
            fail(5403, value, fmt::format("the frame '{}' does not exist", frame),
                 "\"mesh\": from the bounding sphere's centre in its radii; \"world\": units of the world (world_unit_mm)");
        return frame == "mesh";
    }

    std::string string(const LocatedJson& value, const std::string& what) {
        return expect(value, LocatedJson::Kind::Text, what) ? value.text : std::string();
    }

    bool boolean(const LocatedJson& value, const std::string& what) {
        return expect(value, LocatedJson::Kind::Boolean, what) && value.boolean;
    }

    double number(const LocatedJson& value, const std::string& what, double least, double most) {
        if (!expect(value, LocatedJson::Kind::Number, what)) return least;
        if (value.number >= least && value.number <= most) return value.number;
        fail(5403, value, fmt::format("{} is {:g}, but must lie between {:g} and {:g}", what, value.number, least, most), {});
        return least;
    }

    float real(const LocatedJson& value, const std::string& what, double least, double most) {
        return static_cast<float>(number(value, what, least, most));
    }

    glm::vec3 vector(const LocatedJson& value, const std::string& what, double least = -kMost, double most = kMost) {
        if (!expect(value, LocatedJson::Kind::List, what)) return glm::vec3(0);
        if (value.items.size() != 3) {
            fail(5402, value, fmt::format("{} is a list of {}, but must be one of 3 numbers", what, value.items.size()), {});
            return glm::vec3(0);
        }
        return {real(value.items[0], what + "[0]", least, most), real(value.items[1], what + "[1]", least, most),
                real(value.items[2], what + "[2]", least, most)};
    }

    glm::vec3 color(const LocatedJson& value, const std::string& what) { return vector(value, what, 0, 1e6); }

    /// "${NAME}" replaced by the variable's value.
    std::string expandedPath(const LocatedJson& value, const std::string& what) {
        std::string path = string(value, what);
        for (std::size_t start = path.find("${"); start != std::string::npos && !error_; start = path.find("${", start)) {
            const std::size_t end = path.find('}', start);
            if (end == std::string::npos) {
                fail(5406, value, fmt::format("{}: '${{' without '}}'", what), {});
                break;
            }
            const std::string replacement = variable(path.substr(start + 2, end - start - 2), value);
            path.replace(start, end + 1 - start, replacement);
            start += replacement.size(); // a value is taken as it is
        }
        if (!error_ && path.empty()) fail(5403, value, fmt::format("{} is an empty path", what), {});
        return path;
    }

    std::string variable(const std::string& name, const LocatedJson& value) {
        if (name == "TEGUMENT_CACHE") return cacheFolder().string();
        const char* found = name.empty() ? nullptr : std::getenv(name.c_str());
        if (found && *found) return found;
        fail(5406, value, fmt::format("the environment variable {} is not set", name.empty() ? "''" : name),
             fmt::format("set it to the folder that is meant: {}=FOLDER tegument ...", name.empty() ? "NAME" : name));
        return {};
    }

    /// What lies in the cache, a command of ours makes: it is not there yet, which is no fault of the workspace.
    void requireFile(const LocatedJson& value, const std::string& path) {
        fs::path whole = path_.parent_path() / path;
        whole.make_preferred();
        std::error_code code;
        if (error_ || fs::is_regular_file(whole, code)) return;
        const std::string command = commandThatMakes(whole, options_);
        fail(5405, value, fmt::format("the file {} does not exist", whole.string()), command.empty() ? "" : "make it: " + command);
        if (!command.empty()) error_->blame = Blame::Machine;
    }

    const WorkspaceOptions& options_;
    Workspace workspace_;
};

} // namespace

Workspace worldWorkspace() {
    Workspace workspace;
    workspace.head = false;
    workspace.cameraRelative = false;
    workspace.lightRelative = false;
    return workspace;
}

Result<Workspace> parseWorkspace(const std::string& text, const fs::path& path, const WorkspaceOptions& options) {
    const Result<LocatedJson> root = parseLocatedJson(text, path.string());
    if (!root) return root.error();
    return WorkspaceReader(text, path, options).read(*root);
}

Result<Workspace> loadWorkspace(const fs::path& path, const WorkspaceOptions& options) {
    const Result<std::string> text = readFile(path);
    if (!text) return text.error();
    return parseWorkspace(*text, path, options);
}

MeshOptions meshOptions(const MeshSource& source) {
    return {.unitMm = source.unitMm, .flipV = source.flipV, .expectHead = source.head};
}

MeshOptions meshOptions(const SceneObject& object) {
    MeshOptions options = meshOptions(static_cast<const MeshSource&>(object));
    options.scale = object.placement.scale;
    return options;
}

Workspace workspaceOf(const Workspace& workspace, const SceneObject& object) {
    Workspace own = workspace;
    own.objects.clear();
    static_cast<MeshSource&>(own) = object;
    for (const auto& [name, file] : object.textures)
        own.textures[name] = file;
    for (const auto& [name, value] : object.parameters)
        own.parameters[name] = value;
    return own;
}

} // namespace tegument
