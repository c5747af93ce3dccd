#pragma once
// What a frame uses up and gives back whole: uniform data and what is drawn once, descriptor sets, timestamps. Each grows as needed and
// keeps its memory.

#include "host/gpu/memory.h"

#include <vulkan/vulkan_raii.hpp>

#include <array>
#include <span>
#include <vector>

namespace tegument::gpu::detail {

/// Host-visible chunks filled from the front.
class BytesArena {
public:
    struct Slice {
        vk::Buffer buffer;
        vk::DeviceSize offset = 0;
    };
    void reset();
    [[nodiscard]] Slice push(const DeviceState& device, std::span<const std::byte> bytes);

private:
    std::vector<HostBuffer> chunks_;
    std::size_t chunk_ = 0;
    vk::DeviceSize offset_ = 0;
};

/// How many descriptors of each BindingKind, in its order.
using DescriptorCounts = std::array<std::uint32_t, 5>;
[[nodiscard]] vk::DescriptorType descriptorType(std::size_t kind);

/// Descriptor pools. The remaining room is counted here, so that no allocation is ever refused.
class DescriptorArena {
public:
    void reset();
    [[nodiscard]] vk::DescriptorSet allocate(const DeviceState& device, vk::DescriptorSetLayout layout, const DescriptorCounts& counts);

private:
    struct Pool {
        vk::raii::DescriptorPool pool{nullptr};
        DescriptorCounts capacity{};
        DescriptorCounts left{};
        std::uint32_t setsLeft = 0;
    };
    static Pool makePool(const DeviceState& device, const DescriptorCounts& atLeast);

    std::vector<Pool> pools_;
    std::size_t pool_ = 0;
};

/// Timestamp queries, in order of use.
class TimestampArena {
public:
    void reset() { used_ = 0; }
    /// Outside of rendering: a pool is reset on its first use in a frame.
    void write(const DeviceState& device, const vk::raii::CommandBuffer& commands);
    [[nodiscard]] std::size_t count() const { return used_; }
    /// Raw ticks of all timestamps written since reset; the frame must have ended.
    [[nodiscard]] std::vector<std::uint64_t> read() const;

private:
    std::vector<vk::raii::QueryPool> pools_;
    std::size_t used_ = 0;
};

} // namespace tegument::gpu::detail
