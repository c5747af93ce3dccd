#include "tools/check/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace tegument::check {

namespace {

/// The validator knows no lines.
std::vector<Diagnostic> placed(std::vector<Diagnostic> diagnostics, const SourcePosition& at) {
    for (Diagnostic& diagnostic : diagnostics)
        if (diagnostic.at.line == 0) diagnostic.at = at;
    return diagnostics;
}

/// Members of the constant blocks: SPIR-V's are laid out alike, and more is known of them.
void takeLayouts(Reflection& dxil, const Reflection& spirv) {
    const auto take = [](UniformBlock& into, const UniformBlock& from) {
        into.size = from.size;
        into.members = from.members;
    };
    if (dxil.globals && spirv.globals) take(*dxil.globals, *spirv.globals);
    for (UniformBlock& block : dxil.constantBuffers) {
        const auto found = std::ranges::find(spirv.constantBuffers, block.name, &UniformBlock::name);
        if (found != spirv.constantBuffers.end()) take(block, *found);
    }
}

/// Direct3D 12 joins stages by register, as Direct3D 11 does.
void linkDxil(const EntryPoint& vertex, const EntryPoint& pixel, TargetCheck& report) {
    const std::vector<SignatureElement>& outputs = vertex.dxil->outputs;
    for (const SignatureElement& input : pixel.dxil->inputs) {
        if (input.systemValue || input.used == 0) continue;
        const auto output = std::ranges::find(outputs, input.semantic, &SignatureElement::semantic);
        if (output == outputs.end() || (input.used & ~output->mask) != 0)
            addUnwritten(vertex, pixel, input.semantic, report);
        else if (output->location != input.location)
            addApart(vertex, pixel, input.semantic, output->location, input.location, report);
    }
}

void checkPosition(const EntryPoint& vertex, TargetCheck& report) {
    const auto& outputs = vertex.dxil->outputs;
    if (std::ranges::find(outputs, "SV_POSITION0", &SignatureElement::semantic) == outputs.end()) addMissingPosition(vertex, report);
}

} // namespace

void checkDxil(Work& work) {
    TargetCheck* report = work.find(Target::Dxil);
    if (report == nullptr) return;
    if (std::string reason = obstacleFor(work, Compiler::Dxc); !reason.empty()) return leaveOut(*report, std::move(reason));
    if (!compilerAvailable(Compiler::Dxc)) {
        report->reason = noCompiler(Compiler::Dxc);
        return;
    }
    const auto start = std::chrono::steady_clock::now();
    compileEach(work, *report, [](EntryPoint& entry, const ShaderRequest& request) {
        auto made = compileDxil(request);
        if (!made) return placed(made.error().diagnostics, entry.at);
        entry.dxil = std::move(*made);
        if (const auto spirv = compileShader(request, Compiler::Dxc)) takeLayouts(entry.dxil->reflection, spirv->reflection);
        return entry.dxil->warnings;
    });
    for (const StagePair& pair : work.pairs) {
        const EntryPoint& vertex = work.report.entries[pair.vertex];
        const EntryPoint& pixel = work.report.entries[pair.pixel];
        if (vertex.dxil) checkPosition(vertex, *report);
        if (vertex.dxil && pixel.dxil) linkDxil(vertex, pixel, *report);
    }
    report->milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    conclude(*report);
}

} // namespace tegument::check
