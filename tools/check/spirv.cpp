#include "host/run/ahead.h"
#include "host/run/geometry.h"
#include "host/spirv/compile.h"
#include "host/spirv/reflect.h"
#include "tools/check/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <regex>

namespace tegument::check {

namespace {

/// The member of an entry point that holds this compiler's shader.
using Slot = std::optional<Shader> EntryPoint::*;

void append(std::vector<Diagnostic>& into, const std::vector<Diagnostic>& more) {
    into.insert(into.end(), more.begin(), more.end());
}

/// What is drawn by this compiler: of another host's effect what meshprep/adopt makes of it.
const Effect& drawnBy(const Work& work, Compiler compiler) {
    return compiler == Compiler::Dxc && work.drawn ? *work.drawn : work.effect();
}

/// A frame without a shader of the file's: meshprep/adopt writes those of fixed function, and scripts may clear alone.
bool drawnByUs(const Work& work, Compiler compiler) {
    const Effect& effect = drawnBy(work, compiler);
    return work.report.entries.empty() && !effect.techniques.empty() && (&effect != &work.effect() || effect.ownDialect);
}

run::Stages compileAll(const Effect& effect, Compiler compiler) {
    std::vector<const Pass*> passes;
    for (const Technique& technique : effect.techniques)
        for (const Pass& pass : technique.passes)
            if (!needsOtherStages(pass) && drawable(pass)) passes.push_back(&pass);
    return run::compileStages(effect, run::stagesOf(passes), compiler);
}

void addErrors(const Error& error, const Pass* pass, Severity most, TargetCheck& report) {
    for (Diagnostic diagnostic : error.diagnostics) {
        if (diagnostic.at.line == 0 && pass != nullptr && pass->pixelShader) diagnostic.at = pass->pixelShader->at;
        diagnostic.severity = std::min(diagnostic.severity, most);
        report.diagnostics.push_back(std::move(diagnostic));
    }
}

/// All that a frame needs, of the technique that is drawn; a plain mesh stands for the user's.
void prepareFrame(const Effect& effect, Compiler compiler, run::Programs programs, TargetCheck& report) {
    constexpr int kSide = 64;
    constexpr int kNoValue = 4018;
    constexpr int kNoTexture = 4030;
    const Mesh mesh = run::fullScreenQuad();
    const SessionScene scene{.mesh = drawsMesh(effect, *effect.defaultTechnique()) ? &mesh : nullptr};
    const RunOptions options{.width = kSide, .height = kSide, .compiler = compiler};
    const auto prepared = run::prepareAhead(effect, scene, Workspace{}, options, {.programs = std::move(programs)});
    if (prepared) return;
    const int code = prepared.error().diagnostics.front().code;
    if (effect.ownDialect && (code == kNoValue || code == kNoTexture)) return; // the user has them
    addErrors(prepared.error(), nullptr, Severity::Error, report);
}

/// The compiler misses a name that stands in the arguments of `written`, the pass as the file has it: the file's own fault in any
/// technique.
bool isOfArguments(const Error& error, const Pass& written) {
    const std::regex missed("undeclared identifier '(\\w+)'");
    std::smatch found;
    for (const Diagnostic& diagnostic : error.diagnostics)
        if (std::regex_search(diagnostic.text, found, missed))
            for (const auto* shader : {&written.vertexShader, &written.pixelShader})
                if (*shader && std::ranges::any_of((*shader)->arguments, [&](const std::string& argument) {
                        return std::regex_search(argument, std::regex("\\b" + found[1].str() + "\\b"));
                    }))
                    return true;
    return false;
}

/// Each pass as it would be drawn. What a frame of the technique that is drawn meets, prepareFrame has; of others this host's limits are
/// warnings, and of another host's effect all that is not the file's own fault. Engines with other vertex streams load our own, too.
void makePasses(const Work& work, const Effect& effect, Compiler compiler, const run::Stages& stages, TargetCheck& report) {
    constexpr int kRunning = 4000;
    constexpr int kStream = 4042;
    const Technique* shown = effect.defaultTechnique();
    const bool foreign = &effect != &work.effect();
    bool complete = shown != nullptr && (foreign || effect.ownDialect);
    run::Programs programs;
    for (std::size_t t = 0; t < effect.techniques.size(); ++t)
        for (std::size_t p = 0; p < effect.techniques[t].passes.size(); ++p) {
            const Pass& pass = effect.techniques[t].passes[p];
            const bool drawn = &effect.techniques[t] == shown;
            const Pass* written =
                t < work.effect().techniques.size() ? &work.effect().techniques[t].passes[p] : nullptr; // meshprep/adopt adds one
            if (needsOtherStages(pass)) continue;
            auto made = run::compilePass(effect, pass, compiler, stages);
            if (made) {
                programs.emplace(&pass, std::make_shared<const run::PassProgram>(std::move(*made)));
                continue;
            }
            const int code = made.error().diagnostics.front().code;
            const bool limit = code >= kRunning && code != kStream;
            const bool fault = foreign ? written != nullptr && isOfArguments(made.error(), *written) : code < kRunning || (drawn && limit);
            if (drawn && complete && (foreign || limit)) continue; // the frame says it
            addErrors(made.error(), &pass, fault ? Severity::Error : Severity::Warning, report);
            complete = complete && !drawn;
        }
    if (complete) prepareFrame(effect, compiler, std::move(programs), report);
}

void checkTarget(Work& work, Compiler compiler, Slot slot, TargetCheck& report) {
    if (std::string reason = obstacleFor(work, compiler); !reason.empty() && !drawnByUs(work, compiler))
        return leaveOut(report, std::move(reason));
    if (!compilerAvailable(compiler)) {
        report.reason = noCompiler(compiler);
        return;
    }
    const auto start = std::chrono::steady_clock::now();
    const Effect& effect = drawnBy(work, compiler);
    const run::Stages stages = compileAll(effect, compiler);
    for (const auto& [key, shader] : stages)
        if (shader) append(report.diagnostics, shader->warnings);
    makePasses(work, effect, compiler, stages, report);
    for (EntryPoint& entry : work.report.entries) {
        if (entry.undrawn) continue;
        ++report.entries;
        const bool respelt = !entry.code.empty();
        const run::StageKey key{.stage = entry.stage, .entry = respelt ? entry.symbol : entry.name, .code = entry.code};
        const auto known = stages.find(key);
        if (known != stages.end() && known->second) entry.*slot = *known->second;
        if (known != stages.end() || work.respelt) continue;
        auto plain = run::compileStage(work.effect(), key, compiler); // as it is, to be written out: another source is drawn
        if (plain) entry.*slot = std::move(*plain);
    }
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
    const auto geometry = std::ranges::find(work.report.entries, ShaderStage::Geometry, &EntryPoint::stage);
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
                                                   .stage = entry.stage,
                                                   .language2018 = respelt || work.effect().reshade}));
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
