#include "tools/check/work.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::check {

namespace {

/// What a job's result belongs to.
struct Ticket {
    Work* work;
    TargetCheck* report;
    EntryPoint* entry; // null: the effect as a whole
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
           static_cast<int>(pass.geometryShader.has_value()) + static_cast<int>(pass.computeShader.has_value()) +
           static_cast<int>(pass.hullShader.has_value()) + static_cast<int>(pass.domainShader.has_value()) + pass.assemblyShaders;
}

/// Compute shaders are Direct3D 11's: the dialect hides such a technique from the others.
bool computes(const Technique& technique) {
    return std::ranges::any_of(technique.passes, [](const Pass& pass) { return pass.computeShader.has_value(); });
}

Expected expectedIn(const Work& work, Target target) {
    Expected expected;
    for (const Technique* technique : techniquesIn(work, target)) {
        ++expected.techniques;
        expected.passes += static_cast<int>(technique->passes.size());
        for (const Pass& pass : technique->passes)
            expected.shaders += shadersOf(pass);
    }
    return expected;
}

std::vector<std::pair<std::string, std::string>> definesFor(const Work& work, Target target) {
    auto defines = work.effect().defines;
    if (target == Target::Fx4) defines.emplace_back("FX_D3D10", "1");
    if (target == Target::Fx5) defines.emplace_back("FX_D3D11", "1");
    if (target == Target::Sm5) defines.emplace_back("FX_ENTRY", "1");
    return defines;
}

void addJob(Work& work, TargetCheck& report, EntryPoint* entry, std::string profile, Batch& batch) {
    batch.jobs.push_back({.profile = std::move(profile),
                          .entry = entry == nullptr ? "" : entry->name,
                          .source = work.file,
                          .defines = definesFor(work, report.target),
                          .includeFolders = work.includeFolders,
                          .compatible = work.compatible,
                          .roots = work.effect().roots});
    batch.tickets.push_back({&work, &report, entry});
}

void addEffect(Work& work, Target target, Batch& batch) {
    TargetCheck* report = work.find(target);
    if (report == nullptr || !work.loaded()) return;
    if (expectedIn(work, target).techniques == 0)
        leaveOut(*report, fmt::format("the file has no technique for {}", targetName(target)));
    else
        addJob(work, *report, nullptr, std::string(targetName(target)), batch);
}

void addEntries(Work& work, Batch& batch) {
    TargetCheck* report = work.find(Target::Sm5);
    if (report == nullptr || !work.loaded()) return;
    if (std::string obstacle = spellingObstacle(work); !obstacle.empty()) return leaveOut(*report, std::move(obstacle));
    for (EntryPoint& entry : work.report.entries)
        addJob(work, *report, &entry, fmt::format("{}_5_0", stageNames(entry.stage).profile), batch);
}

/// "... in Technique T, Pass P.": the linkage errors of fx_4_0 and fx_5_0 name the pass and no line.
const Pass* namedPass(const Effect& effect, std::string_view text) {
    for (const Technique& technique : effect.techniques)
        for (const Pass& pass : technique.passes)
            if (text.find(fmt::format("in Technique {}, Pass {}.", technique.name, pass.name)) != std::string_view::npos) return &pass;
    return nullptr;
}

void locate(const Work& work, std::vector<Diagnostic>& diagnostics) {
    const Pass* pass = nullptr;
    for (const Diagnostic& diagnostic : diagnostics)
        if (pass == nullptr) pass = namedPass(work.effect(), diagnostic.text);
    for (Diagnostic& diagnostic : diagnostics)
        if (pass != nullptr && diagnostic.at.line == 0) diagnostic.at = pass->pixelShader ? pass->pixelShader->at : pass->at;
}

/// Strings lie in the binary as they are, with a zero byte behind, and a zero byte (of a length, or of another string) before.
SourcePosition firstMissing(const Work& work, std::string_view binary, Target target) {
    for (const Technique* technique : techniquesIn(work, target)) {
        const std::string name = '\0' + technique->name + '\0';
        if (binary.find(name) == std::string_view::npos) return technique->at;
    }
    return {.file = work.file.string()};
}

/// Microsoft's compiler drops blocks that it does not know without a word.
void compareCounts(const Work& work, const MicrosoftResult& result, TargetCheck& report) {
    const Expected expected = expectedIn(work, report.target);
    const auto compare = [&](std::string_view what, int inBinary, int inFile) {
        if (inBinary == inFile) return;
        addError(report, 3202, firstMissing(work, result.binary, report.target),
                 fmt::format("{} holds {} {}, the file has {}", targetName(report.target), inBinary, what, inFile),
                 "write techniques inside #ifdef FX_TECHNIQUES with the word `technique`");
    };
    compare("techniques", result.techniqueCount, expected.techniques);
    if (result.passCount >= 0) compare("passes", result.passCount, expected.passes);
    // Arrays of shaders stand in the binary whether a pass uses them or not.
    if (result.shaderCount >= 0 && work.effect().ownDialect) compare("shaders", result.shaderCount, expected.shaders);
}

void takeEffect(Work& work, MicrosoftResult& result, TargetCheck& report) {
    report.entries = expectedIn(work, report.target).shaders;
    if (!result.ok) return;
    compareCounts(work, result, report);
    work.report.binaries[report.target] = std::move(result.binary);
}

void takeEntry(EntryPoint& entry, MicrosoftResult& result, TargetCheck& report) {
    ++report.entries;
    if (!result.ok) return;
    if (!result.sm5)
        return addError(report, 3103, entry.at, fmt::format("the compiled {} cannot be read back by Microsoft's compiler", entry.name), "");
    entry.sm5 = std::move(result.binary);
    entry.sm5Reflection = std::move(result.sm5);
}

void take(const Ticket& ticket, MicrosoftResult& result) {
    TargetCheck& report = *ticket.report;
    locate(*ticket.work, result.diagnostics);
    report.diagnostics.insert(report.diagnostics.end(), result.diagnostics.begin(), result.diagnostics.end());
    report.milliseconds += result.milliseconds;
    if (ticket.entry == nullptr)
        takeEffect(*ticket.work, result, report);
    else
        takeEntry(*ticket.entry, result, report);
}

void leaveUnchecked(const Batch& batch, const std::string& reason) {
    for (const Ticket& ticket : batch.tickets)
        ticket.report->reason = reason;
}

/// Direct3D 11 without effects joins stages by register: nobody but us would see that a semantic lies in two places.
void linkSm5(const Work& work, const StagePair& pair, TargetCheck& report) {
    const EntryPoint& vertex = work.report.entries[pair.vertex];
    const EntryPoint& pixel = work.report.entries[pair.pixel];
    if (!vertex.sm5Reflection || !pixel.sm5Reflection) return;
    const auto& outputs = vertex.sm5Reflection->reflection.outputs;
    const auto& unwritten = vertex.sm5Reflection->unwritten;
    for (const StageVariable& input : pixel.sm5Reflection->reflection.inputs) {
        const auto output = std::ranges::find(outputs, input.semantic, &StageVariable::semantic);
        if (output == outputs.end() || std::ranges::find(unwritten, input.semantic) != unwritten.end())
            addUnwritten(vertex, pixel, input.semantic, report);
        else if (output->location != input.location)
            addApart(vertex, pixel, input.semantic, output->location, input.location, report);
    }
}

/// Of vertex shaders before a rasteriser.
void checkPositions(const Work& work, TargetCheck& report) {
    for (const StagePair& pair : work.pairs) {
        const EntryPoint& vertex = work.report.entries[pair.vertex];
        if (vertex.sm5Reflection && !vertex.sm5Reflection->writesPosition) addMissingPosition(vertex, report);
    }
}

/// A technique that Direct3D 9 does not read stays in the list: what is dropped without a word is to be found.
const Technique& readBy9(const Effect& nine, const Technique& technique) {
    const auto found = std::ranges::find(nine.techniques, technique.name, &Technique::name);
    return found == nine.techniques.end() ? technique : *found;
}

} // namespace

