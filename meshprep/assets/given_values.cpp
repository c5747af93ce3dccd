#include "meshprep/assets/given_values.h"

#include "host/support/text.h"
#include "meshprep/assets/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace tegument::assets {

namespace {

std::optional<std::vector<double>> parseNumbers(std::string_view text) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::string_view item = trim(text.substr(0, comma));
        double number = 0;
        const auto parsed = std::from_chars(item.data(), item.data() + item.size(), number);
        if (parsed.ec != std::errc() || parsed.ptr != item.data() + item.size() || !std::isfinite(number)) return std::nullopt;
        numbers.push_back(number);
        if (comma == std::string_view::npos) return numbers;
        text.remove_prefix(comma + 1);
    }
}

std::vector<std::string> parameterNames(const Effect& effect) {
    std::vector<std::string> names;
    for (const Parameter& parameter : effect.parameters)
        names.push_back(parameter.name);
    return names;
}

std::vector<std::string> settableNames(const Effect& effect) {
    std::vector<std::string> names = parameterNames(effect);
    for (const Switch& one : switches())
        names.push_back(one.name);
    return names;
}

std::string typeOf(const Parameter& parameter) {
    const Type& type = parameter.type;
    return type.elements ? fmt::format("{}[{}]", type.name, type.elements) : type.name;
}

/// What is wrong with numbers for this parameter; empty when nothing is.
std::string misfit(const Parameter& parameter, const std::vector<double>& numbers) {
    if (!parameter.type.isNumeric()) return fmt::format("{} is a {}, and takes no numbers", parameter.name, typeOf(parameter));
    const auto expected = static_cast<std::size_t>(parameter.type.scalarCount());
    if (numbers.size() != expected)
        return fmt::format("{} is a {}: it takes {} number{}, {} given", parameter.name, typeOf(parameter), expected,
                           expected == 1 ? "" : "s", numbers.size());
    const bool whole = std::ranges::all_of(numbers, [](double number) { return number == std::floor(number); });
    if (parameter.type.base != BaseType::Float && !whole)
        return fmt::format("{} is a {}: it takes whole numbers only", parameter.name, typeOf(parameter));
    return {};
}

bool fits(const Switch& one, const std::vector<double>& numbers) {
    const double value = numbers.front();
    return numbers.size() == 1 && value >= one.least && value <= one.most && std::fmod(value - one.least, one.step) == 0;
}

/// What a workspace gives: of the whole scene, or of one of its objects.
struct Given {
    const std::map<std::string, std::vector<double>>* parameters = nullptr;
    const std::map<std::string, std::string>* textures = nullptr;
};

std::vector<Given> givenBy(const Workspace& workspace) {
    std::vector<Given> all = {{&workspace.parameters, &workspace.textures}};
    for (const SceneObject& object : workspace.objects)
        all.push_back({&object.parameters, &object.textures});
    return all;
}

bool takesTexture(const Effect& effect, const std::string& name) {
    return std::ranges::any_of(effect.parameters, [&](const Parameter& parameter) {
        return parameter.type.isTexture() && (parameter.name == name || equalsIgnoreCase(parameter.semantic, name));
    });
}

/// The names that this effect does not have.
std::vector<std::string> unknownNames(const Effect& effect, const std::vector<Given>& given) {
    std::vector<std::string> unknown;
    for (const Given& one : given) {
        for (const auto& [name, numbers] : *one.parameters)
            if (!effect.findParameter(name) && !findSwitch(name)) unknown.push_back(name);
        for (const auto& [name, file] : *one.textures)
            if (!takesTexture(effect, name) && !equalsIgnoreCase(name, "DIFFUSE") && !equalsIgnoreCase(name, "NORMAL") &&
                !equalsIgnoreCase(name, "KERNELSIZE") && !equalsIgnoreCase(name, "SHINE"))
                unknown.push_back(name);
    }
    std::ranges::sort(unknown);
    unknown.erase(std::unique(unknown.begin(), unknown.end()), unknown.end());
    return unknown;
}

/// Those that no effect beside it has either.
void dropThoseOfOthers(const Effect& effect, std::vector<std::string>& unknown) {
    for (const std::filesystem::path& file : effectsBeside(effect.file)) {
        if (unknown.empty()) return;
        const auto other = loadEffect(file);
        if (!other) continue;
        std::erase_if(unknown, [&](const std::string& name) { return other->findParameter(name) || takesTexture(*other, name); });
    }
}

} // namespace

