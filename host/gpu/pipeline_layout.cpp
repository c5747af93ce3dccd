#include "host/gpu/pipeline_layout.h"

#include "host/gpu/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace tegument::gpu::detail {

namespace {

auto place(const Binding& binding) {
    return std::tuple(binding.set, binding.binding);
}

Result<void> checkBindings(const PipelineHandle& pipeline) {
    const auto twice = std::ranges::adjacent_find(pipeline.bindings, {}, place);
    if (twice != pipeline.bindings.end())
        return requestError(6022, fmt::format("pipeline '{}' declares {} twice", pipeline.name, describe(*twice)));
    const std::uint32_t limit = pipeline.device->limits.maxBoundDescriptorSets;
    if (!pipeline.bindings.empty() && pipeline.bindings.back().set >= limit)
        return requestError(6023, fmt::format("pipeline '{}' declares {}, and {} allows {} sets", pipeline.name,
                                              describe(pipeline.bindings.back()), pipeline.device->info.name, limit));
    return {};
}

vk::raii::DescriptorSetLayout makeSetLayout(const PipelineHandle& pipeline, std::uint32_t set, vk::ShaderStageFlags stages) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const Binding& binding : pipeline.bindings)
        if (binding.set == set)
            bindings.push_back({.binding = binding.binding,
                                .descriptorType = descriptorType(static_cast<std::size_t>(binding.kind)),
                                .descriptorCount = 1,
                                .stageFlags = stages});
    return pipeline.device->device.createDescriptorSetLayout(
        {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

} // namespace

std::string_view kindName(BindingKind kind) {
    switch (kind) {
    case BindingKind::UniformBuffer: return "uniform buffer";
    case BindingKind::Texture: return "texture";
    case BindingKind::Sampler: return "sampler";
    case BindingKind::StorageBuffer: return "storage buffer";
    case BindingKind::StorageTexture: return "storage texture";
    }
    return "";
}

std::string describe(const Binding& binding) {
    return fmt::format("set {} binding {} ({})", binding.set, binding.binding, kindName(binding.kind));
}

Result<void> makeLayout(PipelineHandle& pipeline, const std::vector<Binding>& bindings, vk::ShaderStageFlags stages) {
    pipeline.bindings = bindings;
    std::ranges::sort(pipeline.bindings, {}, place);
    if (auto fine = checkBindings(pipeline); !fine) return fine;
    pipeline.setCounts.resize(pipeline.bindings.empty() ? 0 : pipeline.bindings.back().set + 1);
    for (const Binding& binding : pipeline.bindings)
        ++pipeline.setCounts[binding.set][static_cast<std::size_t>(binding.kind)];
    std::vector<vk::DescriptorSetLayout> layouts;
    for (std::uint32_t set = 0; set < pipeline.setCounts.size(); ++set) {
        pipeline.setLayouts.push_back(makeSetLayout(pipeline, set, stages));
        layouts.push_back(*pipeline.setLayouts.back());
    }
    pipeline.layout = pipeline.device->device.createPipelineLayout(
        {.setLayoutCount = static_cast<std::uint32_t>(layouts.size()), .pSetLayouts = layouts.data()});
    return {};
}

vk::raii::ShaderModule makeModule(const DeviceState& device, std::span<const std::uint32_t> words) {
    return device.device.createShaderModule({.codeSize = words.size_bytes(), .pCode = words.data()});
}

} // namespace tegument::gpu::detail
