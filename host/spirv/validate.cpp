#include "host/spirv/validate.h"

#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

namespace tegument::spirv {

std::string validate(std::span<const std::uint32_t> words) {
    std::string messages;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* text) {
        if (!messages.empty()) messages += "; ";
        messages += text;
    });
    if (tools.Validate(words.data(), words.size())) return {};
    return messages.empty() ? "the module is not valid" : messages;
}

std::vector<std::uint32_t> withoutReflectionDecorations(std::span<const std::uint32_t> words) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    optimizer.RegisterPass(spvtools::CreateStripNonSemanticInfoPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<std::uint32_t> stripped;
    if (!optimizer.Run(words.data(), words.size(), &stripped, options)) return {};
    return stripped;
}

std::string validatorName() {
    return spvSoftwareVersionString();
}

} // namespace tegument::spirv