const std::vector<Switch>& switches() {
    constexpr int kMostTexels = 16384;
    static const std::vector<Switch> kSwitches = {
        {"TEGUMENT_SURROUNDINGS", "skin stands in surroundings: a studio, or gEnvironmentMap"},
        {"TEGUMENT_LAMPS", "so many lamps beside the scene's light; by default a fill and two rims", 0, 7},
        {"TEGUMENT_LAMP_SHADOWS", "so many of the lamps throw shadows", 0, 3},
        {"TEGUMENT_SOFT_SHADOWS", "shadows of lamps have penumbras"},
        {"TEGUMENT_LOBES", "skin mirrors by two lobes"},
        {"TEGUMENT_SLAB", "DEonLuebke lets through what simulated skin does"},
        {"TEGUMENT_POST_HALF", "SkinPost gathers from maps of half resolution"},
        {"TEGUMENT_NORMAL_XY", "the normal map has two channels (BC5, RG8)"},
        {"TEGUMENT_FUR_COLOR_MAP", "fur has the colour of gFurColorMap"},
        {"TEGUMENT_FUR_VERTEX_LIGHT", "light of Fur at vertices: faster"},
        {"TEGUMENT_FUR_POSE", "FurCoat follows bodies that bend: --pose sets it"},
        {"TEGUMENT_FUR_CURVES", "FurCoat and FurSkin draw strands that are curves: meshes of tegument fur import set it"},
        {"TEGUMENT_MOTION", "FurCoat writes motion vectors"},
        {"TEGUMENT_RIBBON_ROWS", "rows of the maps of fur by compute shaders", 1, kMostTexels},
        {"TEGUMENT_MAP_SIZE", "texels along each side of the texture-space maps: --map-size", 1, kMostTexels},
        {"TEGUMENT_SHADOW_SIZE", "of the maps that are seen from the light: --shadow-size", 1, kMostTexels},
        {"TEGUMENT_MAP_BITS", "bits per channel of the irradiance maps", 16, 32, 16},
        {"TEGUMENT_PEERS_AS_PRINTED", "kernels of effects/peers as their authors print them"},
        {"TEGUMENT_SEAM_REPAIR", "0 to measure: texels outside the charts count as valid"},
        {"TEGUMENT_CULL_FRUSTUM", "0 to measure: the prepasses leave this cause out"},
        {"TEGUMENT_CULL_BACK_FACES", "likewise"},
        {"TEGUMENT_CULL_BLACK", "likewise"},
        {"TEGUMENT_SHADOW_FROM_TSM", "0 to measure: a shadow map of its own"},
    };
    return kSwitches;
}

std::string Switch::range() const {
    return fmt::format("{}{}{}", least, step == 1 ? ".." : " or ", most);
}

const Switch* findSwitch(std::string_view name) {
    const auto found = std::ranges::find(switches(), name, &Switch::name);
    return found == switches().end() ? nullptr : &*found;
}

bool takesSwitches(const Effect& effect) {
    return std::ranges::any_of(effect.includes, [](const std::filesystem::path& file) { return file.filename() == "settings.fxh"; });
}

Result<std::vector<std::pair<std::string, std::string>>> takeSwitches(std::vector<std::string>& sets) {
    std::vector<std::pair<std::string, std::string>> defines;
    for (auto set = sets.begin(); set != sets.end();) {
        const std::size_t equals = set->find('=');
        const Switch* found = findSwitch(set->substr(0, equals));
        if (!found) {
            ++set;
            continue;
        }
        const auto numbers = equals == std::string::npos ? std::vector<double>{1} : parseNumbers(set->substr(equals + 1));
        if (!numbers || !fits(*found, *numbers))
            return usageError(8013, fmt::format("--set {}: a whole number is expected, {}", *set, found->range()),
                              fmt::format("{}: {}", found->name, found->meaning));
        defines.emplace_back(found->name, fmt::format("{:.0f}", numbers->front()));
        set = sets.erase(set);
    }
    return defines;
}

Result<std::vector<std::string>> switchesOf(const Workspace& workspace) {
    std::vector<std::string> given;
    const SourcePosition at{.file = workspace.file.string()};
    for (const auto& [name, numbers] : workspace.parameters) {
        const Switch* found = findSwitch(name);
        if (found && !fits(*found, numbers))
            return inputError(8019, at, fmt::format("{} is a switch: it takes a whole number, {}", name, found->range()));
        if (found) given.push_back(fmt::format("{}={:.0f}", name, numbers.front()));
    }
    for (const SceneObject& object : workspace.objects)
        for (const auto& [name, numbers] : object.parameters)
            if (findSwitch(name))
                return inputError(8019, at, fmt::format("{} is a switch of the whole scene, not of one of its objects", name));
    return given;
}

