#include "host/effect/entry_points.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument {

std::vector<ShaderUse> entryPoints(const std::vector<const Pass*>& passes) {
    std::vector<ShaderUse> uses;
    const auto add = [&](const std::optional<ShaderReference>& shader, ShaderStage stage, bool undrawn) {
        if (!shader) return;
        const auto known = std::ranges::find_if(uses, [&](const ShaderUse& use) {
            return use.stage == stage && use.shader->entry == shader->entry && use.shader->arguments == shader->arguments &&
                   use.shader->code == shader->code;
        });
        if (known == uses.end())
            uses.push_back({stage, &*shader, undrawn});
        else
            known->undrawn = known->undrawn && undrawn;
    };
    for (const Pass* pass : passes) {
        const bool undrawn = needsOtherStages(*pass);
        add(pass->vertexShader, ShaderStage::Vertex, undrawn);
        add(pass->pixelShader, ShaderStage::Pixel, undrawn);
        add(pass->geometryShader, ShaderStage::Geometry, true);
        add(pass->computeShader, ShaderStage::Compute, undrawn);
    }
    return uses;
}

std::vector<ShaderUse> entryPoints(const Effect& effect) {
    std::vector<const Pass*> passes;
    for (const Technique& technique : effect.techniques)
        for (const Pass& pass : technique.passes)
            passes.push_back(&pass);
    return entryPoints(passes);
}

bool needsOtherStages(const Pass& pass) {
    return pass.geometryShader || pass.hullShader || pass.domainShader || pass.streamOutput;
}

Result<void> drawable(const Pass& pass) {
    if (pass.hullShader || pass.domainShader)
        return inputError(4003, pass.at, fmt::format("pass {} has a hull or a domain shader", pass.name),
                          "this host runs vertex and pixel shaders");
    if (pass.geometryShader)
        return inputError(4003, pass.geometryShader->at, fmt::format("pass {} has a geometry shader", pass.name),
                          "this host runs vertex, pixel and compute shaders");
    if (pass.assemblyShaders > 0)
        return inputError(4003, pass.at, fmt::format("pass {} has a shader in assembly that is not translated", pass.name),
                          "write it in HLSL");
    if (!pass.vertexShader && !pass.computeShader)
        return inputError(4002, pass.at, fmt::format("pass {} has no vertex shader", pass.name), "every pass that draws needs one");
    for (const auto* stage : {&pass.vertexShader, &pass.pixelShader})
        if (*stage && (*stage)->obstacle) return Error{Blame::Input, {*(*stage)->obstacle}};
    for (const auto* stage : {&pass.vertexShader, &pass.pixelShader, &pass.computeShader})
        if (*stage && !(*stage)->arguments.empty())
            return inputError(4003, (*stage)->at, fmt::format("{} of pass {} is compiled with arguments", (*stage)->entry, pass.name),
                              "write a function without uniform parameters that calls it: DXC takes no arguments here");
    return {};
}

Error writesNoPosition(const std::string& entry, const SourcePosition& at) {
    return inputError(3206, at, fmt::format("{} writes no SV_Position: nothing will be drawn", entry),
                      "write SV_Position in place of POSITION; Direct3D 9 takes it too");
}

} // namespace tegument
