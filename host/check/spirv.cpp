#include "host/check/work.h"
#include "host/spirv/compile.h"
#include "host/spirv/reflect.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace tegument::check {

namespace {

Stage stageOf(ShaderKind kind) {
    if (kind == ShaderKind::Vertex) return Stage::Vertex;
    return kind == ShaderKind::Compute ? Stage::Compute : Stage::Pixel;
}

/// The member of an entry point that holds this compiler's shader.
using Slot = std::optional<Shader> EntryPoint::*;

void append(std::vector<Diagnostic>& into, const std::vector<Diagnostic>& more) {
    into.insert(into.end(), more.begin(), more.end());
}

void linkAll(const Work& work, Slot slot, TargetCheck& report) {
    for (const StagePair& pair : work.pairs) {
        const std::optional<Shader>& vertex = work.report.entries[pair.vertex].*slot;
        std::optional<Shader> pixel = work.report.entries[pair.pixel].*slot; // another pass may pair it with another vertex shader
        if (!vertex || !pixel) continue;
        auto linked = linkStages(*vertex, *pixel);
        if (linked) continue;
        Error error = linked.error();
        for (Diagnostic& diagnostic : error.diagnostics)
            diagnostic.at = work.report.entries[pair.pixel].at;
        append(report.diagnostics, error.diagnostics);
    }
}

/// `: POSITION` compiles to an ordinary varying without a word.
void checkPositions(const Work& work, Slot slot, TargetCheck& report) {
    for (const StagePair& pair : work.pairs) {
        const EntryPoint& vertex = work.report.entries[pair.vertex];
        if (const auto& shader = vertex.*slot; shader && !spirv::writesPosition(shader->spirv)) addMissingPosition(vertex, report);
    }
}

void checkTarget(Work& work, Compiler compiler, Slot slot, TargetCheck& report) {
    if (std::string reason = obstacleFor(work, compiler); !reason.empty()) return leaveOut(report, std::move(reason));
    if (!compilerAvailable(compiler)) {
        report.reason = noCompiler(compiler);
        return;
    }
    const auto start = std::chrono::steady_clock::now();
    compileEach(work, report, [&](EntryPoint& entry, const ShaderRequest& request) {
        auto shader = compileShader(request, compiler);
        if (!shader) return shader.error().diagnostics;
        entry.*slot = std::move(*shader);
        return (entry.*slot)->warnings;
    });
    linkAll(work, slot, report);
    checkPositions(work, slot, report);
    report.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void compareAll(const Work& work, TargetCheck& report) {
    for (const EntryPoint& entry : work.report.entries) {
        if (!entry.dxc || !entry.glslang || !entry.code.empty()) continue;
        for (const std::string& difference : compareReflections(entry.dxc->reflection, entry.glslang->reflection))
            addError(report, 3201, entry.at, fmt::format("DXC (first) and glslang (second) see {} differently: {}", entry.name, difference),
                     "fill every 16 bytes of the parameters exactly (docs/design/compilers.md)");
    }
}

} // namespace

std::string noCompiler(Compiler compiler) {
    return whyCompilerMissing(compiler) + (compiler == Compiler::Dxc ? " (./bootstrap build fetches it)" : "");
}

std::string obstacleFor(const Work& work, Compiler compiler) {
    const auto geometry = std::ranges::find(work.report.entries, ShaderKind::Geometry, &EntryPoint::kind);
    if (geometry != work.report.entries.end() && std::ranges::all_of(work.report.entries, &EntryPoint::undrawn))
        return fmt::format("geometry shader at {}({},{})", geometry->at.file, geometry->at.line, geometry->at.column);
    if (work.report.entries.empty() || !work.respelt) return spellingObstacle(work);
    if (compiler == Compiler::Dxc) return {};
    const std::string reason = spellingObstacle(work);
    return reason.empty() ? "shaders are compiled with arguments or for Direct3D 9: drawn by way of DXC" : reason;
}

void compileEach(Work& work, TargetCheck& report,
                 const std::function<std::vector<Diagnostic>(EntryPoint& entry, const ShaderRequest& request)>& compile) {
    for (EntryPoint& entry : work.report.entries) {
        if (entry.undrawn) continue;
        ++report.entries;
        if (entry.obstacle) {
            report.diagnostics.push_back(*entry.obstacle);
            continue;
        }
        const bool respelt = !entry.code.empty();
        if (work.respelt && !respelt && direct3D9Intrinsic(work.effect())) continue; // of a pass that another shader of it spoils
        append(report.diagnostics, compile(entry, {.code = respelt ? entry.code : work.effect().code,
                                                   .file = work.file.string(),
                                                   .entry = respelt ? entry.symbol : entry.name,
                                                   .stage = stageOf(entry.kind),
                                                   .defines = {},
                                                   .includeFolders = {},
                                                   .language2018 = respelt}));
    }
}

void checkSpirv(Work& work) {
    TargetCheck* dxc = work.find(Target::SpirvDxc);
    TargetCheck* glslang = work.find(Target::SpirvGlslang);
    if (dxc != nullptr) checkTarget(work, Compiler::Dxc, &EntryPoint::dxc, *dxc);
    if (glslang != nullptr) checkTarget(work, Compiler::Glslang, &EntryPoint::glslang, *glslang);
    if (glslang != nullptr) compareAll(work, *glslang);
    for (TargetCheck* report : {dxc, glslang})
        if (report != nullptr && report->reason.empty()) conclude(*report); // one that was tried
}

} // namespace tegument::check