std::vector<const Technique*> techniquesIn(const Work& work, Target target) {
    std::vector<const Technique*> found;
    for (const Technique& written : work.effect().techniques) {
        const Technique& technique = target == Target::Fx2 && work.nine ? readBy9(*work.nine, written) : written;
        const bool nine = technique.kind == TechniqueKind::D3D9;
        const bool ten = technique.kind == TechniqueKind::D3D10;
        // Files that do not distinguish targets keep only the techniques that are written for the target.
        const bool exists = (work.dialect && (target == Target::Fx5 || !computes(technique))) || (target == Target::Fx2   ? nine
                                                                                                  : target == Target::Fx4 ? ten
                                                                                                                          : !nine);
        if (exists) found.push_back(&technique);
    }
    return found;
}

void checkMicrosoft(std::vector<Work>& works) {
    Batch batch; // the long jobs first, so that no process waits for the other's last one
    for (const Target target : {Target::Fx2, Target::Fx4, Target::Fx5})
        for (Work& work : works)
            addEffect(work, target, batch);
    for (Work& work : works)
        addEntries(work, batch);
    if (batch.jobs.empty()) return;
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) return leaveUnchecked(batch, missing);
    auto results = compileWithMicrosoft(batch.jobs);
    if (!results) return leaveUnchecked(batch, format(results.error()));
    for (std::size_t i = 0; i < results->size(); ++i)
        take(batch.tickets[i], (*results)[i]);
    measureShaderModel3(works);
    for (Work& work : works) {
        TargetCheck* sm5 = work.find(Target::Sm5);
        if (sm5 == nullptr) continue;
        for (const StagePair& pair : work.pairs)
            linkSm5(work, pair, *sm5);
        checkPositions(work, *sm5);
    }
    for (const Ticket& ticket : batch.tickets)
        if (ticket.report->verdict == Verdict::NotChecked) conclude(*ticket.report);
}

} // namespace tegument::check
