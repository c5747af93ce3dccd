#include "host/spirv/validate.h"

#include <spirv-tools/optimizer.hpp>

namespace tegument::spirv {

std::vector<std::uint32_t> withoutReflectionDecorations(std::span<const std::uint32_t> words) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    optimizer.RegisterPass(spvtools::CreateStripNonSemanticInfoPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<std::uint32_t> stripped;
    if (!optimizer.Run(words.data(), words.size(), &stripped, options)) return {};
    return stripped;
}

} // namespace tegument::spirv
