#include "host/spirv/backend.h"

#include "host/spirv/messages.h"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/build_info.h>

#include <array>
#include <memory>

namespace tegument::glslang_hlsl {

namespace {

class Includer : public glslang::TShader::Includer {
public:
    Includer(IncludeReader& reader, std::string mainFile) : reader_(reader), mainFile_(std::move(mainFile)) {}

    IncludeResult* includeLocal(const char* name, const char* includer, size_t depth) override {
        return result(reader_.openFrom(depth <= 1 ? mainFile_ : includer, name));
    }
    IncludeResult* includeSystem(const char* name, const char*, size_t) override { return result(reader_.open(name)); }
    void releaseInclude(IncludeResult*) override {}

private:
    IncludeResult* result(std::optional<IncludeReader::Found> found) {
        if (!found) return nullptr;
        const auto& text = *texts_.emplace_back(std::make_unique<std::string>(std::move(found->text)));
        return results_.emplace_back(std::make_unique<IncludeResult>(found->path, text.data(), text.size(), nullptr)).get();
    }

    IncludeReader& reader_;
    std::string mainFile_;
    std::vector<std::unique_ptr<std::string>> texts_;
    std::vector<std::unique_ptr<IncludeResult>> results_;
};

std::string preamble(const ShaderRequest& request) {
    std::string text = "#define FX_ENTRY 1\n";
    for (const auto& [name, value] : request.defines)
        text += fmt::format("#define {} {}\n", name, value);
    return text;
}

void configure(glslang::TShader& shader, const ShaderRequest& request, const std::string& defines) {
    shader.setPreamble(defines.c_str());
    shader.setEntryPoint(request.entry.c_str());
    shader.setSourceEntryPoint(request.entry.c_str());
    shader.setEnvInput(glslang::EShSourceHlsl, static_cast<EShLanguage>(stageNames(request.stage).model), glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    shader.setEnvTargetHlslFunctionality1(); // keeps the semantics in the SPIR-V
    shader.setAutoMapBindings(true);
    shader.setAutoMapLocations(true);
}

Result<RawShader> failure(const std::string& log, const ShaderRequest& request) {
    if (log.find("Entry point not found") != std::string::npos)
        return inputError(3001, {.file = request.file}, fmt::format("there is no function {} to start from", request.entry));
    Messages messages = readGlslangMessages(log, request.code, request.file);
    if (messages.errors.empty()) return inputError(3001, {.file = request.file}, fmt::format("glslang rejects {}: {}", request.entry, log));
    return Error{Blame::Input, shortened(std::move(messages.errors))};
}

} // namespace

bool optimises() {
    return ENABLE_OPT != 0;
}

std::string name() {
    return fmt::format("glslang {}.{}.{}", GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR, GLSLANG_VERSION_PATCH);
}

std::string identity() {
    return fmt::format("{} generator {}", name(), glslang::GetSpirvGeneratorVersion());
}

bool initialise() {
    static const bool kInitialised = glslang::InitializeProcess();
    return kInitialised;
}

Result<RawShader> compile(const ShaderRequest& request, IncludeReader& includes) {
    if (!initialise()) return machineError(3002, "glslang could not be initialised");

    glslang::TShader shader(static_cast<EShLanguage>(stageNames(request.stage).model));
    const std::array strings{request.code.data()};
    const std::array lengths{static_cast<int>(request.code.size())};
    const std::array names{request.file.c_str()};
    shader.setStringsWithLengthsAndNames(strings.data(), lengths.data(), names.data(), 1);
    const std::string defines = preamble(request);
    configure(shader, request, defines);

    Includer includer(includes, request.file);
    constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgReadHlsl);
    if (!shader.parse(GetDefaultResources(), 100, false, kMessages, includer)) return failure(shader.getInfoLog(), request);
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(kMessages) || !program.mapIO()) return failure(program.getInfoLog(), request);

    RawShader raw;
    glslang::SpvOptions options;
    options.disableOptimizer = false; // its HLSL output is legal for Vulkan, and free of dead code, only after spirv-opt's passes
    spv::SpvBuildLogger logger;
    glslang::GlslangToSpv(*program.getIntermediate(static_cast<EShLanguage>(stageNames(request.stage).model)), raw.words, &logger,
                          &options);
    raw.warnings = shortened(readGlslangMessages(shader.getInfoLog(), request.code, request.file).warnings);
    return raw;
}

} // namespace tegument::glslang_hlsl
