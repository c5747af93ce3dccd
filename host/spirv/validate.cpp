#include "host/spirv/validate.h"

#include <spirv-tools/libspirv.hpp>

namespace tegument::spirv {

std::string validate(std::span<const std::uint32_t> words) {
    std::string messages;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* text) {
        if (!messages.empty()) messages += "; ";
        messages += text;
    });
    if (tools.Validate(words.data(), words.size())) return {};
    return messages.empty() ? "the module is not valid" : messages;
}

std::string validatorName() {
    return spvSoftwareVersionString();
}

} // namespace tegument::spirv
