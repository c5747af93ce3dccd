#include "tools/lsp/registers.h"

#include "host/adopt/adopt.h"
#include "host/effect/entry_points.h"
#include "host/spirv/dxil.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::lsp {

namespace {

constexpr std::uint32_t kRegisterBytes = 16; // four floats

char letterOf(ResourceKind kind) {
    switch (kind) {
    case ResourceKind::Sampler:
    case ResourceKind::CompareSampler: return 's';
    case ResourceKind::StorageBuffer:
    case ResourceKind::StorageImage: return 'u';
    default: return 't';
    }
}

/// Constants lie as Direct3D lays them out: "c3", "c3.y to c4".
std::string constantOf(const BlockMember& member) {
    constexpr std::string_view kComponents = "xyzw";
    const std::uint32_t first = member.offset / kRegisterBytes;
    const std::uint32_t last = (member.offset + std::max(member.size, 1U) - 1) / kRegisterBytes;
    std::string text = fmt::format("c{}", first);
    if (member.offset % kRegisterBytes != 0) text += fmt::format(".{}", kComponents[member.offset % kRegisterBytes / 4]);
    return first == last ? text : text + fmt::format(" to c{}", last);
}

void addConstants(Compiled& compiled, const Reflection& reflection, const std::string& where) {
    if (!reflection.globals) return;
    for (const BlockMember& member : reflection.globals->members)
        if (member.used) compiled.registers[member.name].push_back(constantOf(member) + where);
}

void addResources(Compiled& compiled, const Reflection& reflection, const std::string& where) {
    for (const Resource& resource : reflection.resources)
        compiled.registers[resource.name].push_back(fmt::format("{}{}{}", letterOf(resource.kind), resource.binding, where));
}

void addOnce(std::vector<Diagnostic>& into, const std::vector<Diagnostic>& more) {
    for (const Diagnostic& one : more) {
        const auto same = [&](const Diagnostic& other) {
            return other.at.file == one.at.file && other.at.line == one.at.line && other.text == one.text;
        };
        if (std::ranges::none_of(into, same)) into.push_back(one);
    }
}

ShaderRequest requestOf(const Effect& effect, const ShaderUse& use) {
    const bool own = !use.shader->code.empty();
    return {.code = own ? use.shader->code : effect.code,
            .file = effect.file.string(),
            .entry = use.shader->entry,
            .stage = use.kind == ShaderKind::Vertex    ? Stage::Vertex
                     : use.kind == ShaderKind::Compute ? Stage::Compute
                                                       : Stage::Pixel,
            .defines = {},
            .includeFolders = {},
            .language2018 = own};
}

/// What is said of an entry point that is drawn.
void addMessages(Compiled& compiled, const Effect& effect, const ShaderUse& use) {
    if (use.shader->obstacle) return addOnce(compiled.diagnostics, {*use.shader->obstacle});
    const auto shader = compileShader(requestOf(effect, use), defaultCompiler());
    if (shader) return addOnce(compiled.diagnostics, shader->warnings);
    std::vector<Diagnostic> failed = shader.error().diagnostics;
    for (Diagnostic& one : failed)
        if (one.at.line == 0) one.at = use.shader->at; // the validator knows no lines
    addOnce(compiled.diagnostics, failed);
}

/// Where the file's own parameters are in a shader of its own words.
void addRegisters(Compiled& compiled, const Effect& effect, const ShaderUse& use) {
    if (!use.shader->arguments.empty() || !use.shader->code.empty()) return;
    const ShaderRequest request = requestOf(effect, use);
    const auto shader = compileShader(request, defaultCompiler());
    if (!shader) return;
    const std::string where = " in " + use.shader->entry;
    addConstants(compiled, shader->reflection, where);
    if (defaultCompiler() != Compiler::Dxc) return; // SPIR-V's bindings are no registers
    if (const auto dxil = compileDxil(request)) addResources(compiled, dxil->reflection, where);
}

} // namespace

Compiled compile(const Effect& effect) {
    Compiled compiled;
    if (!compilerAvailable(defaultCompiler())) return compiled;
    const bool adopts = !effect.ownDialect && defaultCompiler() == Compiler::Dxc;
    if (!adopts && direct3D9Intrinsic(effect)) return compiled;
    const Effect drawn = adopts ? adopted(effect).effect : Effect{};
    const Effect& said = adopts ? drawn : effect;
    for (const ShaderUse& use : entryPoints(said))
        if (!use.undrawn && (adopts || use.shader->arguments.empty())) addMessages(compiled, said, use);
    if (!direct3D9Intrinsic(effect))
        for (const ShaderUse& use : entryPoints(effect))
            if (!use.undrawn) addRegisters(compiled, effect, use);
    return compiled;
}

} // namespace tegument::lsp
