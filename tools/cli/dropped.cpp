#include "tools/cli/dropped.h"

#include "host/mesh/read_mesh.h"
#include "host/support/text.h"
#include "meshprep/assets/given_values.h"
#include "meshprep/assets/picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

bool takesFile(const Parameter& parameter) {
    return parameter.type.isTexture() && !parameter.isTarget();
}

/// "gFurCubeMap": "furcube".
std::string coreOf(const std::string& name) {
    std::string core =
        name.size() > 1 && name.front() == 'g' && std::isupper(static_cast<unsigned char>(name[1])) != 0 ? name.substr(1) : name;
    if (core.size() > 3 && core.ends_with("Map")) core.resize(core.size() - 3);
    return toLower(core);
}

/// Letters and digits alone.
std::string plain(const std::string& name) {
    std::string text;
    for (const char c : toLower(name))
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) text += c;
    return text;
}

/// How well the file's name fits: the number of its letters that say so.
std::size_t fit(const Parameter& parameter, const std::string& stem) {
    const std::string core = coreOf(parameter.name);
    std::vector<std::string> words = {core, plain(parameter.semantic)};
    if (equalsIgnoreCase(parameter.semantic, "NORMAL")) words.insert(words.end(), {"nrm", "bump"});
    if (equalsIgnoreCase(parameter.semantic, "DIFFUSE")) words.insert(words.end(), {"color", "colour", "albedo", "basecolor"});
    std::size_t best = 0;
    for (const std::string& word : words)
        if (word.size() > 2 && stem.find(word) != std::string::npos) best = std::max(best, word.size());
    return best;
}

bool isSwitch(const std::string& set) {
    return assets::findSwitch(set.substr(0, set.find('='))) != nullptr;
}

/// What the dropped workspace says of its picture, the command line says no longer.
void giveWay(JobOptions& options, const fs::path& file) {
    const auto workspace = loadWorkspace(file, {.requireMesh = false});
    if (!workspace) return; // loadJob() says why
    if (!workspace->technique.empty()) options.technique.clear();
    if (!workspace->setting.empty()) options.effect.setting.clear();
    if (workspace->size) options.size.clear();
    if (workspace->samples > 0) options.samples = 0;
    std::erase_if(options.sets,
                  [&](const std::string& set) { return isSwitch(set) && workspace->parameters.contains(set.substr(0, set.find('='))); });
}

Result<std::string> parameterFor(const fs::path& file, const Effect& effect) {
    const Parameter* best = nullptr;
    std::size_t bestFit = 0;
    std::vector<std::string> names;
    const std::string stem = plain(file.stem().string());
    for (const Parameter& parameter : effect.parameters) {
        if (!takesFile(parameter)) continue;
        names.push_back(parameter.name);
        if (const std::size_t found = fit(parameter, stem); found > bestFit) {
            best = &parameter;
            bestFit = found;
        }
    }
    const auto colour = std::ranges::find_if(effect.parameters, [](const Parameter& parameter) {
        return takesFile(parameter) && equalsIgnoreCase(parameter.semantic, "DIFFUSE");
    });
    if (!best && colour != effect.parameters.end()) best = &*colour;
    if (best) return best->name;
    if (names.size() == 1) return names.front();
    return usageError(8045, fmt::format("{}: no texture of {} is meant by its name", file.string(), effect.file.string()),
                      names.empty() ? "the effect takes no textures" : fmt::format("--set NAME=FILE, with {}", fmt::join(names, ", ")));
}

} // namespace

Result<Dropped> kindOf(const fs::path& file) {
    const std::string ending = toLower(file.extension().string());
    if (ending == ".fx") return Dropped::Effect;
    if (ending == ".json") return Dropped::Workspace;
    if (meshFormatOf(file)) return Dropped::Mesh;
    if (assets::isPicture(file)) return Dropped::Texture;
    return usageError(8045, fmt::format("{} is neither an effect (.fx), a mesh, a workspace (.json) nor a picture", file.string()));
}

Result<JobOptions> withDropped(JobOptions options, const fs::path& file, const Effect& shown) {
    const auto kind = kindOf(file);
    if (!kind) return kind.error();
    switch (*kind) {
    case Dropped::Effect:
        options.file = file.string();
        options.technique.clear();
        options.preset.clear();
        std::erase_if(options.sets, [](const std::string& set) { return !isSwitch(set); }); // which are of all effects of ours
        options.effect.setting.clear();
        break;
    case Dropped::Mesh:
        options.scene.mesh = file.string();
        options.scene.workspace.clear();
        options.scene.unitMm.reset();
        break;
    case Dropped::Workspace:
        options.scene.workspace = file.string();
        options.scene.mesh.clear();
        options.scene.unitMm.reset();
        giveWay(options, file);
        break;
    case Dropped::Texture: {
        const auto name = parameterFor(file, shown);
        if (!name) return name.error();
        std::erase_if(options.sets, [&](const std::string& set) { return set.starts_with(*name + "="); });
        options.sets.push_back(*name + "=" + file.string());
        break;
    }
    }
    return options;
}

} // namespace tegument::app
