#include "host/spirv/backend.h"
#include "host/spirv/cache.h"
#include "host/spirv/dxil.h"
#include "host/spirv/instructions.h"
#include "host/spirv/reflect.h"
#include "host/spirv/validate.h"
#include "host/support/cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace tegument::spirv {
namespace {

constexpr std::size_t kSampled = 7; // words of OpTypeImage: 2 means written and read without a sampler
constexpr std::size_t kFormat = 8;

void addCapability(std::vector<std::uint32_t>& words, spv::Capability capability) {
    const std::uint32_t head = 2U << spv::WordCountShift | spv::OpCapability;
    words.insert(words.begin() + kModuleHeader, {head, static_cast<std::uint32_t>(capability)});
}

/// The level of such a read follows from how the coordinates of neighbouring pixels differ.
bool takesLevelsByDerivatives(const std::vector<std::uint32_t>& words) {
    bool found = false;
    forEachInstruction(std::span(words), [&](spv::Op op, std::span<const std::uint32_t>) {
        found = found || op == spv::OpImageSampleImplicitLod || op == spv::OpImageSampleDrefImplicitLod ||
                op == spv::OpImageSampleProjImplicitLod || op == spv::OpImageSampleProjDrefImplicitLod;
    });
    return found;
}

/// Takes the format out of the types of storage images, where both compilers write rgba32f for float4: what is bound decides. False: two
/// types would become the same, which SPIR-V does not allow; the module is as it was.
bool forgetStorageFormats(std::vector<std::uint32_t>& words) {
    std::vector<std::uint32_t> changed = words;
    std::set<std::vector<std::uint32_t>> types; // without their results
    bool any = false;
    bool reads = false;
    bool writes = false;
    bool twice = false;
    forEachInstruction(std::span(changed), [&](spv::Op op, std::span<std::uint32_t> instruction) {
        reads = reads || op == spv::OpImageRead;
        writes = writes || op == spv::OpImageWrite;
        if (op != spv::OpTypeImage || instruction.size() <= kFormat) return;
        if (instruction[kSampled] == 2) {
            instruction[kFormat] = spv::ImageFormatUnknown;
            any = true;
        }
        twice = twice || !types.emplace(instruction.begin() + 2, instruction.end()).second;
    });
    if (!any) return true;
    if (twice) return false;
    if (reads) addCapability(changed, spv::CapabilityStorageImageReadWithoutFormat);
    if (writes) addCapability(changed, spv::CapabilityStorageImageWriteWithoutFormat);
    words = std::move(changed);
    return true;
}

} // namespace
} // namespace tegument::spirv