Result<void> applySet(const std::string& set, const Effect& effect, RunOptions& run) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || equals == 0)
        return usageError(8011, fmt::format("--set {} has no '='", set), "write --set NAME=VALUE, for example --set gMix=0.5");
    const std::string name = set.substr(0, equals);
    const std::string value = set.substr(equals + 1);
    const Parameter* parameter = effect.findParameter(name);
    const bool texture = parameter ? parameter->type.isTexture() : takesTexture(effect, name); // textures go by their semantic, too
    if (!parameter && !texture) {
        const std::string near = didYouMean(name, settableNames(effect));
        return usageError(8012, fmt::format("--set {}: {} has no parameter '{}'", set, effect.file.string(), name),
                          near.empty() ? fmt::format("tegument info {} lists them", shellWord(effect.file.string())) : near);
    }
    if (texture) {
        if (const auto exists = fileExists(value, fmt::format("--set {}:", name)); !exists) return exists.error();
        run.textures[name] = value;
        return {};
    }
    auto numbers = parseNumbers(value);
    if (!numbers)
        return usageError(8013, fmt::format("--set {}: '{}' is not a number or a list of numbers", name, value),
                          "separate the numbers by commas: --set gTint=1,0.9,0.8");
    if (const std::string wrong = misfit(*parameter, *numbers); !wrong.empty()) {
        const bool pairs = parameter->type.isNumeric() && numbers->size() == 2 * static_cast<std::size_t>(parameter->type.scalarCount());
        return usageError(8013, fmt::format("--set {}: {}", set, wrong),
                          pairs ? fmt::format("a decimal has a point: --set {}=0.5; commas stand between numbers", name)
                                : "separate the numbers by commas: --set gTint=1,0.9,0.8");
    }
    run.parameters[name] = std::move(*numbers);
    return {};
}

Result<std::vector<Preset>> presetsOf(const Effect& effect) {
    auto presets = loadPresets(effect.file);
    if (!presets) return presets;
    for (const Preset& preset : *presets)
        for (const auto& [name, numbers] : preset.parameters) {
            const Parameter* parameter = effect.findParameter(name);
            if (!parameter)
                return inputError(8044, preset.at,
                                  fmt::format("preset '{}': {} has no parameter '{}'", preset.name, effect.file.string(), name),
                                  didYouMean(name, parameterNames(effect)));
            if (const std::string wrong = misfit(*parameter, numbers); !wrong.empty())
                return inputError(8044, preset.at, fmt::format("preset '{}': {}", preset.name, wrong));
        }
    return presets;
}

Result<void> applyPreset(const std::string& name, const Effect& effect, RunOptions& run) {
    const auto presets = presetsOf(effect);
    if (!presets) return presets.error();
    std::vector<std::string> names;
    for (const Preset& preset : *presets) {
        names.push_back(preset.name);
        if (!equalsIgnoreCase(preset.name, name)) continue;
        for (const auto& [parameter, numbers] : preset.parameters)
            run.parameters[parameter] = numbers;
        return {};
    }
    const std::string near = didYouMean(name, names);
    const std::string all = names.empty() ? fmt::format("it has none: they would stand in {}", presetsFile(effect.file).string())
                                          : fmt::format("it has {}", fmt::join(names, ", "));
    return usageError(8043, fmt::format("{} has no preset '{}'", effect.file.string(), name), near.empty() ? all : near);
}

Result<std::vector<Diagnostic>> checkWorkspaceValues(const Effect& effect, const Workspace& workspace) {
    const std::vector<Given> given = givenBy(workspace);
    const SourcePosition at{.file = workspace.file.string()};
    for (const Given& one : given)
        for (const auto& [name, numbers] : *one.parameters)
            if (const Parameter* parameter = effect.findParameter(name))
                if (const std::string wrong = misfit(*parameter, numbers); !wrong.empty()) return inputError(8019, at, wrong);
    std::vector<std::string> unknown = unknownNames(effect, given);
    dropThoseOfOthers(effect, unknown);
    std::vector<Diagnostic> warnings;
    for (const std::string& name : unknown) {
        const std::string near = didYouMean(name, settableNames(effect));
        warnings.push_back(inputWarning(8018, at, fmt::format("no effect has a parameter '{}': it is passed over", name),
                                        near.empty() ? fmt::format("tegument info {} lists them", shellWord(effect.file.string())) : near));
    }
    return warnings;
}

} // namespace tegument::assets
