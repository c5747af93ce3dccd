#include "host/effect/model.h"

#include "host/effect/formats.h"
#include "host/support/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument {

namespace {

template <class T>
const T* findExact(const std::vector<T>& list, std::string_view name) {
    const auto found = std::ranges::find(list, name, &T::name);
    return found == list.end() ? nullptr : &*found;
}

template <class T>
const T* findIgnoringCase(const std::vector<T>& list, std::string_view name) {
    const auto found = std::ranges::find_if(list, [&](const T& item) { return equalsIgnoreCase(item.name, name); });
    return found == list.end() ? nullptr : &*found;
}

/// The option that a selector's default value picks; the first when it has none or is out of range.
std::size_t defaultOption(const Effect& effect, const Command& command) {
    const Parameter* selector = effect.findParameter(command.selector);
    if (selector == nullptr || !selector->defaultValue) return 0;
    const auto* numbers = std::get_if<std::vector<double>>(&*selector->defaultValue);
    if (numbers == nullptr || numbers->empty()) return 0;
    if (selector->type.base == BaseType::Bool) return (*numbers)[0] != 0 ? 0 : 1;
    const double index = std::trunc((*numbers)[0]);
    return index >= 0 && index < static_cast<double>(command.options.size()) ? static_cast<std::size_t>(index) : 0;
}

} // namespace

int Type::scalarCount() const {
    int count = rows * columns;
    if (members) {
        count = 0;
        for (const TypeMember& member : *members)
            count += member.type.isNumeric() || member.type.members ? member.type.scalarCount() : 0;
    }
    return count * (elements == 0 ? 1 : elements);
}

const Annotation* Annotations::find(std::string_view name) const {
    return findIgnoringCase(list, name);
}

std::optional<std::string> Annotations::string(std::string_view name) const {
    const Annotation* annotation = find(name);
    const auto* text = annotation != nullptr ? std::get_if<std::string>(&annotation->value) : nullptr;
    return text != nullptr ? std::optional(*text) : std::nullopt;
}

std::optional<std::vector<double>> Annotations::numbers(std::string_view name) const {
    const Annotation* annotation = find(name);
    const auto* numbers = annotation != nullptr ? std::get_if<std::vector<double>>(&annotation->value) : nullptr;
    return numbers != nullptr ? std::optional(*numbers) : std::nullopt;
}

const Pass* Technique::findPass(std::string_view passName) const {
    return findIgnoringCase(passes, passName);
}

bool Parameter::hasSemantic(std::string_view name) const {
    return equalsIgnoreCase(semantic, name);
}

bool Pass::drawsGeometry() const {
    return !script.given || std::ranges::any_of(script.commands, [](const Command& command) {
        return command.kind == CommandKind::Draw && command.options.front() != "Buffer";
    });
}

bool drawsScene(const Technique& technique) {
    return std::ranges::any_of(technique.script.commands,
                               [](const Command& command) { return command.kind == CommandKind::ScriptExternal; });
}

bool drawsMesh(const Effect& effect, const Technique& technique) {
    return std::ranges::any_of(technique.passes, &Pass::drawsGeometry) || (drawsScene(technique) && effect.findTechnique(kSceneTechnique));
}

const Parameter* Effect::findParameter(std::string_view name) const {
    return findExact(parameters, name);
}

const Sampler* Effect::findSampler(std::string_view name) const {
    return findExact(samplers, name);
}

const StorageTexture* Effect::findStorage(std::string_view name) const {
    return findExact(storages, name);
}

const Technique* Effect::findTechnique(std::string_view name) const {
    if (const Technique* named = findIgnoringCase(techniques, name)) return named;
    const auto had = [&](const Technique& technique) {
        const std::string former = toLower(", " + technique.annotations.string("Formerly").value_or("") + ", ");
        return !name.empty() && former.find(", " + toLower(name) + ", ") != std::string::npos;
    };
    const auto renamed = std::ranges::find_if(techniques, had);
    return renamed == techniques.end() ? nullptr : &*renamed;
}

