#include "tools/lsp/registers.h"

#include "host/spirv/dxil.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tegument::lsp {

namespace {

constexpr std::uint32_t kRegisterBytes = 16; // four floats

struct Entry {
    const ShaderReference* shader = nullptr;
    Stage stage = Stage::Pixel;
};

std::vector<Entry> entriesOf(const Effect& effect) {
    std::vector<Entry> entries;
    std::set<std::string> seen;
    const auto add = [&](const std::optional<ShaderReference>& shader, Stage stage) {
        if (shader && shader->code.empty() && shader->arguments.empty() && seen.insert(shader->entry).second)
            entries.push_back({&*shader, stage});
    };
    for (const Technique& technique : effect.techniques)
        for (const Pass& pass : technique.passes) {
            add(pass.vertexShader, Stage::Vertex);
            add(pass.pixelShader, Stage::Pixel);
            add(pass.computeShader, Stage::Compute);
        }
    return entries;
}

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

void compileEntry(Compiled& compiled, const Effect& effect, const Entry& entry) {
    const Compiler compiler = defaultCompiler();
    const ShaderRequest request{.code = effect.code,
                                .file = effect.file.string(),
                                .entry = entry.shader->entry,
                                .stage = entry.stage,
                                .defines = {},
                                .includeFolders = {}};
    const auto shader = compileShader(request, compiler);
    if (!shader) {
        std::vector<Diagnostic> failed = shader.error().diagnostics;
        for (Diagnostic& one : failed)
            if (one.at.line == 0) one.at = entry.shader->at; // the validator knows no lines
        return addOnce(compiled.diagnostics, failed);
    }
    addOnce(compiled.diagnostics, shader->warnings);
    const std::string where = " in " + entry.shader->entry;
    addConstants(compiled, shader->reflection, where);
    if (compiler != Compiler::Dxc) return; // SPIR-V's bindings are no registers
    if (const auto dxil = compileDxil(request)) addResources(compiled, dxil->reflection, where);
}

} // namespace

Compiled compile(const Effect& effect) {
    Compiled compiled;
    if (direct3D9Intrinsic(effect) || !compilerAvailable(defaultCompiler())) return compiled;
    for (const Entry& entry : entriesOf(effect))
        compileEntry(compiled, effect, entry);
    return compiled;
}

} // namespace tegument::lsp
