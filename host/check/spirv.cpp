#include "host/check/work.h"
#include "host/compile/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace tegument::check {

namespace {

Stage stageOf(ShaderKind kind) {
    if (kind == ShaderKind::Vertex) return Stage::Vertex;
    return kind == ShaderKind::Compute ? Stage::Compute : Stage::Pixel;
}

/// Compiled entry points in the order of Work::entries; empty where the compiler refused.
using Shaders = std::vector<std::optional<Shader>>;

void append(std::vector<Diagnostic>& into, const std::vector<Diagnostic>& more) {
    into.insert(into.end(), more.begin(), more.end());
}

Shaders compileAll(const Work& work, Compiler compiler, TargetCheck& report) {
    Shaders shaders;
    for (const EntryPoint& entry : work.entries) {
        auto shader = compileShader({.code = work.effect.code,
                                     .file = work.file.string(),
                                     .entry = entry.name,
                                     .stage = stageOf(entry.kind),
                                     .defines = {},
                                     .includeFolders = {}},
                                    compiler);
        append(report.diagnostics, shader ? shader->warnings : shader.error().diagnostics);
        shaders.push_back(shader ? std::optional(std::move(*shader)) : std::nullopt);
        ++report.entries;
    }
    return shaders;
}

void linkAll(const Work& work, const Shaders& shaders, TargetCheck& report) {
    for (const StagePair& pair : work.pairs) {
        if (!shaders[pair.vertex] || !shaders[pair.pixel]) continue;
        Shader pixel = *shaders[pair.pixel]; // another pass may pair it with another vertex shader
        if (auto linked = linkStages(*shaders[pair.vertex], pixel); !linked) append(report.diagnostics, linked.error().diagnostics);
    }
}

/// Why no entry point of this file can be tried; empty when they can.
std::string obstacle(const Work& work, Compiler compiler) {
    if (!compilerAvailable(compiler)) return "the DXC library is not there (./bootstrap build fetches it)";
    if (work.entries.empty()) return "no pass names a shader";
    const auto geometry = std::ranges::find(work.entries, ShaderKind::Geometry, &EntryPoint::kind);
    if (geometry != work.entries.end())
        return fmt::format("geometry shader at {}({},{})", geometry->at.file, geometry->at.line, geometry->at.column);
    if (const auto intrinsic = direct3D9Intrinsic(work.effect))
        return fmt::format("Direct3D 9 intrinsic at {}({},{})", intrinsic->at.file, intrinsic->at.line, intrinsic->at.column);
    return {};
}

Shaders checkTarget(const Work& work, Compiler compiler, TargetCheck& report) {
    report.reason = obstacle(work, compiler);
    if (!report.reason.empty()) return {};
    const auto start = std::chrono::steady_clock::now();
    Shaders shaders = compileAll(work, compiler, report);
    linkAll(work, shaders, report);
    report.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return shaders;
}

void compareAll(const Work& work, const Shaders& dxc, const Shaders& glslang, TargetCheck& report) {
    for (std::size_t i = 0; i < std::min(dxc.size(), glslang.size()); ++i) {
        if (!dxc[i] || !glslang[i]) continue;
        for (const std::string& difference : compareReflections(dxc[i]->reflection, glslang[i]->reflection))
            report.diagnostics.push_back(
                {.severity = Severity::Error,
                 .code = 3201,
                 .at = work.entries[i].at,
                 .text = fmt::format("DXC (first) and glslang (second) see {} differently: {}", work.entries[i].name, difference),
                 .hint = "fill every 16 bytes of the parameters exactly (docs/compilers.md)",
                 .sourceLine = {}});
    }
}

} // namespace

void checkSpirv(Work& work) {
    TargetCheck* dxc = work.find(Target::SpirvDxc);
    TargetCheck* glslang = work.find(Target::SpirvGlslang);
    const Shaders first = dxc != nullptr ? checkTarget(work, Compiler::Dxc, *dxc) : Shaders{};
    const Shaders second = glslang != nullptr ? checkTarget(work, Compiler::Glslang, *glslang) : Shaders{};
    if (glslang != nullptr) compareAll(work, first, second, *glslang);
    for (TargetCheck* report : {dxc, glslang})
        if (report != nullptr && report->reason.empty()) conclude(*report);
}

} // namespace tegument::check
