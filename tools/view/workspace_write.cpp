#include "tools/view/workspace_write.h"

#include "host/support/file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace tegument {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without a fraction.
Json number(double value) {
    constexpr double kExact = 1e15;
    if (value == std::floor(value) && std::abs(value) < kExact) return static_cast<std::int64_t>(value);
    return value;
}

/// As short as it can be written and still be read as this float.
Json number(float value) {
    return number(std::strtod(fmt::format("{}", value).c_str(), nullptr));
}

Json vector(const glm::vec3& v) {
    return {number(v.x), number(v.y), number(v.z)};
}

fs::path standing(const fs::path& path) {
    std::error_code none;
    return fs::absolute(path, none).lexically_normal();
}

/// Writes the keys of one workspace.
class WorkspaceWriter {
public:
    WorkspaceWriter(const Workspace& workspace, const fs::path& path)
        : workspace_(workspace), folder_(standing(path).parent_path()), unit_(workspace.worldUnitMm) {}

    Json write() const {
        Json json = Json::object();
        if (workspace_.objects.empty()) addSource(json, workspace_);
        for (const SceneObject& object : workspace_.objects)
            json["objects"].push_back(this->object(object));
        if (unit_ != 1) json["world_unit_mm"] = number(unit_);
        json["camera"] = camera();
        json["light"] = light();
        json["background"] = vector(workspace_.background);
        addValues(json, workspace_.textures, workspace_.parameters);
        addPicture(json);
        return json;
    }

private:
    /// How it is drawn.
    void addPicture(Json& json) const {
        const auto add = [&](const char* key, const std::string& text) {
            if (!text.empty()) json[key] = text;
        };
        add("technique", workspace_.technique);
        add("setting", workspace_.setting);
        if (workspace_.size) json["size"] = {workspace_.size->first, workspace_.size->second};
        if (workspace_.samples > 0) json["samples"] = workspace_.samples;
        if (!workspace_.binds.empty()) json["bind"] = workspace_.binds;
        if (!workspace_.pose.empty()) json["pose"] = file(workspace_.pose);
        if (!workspace_.poseBefore.empty()) json["pose_before"] = file(workspace_.poseBefore);
    }

    void addSource(Json& json, const MeshSource& source) const {
        if (!source.meshPath.empty()) json["mesh"] = file(source.meshPath);
        if (source.unitMm) json["unit_mm"] = number(*source.unitMm);
        if (source.flipV) json["flip_v"] = true;
        if (!source.head) json["head"] = false;
        if (!source.attribution.empty()) json["attribution"] = source.attribution;
    }

    void addValues(Json& json, const std::map<std::string, std::string>& textures,
                   const std::map<std::string, std::vector<double>>& parameters) const {
        for (const auto& [name, path] : textures)
            json["textures"][name] = file(path);
        for (const auto& [name, numbers] : parameters)
            if (numbers.size() == 1)
                json["parameters"][name] = number(numbers.front());
            else
                for (const double value : numbers)
                    json["parameters"][name].push_back(number(value));
    }

    Json object(const SceneObject& object) const {
        Json json = Json::object();
        addSource(json, object);
        json["position"] = vector(object.placement.position / unit_);
        json["rotation"] = vector(object.placement.rotation);
        json["scale"] = vector(object.placement.scale);
        addValues(json, object.textures, object.parameters);
        return json;
    }

    Json camera() const {
        const Camera& camera = workspace_.camera;
        const float unit = workspace_.cameraRelative ? 1 : unit_;
        Json json{{"frame", workspace_.cameraRelative ? "mesh" : "world"},
                  {"position", vector(camera.position / unit)},
                  {"target", vector(camera.target / unit)},
                  {"up", vector(camera.up)},
                  {"horizontal_fov", number(camera.horizontalFov)}};
        if (camera.nearPlane) json["near"] = number(*camera.nearPlane / unit_);
        if (camera.farPlane) json["far"] = number(*camera.farPlane / unit_);
        return json;
    }

    Json light() const {
        const Light& light = workspace_.light;
        const float unit = workspace_.lightRelative ? 1 : unit_;
        Json json{{"frame", workspace_.lightRelative ? "mesh" : "world"}};
        if (light.direction) {
            json["direction"] = vector(*light.direction);
            if (light.width) json["width"] = number(*light.width / unit);
        } else {
            json["position"] = vector(light.position / unit);
            if (light.fov) json["fov"] = number(*light.fov);
        }
        json["color"] = vector(light.color);
        return json;
    }

    /// The workspace's own path, from where the new file lies.
    std::string file(const std::string& path) const {
        const fs::path whole = standing(workspace_.file.parent_path() / path);
        const fs::path inCache = whole.lexically_relative(standing(cacheFolder()));
        if (!inCache.empty() && *inCache.begin() != "..") return "${TEGUMENT_CACHE}/" + inCache.generic_string();
        const fs::path near = whole.lexically_relative(folder_);
        return near.empty() ? whole.generic_string() : near.generic_string();
    }

    const Workspace& workspace_;
    fs::path folder_;
    float unit_;
};

/// Lists of numbers on one line each.
std::string withShortLists(const std::string& text) {
    std::string result;
    bool list = false; // inside one that holds no other
    bool quoted = false;
    bool escaped = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"' && !escaped) quoted = !quoted;
        escaped = quoted && c == '\\' && !escaped;
        if (!quoted && c == '[') list = text.find_first_of("[{", i + 1) > text.find(']', i + 1);
        if (list && !quoted && (c == '\n' || c == ' ')) {
            if (result.back() == ',') result += ' ';
            continue;
        }
        if (!quoted && c == ']') list = false;
        result += c;
    }
    return result + '\n';
}

} // namespace

std::string workspaceJson(const Workspace& workspace, const fs::path& path) {
    return withShortLists(WorkspaceWriter(workspace, path).write().dump(2, ' ', false, Json::error_handler_t::replace));
}

void settle(Workspace& workspace, const std::map<std::string, std::vector<double>>& parameters,
            const std::map<std::string, std::string>& textures) {
    const auto into = [&](std::map<std::string, std::vector<double>>& values, std::map<std::string, std::string>& files) {
        for (const auto& [name, value] : parameters)
            values[name] = value;
        for (const auto& [name, file] : textures)
            files[name] = standing(file).string();
    };
    into(workspace.parameters, workspace.textures);
    for (SceneObject& object : workspace.objects)
        into(object.parameters, object.textures);
}

} // namespace tegument