namespace tegument {

namespace {

/// Sets of compile.h: what both stages of a pipeline declare must not meet.
std::uint32_t descriptorSet(ShaderStage stage) {
    return stage == ShaderStage::Pixel ? 1 : 0;
}

/// Messages then name the file as the request does, also where the code brings no #line of its own.
std::string withLineDirective(const ShaderRequest& request) {
    std::string name = request.file;
    std::ranges::replace_if(
        name, [](char c) { return c == '"' || c == '\n' || c == '\\'; }, '_');
    return fmt::format("#line 1 \"{}\"\n{}", name, request.code);
}

std::string dxcIdentity(dxc::Output output) {
    return dxc::identity() + dxc::flags(output);
}

/// `identity`: of the compiler and its flags.
std::string cacheKey(const ShaderRequest& request, const std::string& identity) {
    CacheKey key(kShaderFormat);
    key.add(identity).add(spirv::validatorName()).add(request.entry).add(request.stage);
    if (request.stage == ShaderStage::Compute) key.add("storage images without formats");
    if (request.stage == ShaderStage::Compute) key.add("levels by name");
    for (const auto& [name, value] : request.defines)
        key.add(name).add(value);
    for (const auto& folder : request.includeFolders)
        key.add(folder.string());
    if (request.language2018) key.add("2018");
    return key.add(request.code).text();
}

Result<Shader> finish(RawShader raw, const ShaderRequest& request, Compiler compiler) {
    const auto invalid = [&](const std::string& why) {
        return machineError(
            3003, fmt::format("{}: {} wrote SPIR-V for {} that is not valid: {}", request.file, compilerName(compiler), request.entry, why),
            compiler == Compiler::Glslang && !compilerAvailable(Compiler::Dxc)
                ? "glslang cannot compile it; DXC can, and is not here: ./bootstrap build fetches it, or set TEGUMENT_DXC"
                : "this is a fault of the compiler: try the other one (--compiler) or another spelling");
    };
    if (request.stage == ShaderStage::Compute && (raw.levelsRemoved || spirv::takesLevelsByDerivatives(raw.words)))
        return inputError(
            3001, {.file = request.file},
            fmt::format("{} reads textures at a level that follows from derivatives, which only pixel shaders have", request.entry),
            "SampleLevel and tex2Dlod name the level");
    if (request.stage == ShaderStage::Compute && !spirv::forgetStorageFormats(raw.words))
        return inputError(3006, {.file = request.file}, fmt::format("{} writes textures of several types", request.entry),
                          "declare every texture that compute shaders write as RWTexture2D<float4>");
    if (const std::string why = spirv::validate(raw.words); !why.empty()) return invalid(why);
    auto reflection = spirv::reflect(raw.words, request.stage, descriptorSet(request.stage), request.file);
    if (!reflection) return reflection.error();
    return Shader{.stage = request.stage,
                  .file = request.file,
                  .entry = request.entry,
                  .spirv = spirv::withoutReflectionDecorations(raw.words),
                  .reflection = std::move(*reflection),
                  .warnings = std::move(raw.warnings)};
}

Error missing(Compiler compiler) {
    return machineError(3002, whyCompilerMissing(compiler),
                        compiler == Compiler::Glslang ? "use --compiler dxc"
                                                      : "run ./bootstrap build, set TEGUMENT_DXC, or use --compiler glslang");
}

/// A container is whole words long; the cache of SPIR-V serves it too.
Result<Dxil> readBack(const Shader& stored) {
    const auto bytes = std::as_bytes(std::span(stored.spirv));
    Dxil dxil{.container = {reinterpret_cast<const char*>(bytes.data()), bytes.size()},
              .reflection = stored.reflection,
              .warnings = stored.warnings};
    auto inputs = readSignature(dxil.container, "ISG1");
    auto outputs = readSignature(dxil.container, "OSG1");
    if (!inputs || !outputs)
        return machineError(3003, fmt::format("{}: DXC wrote DXIL for {} that is cut short", stored.file, stored.entry),
                            "this is a fault of the compiler: write the code differently, and report it");
    dxil.inputs = std::move(*inputs);
    dxil.outputs = std::move(*outputs);
    dxil.reflection.inputs = variablesOf(dxil.inputs);
    dxil.reflection.outputs = variablesOf(dxil.outputs);
    return dxil;
}

} // namespace

bool compilerAvailable(Compiler compiler) {
    return compiler == Compiler::Glslang ? glslang_hlsl::optimises() : dxc::available();
}

std::string whyCompilerMissing(Compiler compiler) {
    if (compiler == Compiler::Glslang)
        return glslang_hlsl::optimises() ? "glslang cannot be started"
                                         : "this build has glslang without SPIRV-Tools' optimiser, which its HLSL needs";
    return fmt::format("the DXC library cannot be used: {}", dxc::whyNot());
}

std::string compilerName(Compiler compiler) {
    if (compiler == Compiler::Glslang) return glslang_hlsl::name();
    static const std::string kDxc = dxc::available() ? dxc::name() : "DXC";
    return kDxc;
}

Compiler defaultCompiler() {
    return compilerAvailable(Compiler::Dxc) ? Compiler::Dxc : Compiler::Glslang;
}

Result<Shader> compileShader(const ShaderRequest& request, Compiler compiler) {
    if (!compilerAvailable(compiler)) return missing(compiler);
    const std::string code = withLineDirective(request);
    ShaderRequest named = request;
    named.code = code;

    const std::string key = cacheKey(named, compiler == Compiler::Dxc ? dxcIdentity(dxc::Output::Spirv) : glslang_hlsl::identity());
    if (auto cached = loadCachedShader(key)) return std::move(*cached);
    IncludeReader includes(request.file, request.includeFolders);
    auto raw = compiler == Compiler::Dxc ? dxc::compile(named, dxc::Output::Spirv, includes) : glslang_hlsl::compile(named, includes);
    if (includes.unread()) return *includes.unread();
    if (!raw) return raw.error();
    auto shader = finish(std::move(*raw), request, compiler);
    if (shader) storeCachedShader(key, {*shader, includes.files()});
    return shader;
}

Result<Dxil> compileDxil(const ShaderRequest& request) {
    if (!compilerAvailable(Compiler::Dxc)) return missing(Compiler::Dxc);
    const std::string code = withLineDirective(request);
    ShaderRequest named = request;
    named.code = code;
    const std::string key = cacheKey(named, dxcIdentity(dxc::Output::Dxil));
    if (const auto cached = loadCachedShader(key)) return readBack(*cached);
    IncludeReader includes(request.file, request.includeFolders);
    auto raw = dxc::compile(named, dxc::Output::Dxil, includes);
    if (includes.unread()) return *includes.unread();
    if (!raw) return raw.error();
    const Shader shader{.stage = request.stage,
                        .file = request.file,
                        .entry = request.entry,
                        .spirv = std::move(raw->words),
                        .reflection = readBindings(raw->listing),
                        .warnings = std::move(raw->warnings)};
    auto dxil = readBack(shader);
    if (dxil) storeCachedShader(key, {shader, includes.files()});
    return dxil;
}

} // namespace tegument
