#include "host/gpu/spirv.h"

#include "host/gpu/error.h"

#include <fmt/format.h>
#include <spirv-tools/libspirv.hpp>

#include <string_view>

namespace tegument::gpu::detail {

namespace {

constexpr spv_target_env kEnvironment = SPV_ENV_VULKAN_1_3;
constexpr std::uint16_t kOpEntryPoint = 15; // SPIR-V specification, 3.42.6 "Mode-Setting Instructions"

/// Empty when the module is valid.
std::string fault(std::span<const std::uint32_t> words) {
    std::string why = "it is not valid";
    spvtools::SpirvTools tools(kEnvironment);
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* text) { why = text; });
    return tools.Validate(words.data(), words.size()) ? std::string() : why;
}

/// Of a valid module: its strings end within their instructions.
bool hasEntryPoint(std::span<const std::uint32_t> words, ShaderStage stage, std::string_view name) {
    struct Search {
        ShaderStage stage;
        std::string_view name;
        bool found = false;
    } search{stage, name};
    const auto visit = [](void* into, const spv_parsed_instruction_t* instruction) {
        auto& wanted = *static_cast<Search*>(into);
        const std::uint32_t* w = instruction->words;
        wanted.found |= instruction->opcode == kOpEntryPoint && w[1] == static_cast<std::uint32_t>(wanted.stage) &&
                        wanted.name == reinterpret_cast<const char*>(w + 3);
        return SPV_SUCCESS;
    };
    const spvtools::Context context(kEnvironment);
    return spvBinaryParse(context.CContext(), &search, words.data(), words.size(), nullptr, visit, nullptr) == SPV_SUCCESS && search.found;
}

std::string_view stageName(ShaderStage stage) {
    switch (stage) {
    case ShaderStage::Vertex: return "vertex";
    case ShaderStage::Pixel: return "pixel";
    case ShaderStage::Compute: return "compute";
    }
    return "";
}

} // namespace

Result<void> checkShader(std::span<const std::uint32_t> words, const std::string& entry, ShaderStage stage, const std::string& pipeline) {
    if (const std::string why = fault(words); !why.empty())
        return requestError(6020, fmt::format("pipeline '{}': the {} shader is not a SPIR-V module: {}", pipeline, stageName(stage), why));
    if (!hasEntryPoint(words, stage, entry))
        return requestError(6021, fmt::format("pipeline '{}': the module has no {} shader '{}'", pipeline, stageName(stage), entry));
    return {};
}

} // namespace tegument::gpu::detail
