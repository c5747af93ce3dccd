#include "host/check/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tegument::check {

namespace {

/// What a job's result belongs to.
struct Ticket {
    Work* work;
    TargetCheck* report;
    const EntryPoint* entry; // null: the effect as a whole
};

struct Batch {
    std::vector<MicrosoftJob> jobs;
    std::vector<Ticket> tickets;
};

struct Expected {
    int techniques = 0;
    int passes = 0;
    int shaders = 0;
};

int shadersOf(const Pass& pass) {
    return static_cast<int>(pass.vertexShader.has_value()) + static_cast<int>(pass.pixelShader.has_value()) +
           static_cast<int>(pass.geometryShader.has_value()) + static_cast<int>(pass.computeShader.has_value());
}

/// Files that do not distinguish targets keep only the techniques that are written for the target.
bool exists(const Technique& technique, Target target, bool dialect) {
    if (dialect) return true;
    switch (target) {
    case Target::Fx2: return technique.kind == TechniqueKind::D3D9;
    case Target::Fx4: return technique.kind == TechniqueKind::D3D10;
    default: return technique.kind != TechniqueKind::D3D9;
    }
}

Expected expectedIn(const Work& work, Target target) {
    Expected expected;
    for (const Technique& technique : work.effect.techniques) {
        if (!exists(technique, target, work.dialect)) continue;
        ++expected.techniques;
        expected.passes += static_cast<int>(technique.passes.size());
        for (const Pass& pass : technique.passes)
            expected.shaders += shadersOf(pass);
    }
    return expected;
}

std::vector<std::pair<std::string, std::string>> definesFor(const Work& work, Target target) {
    auto defines = work.variant->defines;
    if (target == Target::Fx4) defines.emplace_back("FX_D3D10", "1");
    if (target == Target::Fx5) defines.emplace_back("FX_D3D11", "1");
    return defines;
}

/// The profile that measures an entry point against shader model 3; empty where that says nothing.
std::string sm3Profile(const EntryPoint& entry, bool dialect) {
    if (entry.kind != ShaderKind::Vertex && entry.kind != ShaderKind::Pixel) return {};
    const std::string profile = entry.kind == ShaderKind::Vertex ? "vs_3_0" : "ps_3_0";
    return dialect || entry.profile == profile ? profile : std::string();
}

void addJobs(Work& work, Target target, Batch& batch) {
    TargetCheck* report = work.find(target);
    if (report == nullptr || !work.loaded()) return;
    if (expectedIn(work, target).techniques == 0) {
        report->reason = fmt::format("the file has no technique for {}", targetName(target));
        return;
    }
    const auto defines = definesFor(work, target);
    batch.jobs.push_back({.profile = std::string(targetName(target)), .entry = {}, .source = work.file, .defines = defines, .output = {}});
    batch.tickets.push_back({&work, report, nullptr});
    if (target != Target::Fx2) return;
    for (const EntryPoint& entry : work.entries) {
        const std::string profile = sm3Profile(entry, work.dialect);
        if (profile.empty()) continue;
        batch.jobs.push_back({.profile = profile, .entry = entry.name, .source = work.file, .defines = defines, .output = {}});
        batch.tickets.push_back({&work, report, &entry});
    }
}

void addError(TargetCheck& report, int code, SourcePosition at, std::string text, std::string hint) {
    report.diagnostics.push_back({.severity = Severity::Error,
                                  .code = code,
                                  .at = std::move(at),
                                  .text = std::move(text),
                                  .hint = std::move(hint),
                                  .sourceLine = {}});
}

/// Microsoft's compiler drops blocks that it does not know without a word.
void compareCounts(const Work& work, const MicrosoftResult& result, TargetCheck& report) {
    const Expected expected = expectedIn(work, report.target);
    const auto compare = [&](std::string_view what, int inBinary, int inFile) {
        if (inBinary == inFile) return;
        addError(report, 3202, {.file = work.file.string(), .byte = {}},
                 fmt::format("{} holds {} {}, the file has {}", targetName(report.target), inBinary, what, inFile),
                 "write techniques inside #ifdef FX_TECHNIQUES with the word `technique`");
    };
    compare("techniques", result.techniqueCount, expected.techniques);
    if (result.passCount >= 0) compare("passes", result.passCount, expected.passes);
    if (result.shaderCount >= 0) compare("shaders", result.shaderCount, expected.shaders);
}

struct Limit {
    std::string_view what;
    int Sm3Usage::*used;
    int vertex;
    int pixel;
};

/// What Direct3D 9 promises for shader model 3 (MaxVertexShader30InstructionSlots and MaxPixelShader30InstructionSlots are at least 512).
/// A vertex shader may write 11 registers besides the position, but a pixel shader reads 10.
constexpr std::array kLimits = {Limit{"instruction slots", &Sm3Usage::instructionSlots, 512, 512},
                                Limit{"constant registers", &Sm3Usage::constants, 256, 224}, Limit{"samplers", &Sm3Usage::samplers, 4, 16},
                                Limit{"interpolators", &Sm3Usage::interpolators, 10, 10}};

void holdAgainstLimits(const EntryPoint& entry, const Sm3Usage& usage, TargetCheck& report) {
    const bool vertex = entry.kind == ShaderKind::Vertex;
    for (const Limit& limit : kLimits) {
        const int most = vertex ? limit.vertex : limit.pixel;
        if (usage.*limit.used <= most) continue;
        addError(report, 3203, entry.at,
                 fmt::format("{} takes {} {}, {} has {}", entry.name, usage.*limit.used, limit.what, vertex ? "vs_3_0" : "ps_3_0", most),
                 "split the pass, or keep this entry point out of fx_2_0");
    }
}

void take(const Ticket& ticket, const MicrosoftResult& result) {
    TargetCheck& report = *ticket.report;
    report.diagnostics.insert(report.diagnostics.end(), result.diagnostics.begin(), result.diagnostics.end());
    report.milliseconds += result.milliseconds;
    if (ticket.entry == nullptr) {
        if (result.ok) compareCounts(*ticket.work, result, report);
        report.entries = expectedIn(*ticket.work, report.target).shaders;
        return;
    }
    if (!result.ok) return;
    if (!result.sm3)
        return addError(report, 3203, ticket.entry->at, fmt::format("the listing of {} cannot be read", ticket.entry->name), "");
    ticket.work->report.sm3.push_back({ticket.entry->name, ticket.entry->kind == ShaderKind::Vertex ? "vs_3_0" : "ps_3_0", *result.sm3});
    holdAgainstLimits(*ticket.entry, *result.sm3, report);
}

void leaveUnchecked(const Batch& batch, const std::string& reason) {
    for (const Ticket& ticket : batch.tickets)
        ticket.report->reason = reason;
}

} // namespace

void checkMicrosoft(std::vector<Work>& works) {
    Batch batch;
    for (Work& work : works)
        for (const Target target : {Target::Fx2, Target::Fx4, Target::Fx5})
            addJobs(work, target, batch);
    if (batch.jobs.empty()) return;
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) return leaveUnchecked(batch, missing);
    const auto results = compileWithMicrosoft(batch.jobs);
    if (!results) return leaveUnchecked(batch, format(results.error()));
    for (std::size_t i = 0; i < results->size(); ++i)
        take(batch.tickets[i], (*results)[i]);
    for (const Ticket& ticket : batch.tickets)
        if (ticket.entry == nullptr) conclude(*ticket.report);
}

} // namespace tegument::check
