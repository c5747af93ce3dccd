// Descriptor sets of one draw or dispatch.

#include "host/gpu/recorder_state.h"

namespace tegument::gpu::detail {

namespace {

/// Storage that descriptor writes point into; reserved whole, so that nothing moves.
struct Writes {
    std::vector<vk::DescriptorBufferInfo> buffers;
    std::vector<vk::DescriptorImageInfo> images;
    std::vector<vk::WriteDescriptorSet> list;
};

vk::DescriptorBufferInfo uniformInfo(DeviceState& device, std::span<const std::byte> bytes) {
    const BytesArena::Slice slice = device.bytes.push(device, bytes);
    return {.buffer = slice.buffer, .offset = slice.offset, .range = bytes.size()};
}

void add(RecorderState& recorder, Writes& writes, vk::DescriptorSet set, const Binding& binding, const BoundResource& resource) {
    vk::WriteDescriptorSet write{.dstSet = set,
                                 .dstBinding = binding.binding,
                                 .descriptorCount = 1,
                                 .descriptorType = descriptorType(static_cast<std::size_t>(binding.kind))};
    switch (binding.kind) {
    case BindingKind::UniformBuffer:
        writes.buffers.push_back(uniformInfo(recorder.device, std::get<std::span<const std::byte>>(resource.resource)));
        write.pBufferInfo = &writes.buffers.back();
        break;
    case BindingKind::StorageBuffer:
        writes.buffers.push_back({.buffer = *std::get<Buffer*>(resource.resource)->state->buffer, .offset = 0, .range = VK_WHOLE_SIZE});
        write.pBufferInfo = &writes.buffers.back();
        break;
    case BindingKind::Texture:
        writes.images.push_back({.imageView = *std::get<Texture*>(resource.resource)->state->sampledView,
                                 .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal});
        write.pImageInfo = &writes.images.back();
        break;
    case BindingKind::Sampler:
        writes.images.push_back({.sampler = *std::get<const Sampler*>(resource.resource)->state->sampler});
        write.pImageInfo = &writes.images.back();
        break;
    case BindingKind::StorageTexture:
        writes.images.push_back({.imageView = *std::get<StoredTexture>(resource.resource).texture->state->targetView,
                                 .imageLayout = vk::ImageLayout::eGeneral});
        write.pImageInfo = &writes.images.back();
        break;
    }
    writes.list.push_back(write);
}

} // namespace

void bindResources(RecorderState& recorder, const PipelineHandle& pipeline, std::span<const BoundResource* const> resources) {
    const auto point = pipeline.compute ? vk::PipelineBindPoint::eCompute : vk::PipelineBindPoint::eGraphics;
    Writes writes;
    writes.buffers.reserve(resources.size());
    writes.images.reserve(resources.size());
    std::vector<std::pair<std::uint32_t, vk::DescriptorSet>> sets;
    std::size_t next = 0; // bindings and resources are in the order of their sets
    for (std::uint32_t set = 0; set < pipeline.setLayouts.size(); ++set) {
        if (next == resources.size() || pipeline.bindings[next].set != set) continue; // a gap: no shader reads this set
        const vk::DescriptorSet descriptors =
            recorder.device.descriptors.allocate(recorder.device, *pipeline.setLayouts[set], pipeline.setCounts[set]);
        for (; next < resources.size() && pipeline.bindings[next].set == set; ++next)
            add(recorder, writes, descriptors, pipeline.bindings[next], *resources[next]);
        sets.emplace_back(set, descriptors);
    }
    recorder.device.device.updateDescriptorSets(writes.list, nullptr);
    for (const auto& [set, descriptors] : sets) // only after the update: it would invalidate a set already bound
        recorder.commands.bindDescriptorSets(point, *pipeline.layout, set, descriptors, nullptr);
}

} // namespace tegument::gpu::detail