const Technique* Effect::defaultTechnique() const {
    if (standardsGlobal)
        for (const Command& command : standardsGlobal->script.commands)
            if (command.kind == CommandKind::Technique)
                return findTechnique(command.options[command.selector.empty() ? 0 : defaultOption(*this, command)]);
    if (const Technique* named = shown.empty() ? nullptr : findTechnique(shown)) return named;
    return techniques.empty() ? nullptr : &techniques[0];
}

namespace {

/// What other hosts and later Direct3Ds call a format, and the one here that holds its values.
struct FormatAlias {
    std::string_view name;
    std::string_view format;
};

constexpr std::array<FormatAlias, 37> kFormatAliases{{{"a16r16g16b16f", "A16B16G16R16F"},
                                                      {"a32r32g32b32f", "A32B32G32R32F"},
                                                      {"r16g16b16a16_unorm", "A16B16G16R16"},
                                                      {"g16r16", "G16R16F"},
                                                      {"l16", "R16F"},
                                                      {"a2r10g10b10", "A2B10G10R10"},
                                                      {"r8g8b8", "X8R8G8B8"},
                                                      {"x8b8g8r8", "A8B8G8R8"},
                                                      {"r5g6b5", "X8R8G8B8"},
                                                      {"x1r5g5b5", "X8R8G8B8"},
                                                      {"a1r5g5b5", "A8R8G8B8"},
                                                      {"a4r4g4b4", "A8R8G8B8"},
                                                      {"a8l8", "A8R8G8B8"},
                                                      {"q8w8v8u8", "A16B16G16R16F"},
                                                      {"d16_lockable", "D16"},
                                                      {"d15s1", "D24S8"},
                                                      {"d24x4s4", "D24S8"},
                                                      {"d24fs8", "D24S8"},
                                                      {"d32", "D32F"},
                                                      {"r8g8b8a8_unorm", "A8B8G8R8"},
                                                      {"r8g8b8a8_unorm_srgb", "A8B8G8R8"},
                                                      {"b8g8r8a8_unorm", "A8R8G8B8"},
                                                      {"b8g8r8a8_unorm_srgb", "A8R8G8B8"},
                                                      {"r8_unorm", "L8"},
                                                      {"r10g10b10a2_unorm", "A2B10G10R10"},
                                                      {"r11g11b10_float", "A16B16G16R16F"},
                                                      {"r16_float", "R16F"},
                                                      {"r16_unorm", "R16F"},
                                                      {"r16g16_float", "G16R16F"},
                                                      {"r16g16_unorm", "G16R16F"},
                                                      {"r16g16b16a16_float", "A16B16G16R16F"},
                                                      {"r32_float", "R32F"},
                                                      {"r32g32_float", "G32R32F"},
                                                      {"r32g32b32a32_float", "A32B32G32R32F"},
                                                      {"d16_unorm", "D16"},
                                                      {"d24_unorm_s8_uint", "D24S8"},
                                                      {"d32_float", "D32F"}}};

} // namespace

std::optional<std::string> canonicalFormat(std::string_view name) {
    std::string text = toLower(name);
    for (const std::string_view prefix : {"d3dfmt_", "fmt_", "dxgi_format_"})
        if (text.starts_with(prefix)) text.erase(0, prefix.size());
    if (const auto* alias = std::ranges::find(kFormatAliases, std::string_view(text), &FormatAlias::name); alias != kFormatAliases.end())
        return std::string(alias->format);
    for (const std::string& format : formatNames())
        if (equalsIgnoreCase(format, text)) return format;
    return std::nullopt;
}

std::span<const std::string> formatNames() {
    static const std::array<std::string, 19> kNames{
        "A8R8G8B8", "A16B16G16R16",  "X8R8G8B8",       "A8B8G8R8", "A2B10G10R10", "A16B16G16R16F", "A32B32G32R32F", "R16F",
        "G16R16F",  "R32F",          "G32R32F",        "L8",       "A8",          "D16",           "D24X8",         "D24S8",
        "D32F",     "D32F_LOCKABLE", "D24S8_SHADOWMAP"};
    return kNames;
}

} // namespace tegument
