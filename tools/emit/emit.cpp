#include "tools/emit/emit.h"

#include "host/spirv/glsl.h"
#include "host/support/file.h"
#include "host/support/kept_inputs.h"
#include "host/support/system.h"
#include "host/support/temporary.h"
#include "tools/emit/products.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace tegument {

namespace fs = std::filesystem;

using emit::LinkedShader;
using emit::Products;

namespace {

struct KindNames {
    EmitKind kind;
    std::string_view name;
    std::array<std::string_view, 4> endings; // by ShaderKind
};
constexpr std::array<std::string_view, 4> kSpirvEndings = {".vs.spv", ".ps.spv", ".gs.spv", ".cs.spv"};
constexpr std::array<std::string_view, 4> kGlslEndings = {".vert", ".frag", ".geom", ".comp"};
constexpr std::array kKinds = {
    KindNames{EmitKind::Fx2, "fx_2_0", {}},
    KindNames{EmitKind::Fx4, "fx_4_0", {}},
    KindNames{EmitKind::Fx5, "fx_5_0", {}},
    KindNames{EmitKind::Sm5, "sm5", {".vs.cso", ".ps.cso", ".gs.cso", ".cs.cso"}},
    KindNames{EmitKind::Dxil, "dxil", {".vs.dxil", ".ps.dxil", ".gs.dxil", ".cs.dxil"}},
    KindNames{EmitKind::SpirvDxc, "spirv-dxc", kSpirvEndings},
    KindNames{EmitKind::SpirvGlslang, "spirv-glslang", kSpirvEndings},
    KindNames{EmitKind::Glsl, "glsl", kGlslEndings},
    KindNames{EmitKind::GlslEs, "glsl-es", kGlslEndings},
    KindNames{EmitKind::Msl, "msl", {".vs.metal", ".ps.metal", ".gs.metal", ".cs.metal"}},
};

const KindNames& names(EmitKind kind) {
    return *std::ranges::find(kKinds, kind, &KindNames::kind);
}

bool isTranslation(EmitKind kind) {
    return kind == EmitKind::Glsl || kind == EmitKind::GlslEs || kind == EmitKind::Msl;
}

CrossLanguage languageOf(EmitKind kind) {
    return kind == EmitKind::Glsl ? CrossLanguage::Glsl : kind == EmitKind::GlslEs ? CrossLanguage::GlslEs : CrossLanguage::Msl;
}

std::string bytesOf(const Shader& shader) {
    const auto bytes = std::as_bytes(std::span(shader.spirv));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool isGlsl(EmitKind kind) {
    return kind == EmitKind::Glsl || kind == EmitKind::GlslEs;
}

bool computes(const Technique& technique) {
    return std::ranges::any_of(technique.passes, [](const Pass& pass) { return pass.computeShader.has_value(); });
}

/// The reason why a kind cannot be written; empty when it can.
std::string missingReason(const FileReport& report, EmitKind kind) {
    const auto found = std::ranges::find(report.targets, targetOf(kind), &TargetCheck::target);
    if (found == report.targets.end()) return fmt::format("{} was not asked for", targetName(targetOf(kind)));
    if (found->verdict == Verdict::NotChecked || found->verdict == Verdict::NotApplicable)
        return fmt::format("{} {}: {}", targetName(found->target), verdictName(found->verdict), found->reason);
    const auto& techniques = report.effect.techniques;
    if (isGlsl(kind) && !techniques.empty() && std::ranges::all_of(techniques, computes))
        return "GLSL 330 and GLSL ES 300 have no compute shaders";
    return {};
}

void addFile(Products& products, LinkedShader& shader, EmitKind kind, std::string bytes) {
    const std::string file =
        fmt::format("{}/{}{}", emitKindName(kind), shader.name, names(kind).endings.at(static_cast<std::size_t>(shader.entry->kind)));
    shader.files[kind] = file;
    products.files[file] = std::move(bytes);
}

Result<void> addTranslation(Products& products, LinkedShader& shader, EmitKind kind) {
    auto translated = crossCompile(*shader.spirv(), languageOf(kind), shader.written);
    if (!translated) return translated.error();
    if (kind != EmitKind::Msl)
        if (const std::string why = checkGlsl(shader.spirv()->stage, translated->text); !why.empty())
            return machineError(
                3303, fmt::format("{}: the {} of {} is not valid: {}", shader.spirv()->file, emitKindName(kind), shader.name, why),
                "this is a fault of SPIRV-Cross or ours: leave this language out with --emit-kind, and report it");
    addFile(products, shader, kind, translated->text);
    shader.translated.emplace(kind, std::move(*translated));
    return {};
}

Result<void> addShader(Products& products, LinkedShader& shader, EmitKind kind) {
    if (isGlsl(kind) && shader.entry->kind == ShaderKind::Compute) return {}; // its technique is not for that language
    if (isTranslation(kind)) return shader.spirv() == nullptr ? Result<void>() : addTranslation(products, shader, kind);
    if (kind == EmitKind::Sm5 && !shader.entry->sm5.empty()) addFile(products, shader, kind, shader.entry->sm5);
    if (kind == EmitKind::Dxil && shader.entry->dxil) addFile(products, shader, kind, shader.entry->dxil->container);
    if (kind == EmitKind::SpirvDxc && shader.dxc) addFile(products, shader, kind, bytesOf(*shader.dxc));
    if (kind == EmitKind::SpirvGlslang && shader.glslang) addFile(products, shader, kind, bytesOf(*shader.glslang));
    return {};
}

/// Vertex and pixel text of each pass as one program: names and types of what passes between them.
Result<void> checkPrograms(const Products& products, EmitKind kind) {
    for (const auto& technique : products.passes)
        for (const emit::PassShaders& pass : technique) {
            if (pass.vertex < 0 || pass.pixel < 0) continue;
            const LinkedShader& vertex = products.shaders[static_cast<std::size_t>(pass.vertex)];
            const LinkedShader& pixel = products.shaders[static_cast<std::size_t>(pass.pixel)];
            const std::string why = checkGlslProgram(vertex.translated.at(kind).text, pixel.translated.at(kind).text);
            if (!why.empty())
                return machineError(3303,
                                    fmt::format("the {} of {} and {} do not link: {}", emitKindName(kind), vertex.name, pixel.name, why),
                                    "this is a fault of SPIRV-Cross or ours: leave this language out with --emit-kind, and report it");
        }
    return {};
}

Result<void> addKind(Products& products, const FileReport& report, EmitKind kind) {
    if (const std::string reason = missingReason(report, kind); !reason.empty()) {
        products.missing.emplace_back(kind, reason);
        return {};
    }
    if (const auto binary = report.binaries.find(targetOf(kind)); binary != report.binaries.end()) {
        const std::string file = fmt::format("{}.{}.fxo", report.file.stem().string(), emitKindName(kind));
        products.effects[kind] = file;
        products.files[file] = binary->second;
        return {};
    }
    for (LinkedShader& shader : products.shaders)
        if (auto added = addShader(products, shader, kind); !added) return added;
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

std::string_view emitKindName(EmitKind kind) {
    return names(kind).name;
}

std::vector<EmitKind> emitKindsByName(std::string_view name) {
    if (name == "all") return {kAllEmitKinds.begin(), kAllEmitKinds.end()};
    if (name == "spirv") return {EmitKind::SpirvDxc, EmitKind::SpirvGlslang};
    const auto* found = std::ranges::find(kKinds, name, &KindNames::name);
    return found == kKinds.end() ? std::vector<EmitKind>{} : std::vector{found->kind};
}

Target targetOf(EmitKind kind) {
    switch (kind) {
    case EmitKind::Fx2: return Target::Fx2;
    case EmitKind::Fx4: return Target::Fx4;
    case EmitKind::Fx5: return Target::Fx5;
    case EmitKind::Sm5: return Target::Sm5;
    case EmitKind::Dxil: return Target::Dxil;
    case EmitKind::SpirvGlslang: return Target::SpirvGlslang;
    default: return kind == EmitKind::SpirvDxc || compilerAvailable(Compiler::Dxc) ? Target::SpirvDxc : Target::SpirvGlslang;
    }
}

Result<fs::path> emitEffect(const FileReport& report, const EmitOptions& options) {
    if (report.failed()) return inputError(3301, {.file = report.file.string(), .byte = {}}, "did not pass and is not written");
    const fs::path folder = options.folder / report.variant / report.file.stem();
    if (auto free = mayReplace(folder); !free) return free.error();
    Products products = emit::linkShaders(report);
    for (const EmitKind kind : kAllEmitKinds)
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
