#include "host/gpu/arenas.h"

#include "host/gpu/device_state.h"

#include <algorithm>
#include <cstring>

namespace tegument::gpu::detail {

namespace {

constexpr vk::DeviceSize kBytesChunk = 1u << 20; // a few thousand draws of a few hundred bytes
constexpr vk::BufferUsageFlags kBytesUsage =
    vk::BufferUsageFlagBits::eUniformBuffer | vk::BufferUsageFlagBits::eVertexBuffer | vk::BufferUsageFlagBits::eIndexBuffer;
constexpr vk::DeviceSize kVertexAlignment = 16; // of the largest attribute
constexpr std::uint32_t kSetsPerPool = 256;
constexpr std::uint32_t kDescriptorsPerPool = 1024; // per kind: four per set, more than most passes bind
constexpr std::uint32_t kQueriesPerPool = 128;

constexpr vk::DeviceSize alignUp(vk::DeviceSize value, vk::DeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

} // namespace

void BytesArena::reset() {
    chunk_ = 0;
    offset_ = 0;
}

BytesArena::Slice BytesArena::push(const DeviceState& device, std::span<const std::byte> bytes) {
    offset_ = alignUp(offset_, std::max(device.limits.minUniformBufferOffsetAlignment, kVertexAlignment));
    while (chunk_ < chunks_.size() && offset_ + bytes.size() > chunks_[chunk_].size) {
        ++chunk_;
        offset_ = 0;
    }
    if (chunk_ == chunks_.size())
        chunks_.push_back(makeHostBuffer(device, std::max<vk::DeviceSize>(kBytesChunk, bytes.size()), kBytesUsage, HostAccess::Write));
    HostBuffer& chunk = chunks_[chunk_];
    std::memcpy(chunk.data + offset_, bytes.data(), bytes.size());
    const Slice slice{*chunk.buffer, offset_};
    offset_ += bytes.size();
    return slice;
}

vk::DescriptorType descriptorType(std::size_t kind) {
    constexpr std::array kTypes = {vk::DescriptorType::eUniformBuffer, vk::DescriptorType::eSampledImage, vk::DescriptorType::eSampler,
                                   vk::DescriptorType::eStorageBuffer, vk::DescriptorType::eStorageImage};
    return kTypes.at(kind);
}

void DescriptorArena::reset() {
    for (Pool& pool : pools_) {
        pool.pool.reset();
        pool.left = pool.capacity;
        pool.setsLeft = kSetsPerPool;
    }
    pool_ = 0;
}

DescriptorArena::Pool DescriptorArena::makePool(const DeviceState& device, const DescriptorCounts& atLeast) {
    Pool pool;
    std::array<vk::DescriptorPoolSize, std::tuple_size_v<DescriptorCounts>> sizes;
    for (std::size_t kind = 0; kind < sizes.size(); ++kind) {
        pool.capacity[kind] = std::max(kDescriptorsPerPool, atLeast[kind]);
        sizes[kind] = {.type = descriptorType(kind), .descriptorCount = pool.capacity[kind]};
    }
    pool.left = pool.capacity;
    pool.setsLeft = kSetsPerPool;
    pool.pool = device.device.createDescriptorPool(
        {.maxSets = kSetsPerPool, .poolSizeCount = static_cast<std::uint32_t>(sizes.size()), .pPoolSizes = sizes.data()});
    return pool;
}

vk::DescriptorSet DescriptorArena::allocate(const DeviceState& device, vk::DescriptorSetLayout layout, const DescriptorCounts& counts) {
    const auto fits = [&counts](const Pool& pool) {
        return pool.setsLeft > 0 &&
               std::ranges::equal(counts, pool.left, [](std::uint32_t need, std::uint32_t left) { return need <= left; });
    };
    while (pool_ < pools_.size() && !fits(pools_[pool_]))
        ++pool_;
    if (pool_ == pools_.size()) pools_.push_back(makePool(device, counts));
    Pool& pool = pools_[pool_];
    for (std::size_t kind = 0; kind < counts.size(); ++kind)
        pool.left[kind] -= counts[kind];
    --pool.setsLeft;
    // The plain handle: sets go back with their pool, not one by one.
    const vk::DescriptorSetAllocateInfo info{.descriptorPool = *pool.pool, .descriptorSetCount = 1, .pSetLayouts = &layout};
    return (*device.device).allocateDescriptorSets(info, *device.device.getDispatcher()).front();
}

void TimestampArena::write(const DeviceState& device, const vk::raii::CommandBuffer& commands) {
    const std::size_t pool = used_ / kQueriesPerPool;
    const auto query = static_cast<std::uint32_t>(used_ % kQueriesPerPool);
    if (pool == pools_.size())
        pools_.push_back(device.device.createQueryPool({.queryType = vk::QueryType::eTimestamp, .queryCount = kQueriesPerPool}));
    if (query == 0) commands.resetQueryPool(*pools_[pool], 0, kQueriesPerPool);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pools_[pool], query);
    ++used_;
}

std::vector<std::uint64_t> TimestampArena::read() const {
    std::vector<std::uint64_t> ticks;
    for (std::size_t first = 0; first < used_; first += kQueriesPerPool) {
        const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(kQueriesPerPool, used_ - first));
        const auto [result, values] = pools_[first / kQueriesPerPool].getResults<std::uint64_t>(
            0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        ticks.insert(ticks.end(), values.begin(), values.end());
    }
    return ticks;
}

} // namespace tegument::gpu::detail
