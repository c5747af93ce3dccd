#include "tools/check/check.h"

#include "host/effect/load.h"
#include "host/spirv/messages.h"
#include "host/support/file.h"
#include "meshprep/adopt/adopt.h"
#include "tools/check/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>

namespace tegument {

namespace {

bool isError(const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::Error;
}

/// The setting that is to be found out is left out.
LoadOptions loadOptions(const Variant& variant, const CheckOptions& options) {
    LoadOptions load{.defines = variant.defines, .includeFolders = options.includeFolders, .lenient = true};
    load.roots = options.roots;
    return load;
}

std::vector<Variant> variantsOf(const std::filesystem::path& file, const CheckOptions& options) {
    if (!options.allSettings) return options.variants;
    std::vector<Variant> all;
    for (const Variant& variant : options.variants)
        for (Variant setting : settingVariants(file, loadOptions(variant, options))) {
            setting.name = variant.name.empty() ? setting.name : variant.name + " " + setting.name;
            all.push_back(std::move(setting));
        }
    return all;
}

} // namespace

std::vector<Target> allTargets(bool written) {
    std::vector<Target> all;
    for (const TargetRow& row : kTargets)
        if (written || row.language.empty()) all.push_back(row.target);
    return all;
}

std::string targetNames(bool written) {
    std::string names;
    for (const Target target : allTargets(written))
        names += (names.empty() ? "" : ", ") + std::string(targetName(target));
    return names;
}

std::vector<Target> targetsByName(std::string_view name, bool written) {
    std::vector<Target> all = allTargets(written);
    if (name == "spirv") return {Target::SpirvDxc, Target::SpirvGlslang};
    if (name != "all") std::erase_if(all, [&](Target target) { return targetName(target) != name; });
    return all;
}

std::string_view verdictName(Verdict verdict) {
    switch (verdict) {
    case Verdict::Passed: return "passed";
    case Verdict::Failed: return "failed";
    case Verdict::NotApplicable: return "not applicable";
    case Verdict::NotChecked: return "not checked";
    }
    return "not checked";
}

std::vector<Variant> settingVariants(const std::filesystem::path& effect, const LoadOptions& options) {
    const auto loaded = loadEffect(effect, options);
    std::vector<Variant> variants;
    if (loaded && loaded->settings)
        for (const std::string& name : loaded->settings->names)
            variants.push_back({.name = name, .defines = options.defines, .setting = name});
    return variants.empty() ? std::vector{Variant{.defines = options.defines}} : variants;
}

bool FileReport::failed() const {
    return std::ranges::any_of(diagnostics, isError) ||
           std::ranges::any_of(targets, [](const TargetCheck& target) { return target.verdict == Verdict::Failed; });
}

bool FileReport::decided() const {
    return std::ranges::any_of(
        targets, [](const TargetCheck& target) { return target.verdict == Verdict::Passed || target.verdict == Verdict::Failed; });
}

bool CheckReport::decided() const {
    return std::ranges::all_of(files, &FileReport::decided);
}

bool CheckReport::failed() const {
    return std::ranges::any_of(files, &FileReport::failed);
}

bool CheckReport::complete() const {
    return std::ranges::none_of(files, [](const FileReport& file) {
        return std::ranges::any_of(file.targets, [](const TargetCheck& target) { return target.verdict == Verdict::NotChecked; });
    });
}

CheckReport checkEffects(const std::vector<std::filesystem::path>& files, const std::vector<Target>& targets, const CheckOptions& options) {
    if (files.empty()) return {};
    std::vector<check::Work> works;
    std::vector<std::vector<Variant>> variants;
    for (const std::filesystem::path& file : files)
        variants.push_back(variantsOf(file, options));
    const auto most = std::ranges::max(variants, {}, &std::vector<Variant>::size).size();
    for (std::size_t variant = 0; variant < most; ++variant)
        for (std::size_t file = 0; file < files.size(); ++file)
            if (variant < variants[file].size()) works.push_back(check::load(files[file], variants[file][variant], targets, options));
    // Wine is started from this thread: what it leaves running ends with the thread that started it.
    auto spirv = std::async(std::launch::async, [&] {
        for (check::Work& work : works)
            if (work.loaded()) check::checkSpirv(work);
    });
    auto dxil = std::async(std::launch::async, [&] {
        for (check::Work& work : works)
            if (work.loaded()) check::checkDxil(work);
    });
    check::checkMicrosoft(works);
    spirv.get();
    dxil.get();
    for (check::Work& work : works)
        check::compareTargets(work);
    CheckReport report;
    for (check::Work& work : works)
        report.files.push_back(std::move(work.report));
    return report;
}

namespace check {

namespace {

bool mentions(const std::filesystem::path& file, std::string_view word) {
    const auto text = readFile(file);
    return text && text->find(word) != std::string::npos;
}

/// The file's own entry points, each with the source that meshprep/adopt has for it where DXC needs one.
void collectEntries(Work& work) {
    work.respelt = needsRespelling(work.effect());
    if (!work.effect().ownDialect) work.drawn = adopted(work.effect()).effect;
    Effect both = work.effect();
    for (std::size_t t = 0; work.respelt && t < both.techniques.size(); ++t)
        for (std::size_t p = 0; p < both.techniques[t].passes.size(); ++p)
            for (const auto stage : {&Pass::vertexShader, &Pass::pixelShader}) {
                auto& own = both.techniques[t].passes[p].*stage;
                const auto& respelt = work.drawn->techniques[t].passes[p].*stage;
                if (!own || !respelt) continue;
                own->code = respelt->code;
                own->original = respelt->entry;
                own->obstacle = respelt->obstacle;
            }
    for (const ShaderUse& use : entryPoints(both)) {
        const ShaderReference& shader = *use.shader;
        work.report.entries.push_back({.name = shader.entry,
                                       .stage = use.stage,
                                       .profile = shader.profile,
                                       .at = shader.at,
                                       .arguments = shader.arguments,
                                       .code = shader.code,
                                       .symbol = shader.original,
                                       .obstacle = shader.obstacle,
                                       .undrawn = use.undrawn});
    }
    const auto place = [&](const ShaderReference& shader, ShaderStage stage) {
        const auto found = std::ranges::find_if(work.report.entries, [&](const EntryPoint& e) {
            return e.name == shader.entry && e.stage == stage && e.arguments == shader.arguments && e.code == shader.code;
        });
        return static_cast<std::size_t>(found - work.report.entries.begin());
    };
    for (const Technique& technique : both.techniques)
        for (const Pass& pass : technique.passes) {
            if (!pass.vertexShader || !pass.pixelShader || needsOtherStages(pass)) continue;
            const StagePair made{place(*pass.vertexShader, ShaderStage::Vertex), place(*pass.pixelShader, ShaderStage::Pixel)};
            if (std::ranges::none_of(work.pairs,
                                     [&](const StagePair& pair) { return pair.vertex == made.vertex && pair.pixel == made.pixel; }))
                work.pairs.push_back(made);
        }
}

} // namespace

bool Work::loaded() const {
    return std::ranges::none_of(report.diagnostics, isError);
}

TargetCheck* Work::find(Target target) {
    const auto found = std::ranges::find(report.targets, target, &TargetCheck::target);
    return found == report.targets.end() ? nullptr : &*found;
}

Work load(const std::filesystem::path& file, const Variant& variant, const std::vector<Target>& targets, const CheckOptions& options) {
    Work work{.file = file, .variant = variant, .includeFolders = options.includeFolders};
    work.compatible = options.compatible;
    work.report.file = file;
    work.report.variant = variant.name;
    for (const Target target : targets)
        work.report.targets.push_back({.target = target});
    LoadOptions wanted = loadOptions(variant, options);
    wanted.setting = variant.setting;
    auto effect = loadEffect(file, wanted);
    if (!effect) {
        work.report.diagnostics = effect.error().diagnostics;
        for (TargetCheck& target : work.report.targets)
            target.verdict = Verdict::Failed;
        return work;
    }
    work.report.effect = std::move(*effect);
    work.report.diagnostics = work.effect().warnings;
    work.dialect = mentions(file, "FX_D3D10") ||
                   std::ranges::any_of(work.effect().includes, [](const auto& path) { return mentions(path, "FX_D3D10"); });
    collectEntries(work);
    if (work.dialect && work.find(Target::Fx2) != nullptr) {
        if (auto nine = loadEffectOfDirect3D9(file, wanted)) work.nine = std::move(*nine);
    }
    return work;
}

std::string spellingObstacle(const Work& work) {
    if (work.report.entries.empty()) return "no pass names a shader";
    if (const auto intrinsic = direct3D9Intrinsic(work.effect()))
        return fmt::format("written for Direct3D 9: intrinsic at {}({},{})", intrinsic->at.file, intrinsic->at.line, intrinsic->at.column);
    return {};
}

void addError(TargetCheck& report, int code, SourcePosition at, std::string text, std::string hint) {
    report.diagnostics.push_back(
        {.severity = Severity::Error, .code = code, .at = std::move(at), .text = std::move(text), .hint = std::move(hint)});
}

void addUnwritten(const EntryPoint& vertex, const EntryPoint& pixel, std::string_view semantic, TargetCheck& report) {
    addError(report, 3004, pixel.at, fmt::format("{} reads {}, which {} does not write", pixel.name, semantic, vertex.name),
             "give both the same struct, and every member a value");
}

void addApart(const EntryPoint& vertex, const EntryPoint& pixel, std::string_view semantic, std::uint32_t written, std::uint32_t read,
              TargetCheck& report) {
    addError(report, 3205, pixel.at,
             fmt::format("{} reads {} from register {}, {} writes it to register {}", pixel.name, semantic, read, vertex.name, written),
             "give both the same struct");
}

void addMissingPosition(const EntryPoint& vertex, TargetCheck& report) {
    report.diagnostics.push_back(writesNoPosition(vertex.name, vertex.at).diagnostics.front());
}

void leaveOut(TargetCheck& report, std::string reason) {
    report.verdict = Verdict::NotApplicable;
    report.reason = std::move(reason);
}

bool wasChecked(const TargetCheck& report) {
    return report.verdict == Verdict::Passed || report.verdict == Verdict::Failed;
}

void conclude(TargetCheck& report) {
    report.verdict = std::ranges::any_of(report.diagnostics, isError) ? Verdict::Failed : Verdict::Passed;
    report.diagnostics = shortened(std::move(report.diagnostics));
}

} // namespace check

} // namespace tegument
