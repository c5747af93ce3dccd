#include "tools/emit/emit.h"

#include "host/spirv/glsl.h"
#include "host/support/file.h"
#include "host/support/kept_inputs.h"
#include "host/support/system.h"
#include "host/support/temporary.h"
#include "tools/emit/products.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument {

namespace fs = std::filesystem;

using emit::LinkedShader;
using emit::Products;

namespace {

bool isGlsl(Target kind) {
    return kind == Target::Glsl || kind == Target::GlslEs;
}

std::string endingOf(Target kind, ShaderStage stage) {
    const StageNames& names = stageNames(stage);
    return isGlsl(kind) ? std::string(names.ending) : fmt::format(".{}{}", names.profile, rowOf(kind).ending);
}

bool computes(const Technique& technique) {
    return std::ranges::any_of(technique.passes, [](const Pass& pass) { return pass.computeShader.has_value(); });
}

/// The reason why a kind cannot be written; empty when it can.
std::string missingReason(const FileReport& report, Target kind) {
    const auto found = std::ranges::find(report.targets, sourceOf(kind), &TargetCheck::target);
    if (found == report.targets.end()) return fmt::format("{} was not asked for", targetName(sourceOf(kind)));
    if (found->verdict == Verdict::NotChecked || found->verdict == Verdict::NotApplicable)
        return fmt::format("{} {}: {}", targetName(found->target), verdictName(found->verdict), found->reason);
    const auto& techniques = report.effect.techniques;
    if (isGlsl(kind) && !techniques.empty() && std::ranges::all_of(techniques, computes))
        return "GLSL 330 and GLSL ES 300 have no compute shaders";
    return {};
}

void addFile(Products& products, LinkedShader& shader, Target kind, std::string bytes) {
    const std::string file = fmt::format("{}/{}{}", targetName(kind), shader.name, endingOf(kind, shader.entry->stage));
    shader.files[kind] = file;
    products.files[file] = std::move(bytes);
}

Result<void> addTranslation(Products& products, LinkedShader& shader, Target kind, const Effect& effect) {
    auto translated = crossCompile(*shader.spirv(), kind, shader.written);
    const bool needed = !isGlsl(kind) || !belongsToCompute(effect, shader.entry->name);
    if (!translated) return needed ? Result<void>(translated.error()) : Result<void>();
    if (kind != Target::Msl)
        if (const std::string why = checkGlsl(shader.spirv()->stage, translated->text); !why.empty())
            return !needed ? Result<void>()
                           : machineError(
                                 3303,
                                 fmt::format("{}: the {} of {} is not valid: {}", shader.spirv()->file, targetName(kind), shader.name, why),
                                 "this is a fault of SPIRV-Cross or ours: leave this language out with --emit-kind, and report it");
    addFile(products, shader, kind, translated->text);
    shader.translated.emplace(kind, std::move(*translated));
    return {};
}

Result<void> addShader(Products& products, LinkedShader& shader, Target kind, const Effect& effect) {
    if (isGlsl(kind) && shader.entry->stage == ShaderStage::Compute) return {}; // its technique is not for that language
    if (!rowOf(kind).language.empty()) return shader.spirv() == nullptr ? Result<void>() : addTranslation(products, shader, kind, effect);
    if (const std::string_view bytes = emit::formOf(shader, kind).bytes; !bytes.empty())
        addFile(products, shader, kind, std::string(bytes));
    return {};
}

/// Vertex and pixel text of each pass as one program: names and types of what passes between them.
Result<void> checkPrograms(const Products& products, Target kind) {
    for (const auto& technique : products.passes)
        for (const emit::PassShaders& pass : technique) {
            if (pass.vertex < 0 || pass.pixel < 0) continue;
            const LinkedShader& vertex = products.shaders[static_cast<std::size_t>(pass.vertex)];
            const LinkedShader& pixel = products.shaders[static_cast<std::size_t>(pass.pixel)];
            if (!vertex.translated.contains(kind) || !pixel.translated.contains(kind)) continue; // its technique is not for that language
            const std::string why = checkGlslProgram(vertex.translated.at(kind).text, pixel.translated.at(kind).text);
            if (!why.empty())
                return machineError(3303,
                                    fmt::format("the {} of {} and {} do not link: {}", targetName(kind), vertex.name, pixel.name, why),
                                    "this is a fault of SPIRV-Cross or ours: leave this language out with --emit-kind, and report it");
        }
    return {};
}

Result<void> addKind(Products& products, const FileReport& report, Target kind) {
    if (const std::string reason = missingReason(report, kind); !reason.empty()) {
        products.missing.emplace_back(kind, reason);
        return {};
    }
    if (const auto binary = report.binaries.find(sourceOf(kind)); binary != report.binaries.end()) {
        const std::string file = fmt::format("{}.{}.fxo", report.file.stem().string(), targetName(kind));
        products.effects[kind] = file;
        products.files[file] = binary->second;
        return {};
    }
    for (LinkedShader& shader : products.shaders)
        if (auto added = addShader(products, shader, kind, report.effect); !added) return added;
    return isGlsl(kind) ? checkPrograms(products, kind) : Result<void>();
}

Result<void> mayReplace(const fs::path& folder) {
    std::error_code code;
    if (!fs::exists(folder, code) || fs::is_empty(folder, code)) return {};
    if (auto free = holdsNoInput(folder); !free) return free;
    const auto text = readFile(folder / "manifest.json");
    if (text && emit::isManifest(*text)) return {};
    return usageError(3304, fmt::format("{} holds something else and is left alone", folder.string()), "name another folder with --emit");
}

Result<void> writeAll(const fs::path& folder, const Products& products, const std::string& manifest) {
    for (const auto& [name, bytes] : products.files)
        if (auto written = writeFile(folder / name, bytes); !written) return written;
    return writeFile(folder / "manifest.json", manifest);
}

/// At one moment where the file system can exchange two folders; elsewhere there is a moment without either.
Result<void> replace(const fs::path& folder, const fs::path& with) {
    std::error_code code;
    if (exchangeFolders(with, folder)) return {};
    fs::remove_all(folder, code);
    if (!code) fs::rename(with, folder, code);
    if (code) return machineError(5002, fmt::format("cannot write {}: {}", folder.string(), code.message()));
    return {};
}

} // namespace

