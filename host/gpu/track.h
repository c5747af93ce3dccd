#pragma once
// What must be waited for before a resource is used again: the whole of the barrier logic, apart from recording the barriers.
// Granularity: whole textures and whole buffers.

#include <vulkan/vulkan.hpp>

#include <optional>

namespace tegument::gpu::detail {

/// How a command uses a resource. Buffers leave the layout undefined.
struct Use {
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 reads;
    vk::AccessFlags2 writes;
    vk::ImageLayout layout = vk::ImageLayout::eUndefined;
};

/// The last write, and the reads that have already been made to wait for it.
struct Track {
    vk::ImageLayout layout = vk::ImageLayout::eUndefined;
    vk::PipelineStageFlags2 writeStages;
    vk::AccessFlags2 writeAccess;
    vk::PipelineStageFlags2 readStages;
    vk::AccessFlags2 readAccess;
};

/// First half of a barrier; the second is the use.
struct Dependency {
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 access;
    vk::ImageLayout layout = vk::ImageLayout::eUndefined;
};

/// Notes the use; returns the barrier it needs, if any.
[[nodiscard]] std::optional<Dependency> advance(Track& track, const Use& use);

inline constexpr Use kColorTarget{
    .stages = vk::PipelineStageFlagBits2::eColorAttachmentOutput,
    .reads = vk::AccessFlagBits2::eColorAttachmentRead,
    .writes = vk::AccessFlagBits2::eColorAttachmentWrite,
    .layout = vk::ImageLayout::eColorAttachmentOptimal,
};
inline constexpr Use kDepthTarget{
    .stages = vk::PipelineStageFlagBits2::eEarlyFragmentTests | vk::PipelineStageFlagBits2::eLateFragmentTests,
    .reads = vk::AccessFlagBits2::eDepthStencilAttachmentRead,
    .writes = vk::AccessFlagBits2::eDepthStencilAttachmentWrite,
    .layout = vk::ImageLayout::eDepthStencilAttachmentOptimal,
};
inline constexpr vk::PipelineStageFlags2 kDrawStages =
    vk::PipelineStageFlagBits2::eVertexShader | vk::PipelineStageFlagBits2::eFragmentShader;
inline constexpr Use kSampledByDraw{
    .stages = kDrawStages,
    .reads = vk::AccessFlagBits2::eShaderSampledRead,
    .layout = vk::ImageLayout::eShaderReadOnlyOptimal,
};
inline constexpr Use kSampledByDispatch{
    .stages = vk::PipelineStageFlagBits2::eComputeShader,
    .reads = vk::AccessFlagBits2::eShaderSampledRead,
    .layout = vk::ImageLayout::eShaderReadOnlyOptimal,
};
inline constexpr Use kStorageInDraw{.stages = kDrawStages, .reads = vk::AccessFlagBits2::eShaderStorageRead};
inline constexpr Use kStorageInDispatch{
    .stages = vk::PipelineStageFlagBits2::eComputeShader,
    .reads = vk::AccessFlagBits2::eShaderStorageRead,
    .writes = vk::AccessFlagBits2::eShaderStorageWrite,
};
inline constexpr Use kStoredByDispatch{
    .stages = vk::PipelineStageFlagBits2::eComputeShader,
    .reads = vk::AccessFlagBits2::eShaderStorageRead,
    .writes = vk::AccessFlagBits2::eShaderStorageWrite,
    .layout = vk::ImageLayout::eGeneral,
};
inline constexpr Use kVertexInput{.stages = vk::PipelineStageFlagBits2::eVertexAttributeInput,
                                  .reads = vk::AccessFlagBits2::eVertexAttributeRead};
inline constexpr Use kIndexInput{.stages = vk::PipelineStageFlagBits2::eIndexInput, .reads = vk::AccessFlagBits2::eIndexRead};
inline constexpr Use kCopySource{
    .stages = vk::PipelineStageFlagBits2::eAllTransfer,
    .reads = vk::AccessFlagBits2::eTransferRead,
    .layout = vk::ImageLayout::eTransferSrcOptimal,
};
inline constexpr Use kCopyTarget{
    .stages = vk::PipelineStageFlagBits2::eAllTransfer,
    .writes = vk::AccessFlagBits2::eTransferWrite,
    .layout = vk::ImageLayout::eTransferDstOptimal,
};

} // namespace tegument::gpu::detail
