#include "tools/cli/unread.h"

#include "meshprep/adopt/code.h"
#include "meshprep/adopt/kinds.h"
#include "meshprep/assets/given_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace tegument::app {

namespace {

bool mentions(const Script& script, const std::string& name) {
    return std::ranges::any_of(script.commands, [&](const Command& command) {
        return command.selector == name || std::ranges::find(command.options, name) != command.options.end();
    });
}

bool mentions(const Annotations& annotations, const std::string& name) {
    return std::ranges::any_of(annotations.list, [&](const Annotation& one) { return annotations.string(one.name) == name; });
}

/// By the functions that its shaders call and by its scripts: what only a compiler knows, such as a branch that is never taken, counts.
bool reads(const Effect& effect, const Technique& technique, const std::string& name) {
    const auto shaderReads = [&](const std::optional<ShaderReference>& shader) {
        if (!shader) return false;
        const adopt::Code code = adopt::readCode(shader->code.empty() ? effect.code : shader->code);
        return std::ranges::any_of(adopt::reachable(code, {shader->entry}), [&](std::size_t i) {
            const auto* variable = std::get_if<adopt::Variable>(&code.items[i]);
            return variable && variable->name.text == name;
        });
    };
    return mentions(technique.script, name) || std::ranges::any_of(technique.passes, [&](const Pass& pass) {
               return mentions(pass.script, name) || mentions(pass.annotations, name) || shaderReads(pass.vertexShader) ||
                      shaderReads(pass.pixelShader) || shaderReads(pass.geometryShader) || shaderReads(pass.computeShader);
           });
}

bool wasRead(const Parameter& parameter, const RunResult& drawn) {
    if (parameter.annotations.string("Generator")) return true; // by what makes its texture
    if (!parameter.type.isTexture()) return std::ranges::find(drawn.parameters, parameter.name) != drawn.parameters.end();
    return drawn.produced || std::ranges::find(drawn.textures, parameter.name) != drawn.textures.end();
}

} // namespace

std::vector<Diagnostic> unreadValues(const std::vector<std::string>& sets, const Effect& effect, const RunResult& drawn) {
    std::vector<Diagnostic> warnings;
    for (const std::string& set : sets) {
        const std::string name = set.substr(0, set.find('='));
        const Parameter* parameter = effect.findParameter(name);
        if (assets::findSwitch(name) && !assets::takesSwitches(effect))
            warnings.push_back(inputWarning(
                8029, {}, fmt::format("--set {} changes nothing: {} has none of these switches", set, effect.file.filename().string())));
        if (!parameter || wasRead(*parameter, drawn)) continue;
        std::vector<std::string> others;
        for (const Technique& technique : effect.techniques)
            if (technique.name != drawn.technique && reads(effect, technique, name)) others.push_back(technique.name);
        warnings.push_back(inputWarning(8029, {}, fmt::format("--set {} changes nothing: {} does not read {}", set, drawn.technique, name),
                                        others.empty() ? fmt::format("no technique of {} does", effect.file.filename().string())
                                                       : fmt::format("these do: -t {}", fmt::join(others, ", "))));
    }
    return warnings;
}

} // namespace tegument::app