bool belongsToCompute(const Effect& effect, std::string_view entry) {
    const auto isIt = [&](const std::optional<ShaderReference>& shader) { return shader && shader->entry == entry; };
    return std::ranges::none_of(effect.techniques, [&](const Technique& technique) {
        return !computes(technique) &&
               std::ranges::any_of(technique.passes, [&](const Pass& pass) { return isIt(pass.vertexShader) || isIt(pass.pixelShader); });
    });
}

Target sourceOf(Target target) {
    if (rowOf(target).language.empty()) return target;
    return compilerAvailable(Compiler::Dxc) ? Target::SpirvDxc : Target::SpirvGlslang;
}

Result<fs::path> emitEffect(const FileReport& report, const EmitOptions& options) {
    if (report.failed()) return inputError(3301, {.file = report.file.string()}, "did not pass and is not written");
    const fs::path folder = options.folder / report.variant / report.file.stem();
    if (auto free = mayReplace(folder); !free) return free.error();
    Products products = emit::linkShaders(report);
    for (const Target kind : allTargets(true))
        if (std::ranges::find(options.kinds, kind) != options.kinds.end())
            if (auto added = addKind(products, report, kind); !added) return added.error();

    const Temporary temporary(folder.string() + fmt::format(".tmp.{}", processNumber()));
    std::error_code code;
    fs::remove_all(temporary.path(), code);
    auto written = writeAll(temporary.path(), products, emit::manifest(report, options, products));
    if (written) written = replace(folder, temporary.path());
    if (!written) return written.error();
    for (const auto& [name, bytes] : products.files)
        kept::noteWritten(folder / name);
    kept::noteWritten(folder / "manifest.json");
    return folder;
}

} // namespace tegument
