#pragma once
// The Vulkan objects behind the handles of gpu.h. Members are declared so that they are destroyed in the reverse order of need.

#include "host/gpu/arenas.h"
#include "host/gpu/gpu.h"
#include "host/gpu/track.h"

#include <vulkan/vulkan_raii.hpp>

#include <functional>
#include <mutex>

namespace tegument::gpu::detail {

/// What the validation layers said. Apart from DeviceState, because the messenger keeps its address from the instance's creation on.
struct MessageLog {
    std::mutex mutex;
    std::vector<std::string> messages;
};

/// Optional features, enabled where present.
struct Features {
    bool wireframe = false;
    bool depthClamp = false;
    bool dualSourceBlend = false;
    bool independentBlend = false;
    bool anisotropy = false;
    bool mirrorOnce = false;
    bool customBorderColor = false;
};

struct DeviceState {
    vk::raii::Context context;
    std::unique_ptr<MessageLog> log = std::make_unique<MessageLog>();
    vk::raii::Instance instance{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
    vk::raii::SurfaceKHR surface{nullptr}; // null: headless
    vk::raii::PhysicalDevice physical{nullptr};
    vk::raii::Device device{nullptr};
    vk::raii::Queue queue{nullptr};
    vk::raii::CommandPool commandPool{nullptr};
    std::vector<vk::raii::CommandBuffer> idleCommands; // have run and are reset
    std::uint32_t queueFamily = 0;
    std::uint32_t timestampBits = 0;

    vk::PhysicalDeviceLimits limits;
    std::uint64_t maxAllocationSize = 0;
    std::vector<std::uint32_t> lacking; // SPIR-V capabilities that want a feature which is not there
    Features features;
    Format packedDepthStencil = Format::D24S8; // what D24S8 really is here
    DeviceInfo info;
    std::uint64_t allocatedBytes = 0; // of textures and buffers

    BytesArena bytes;
    DescriptorArena descriptors;
    TimestampArena timestamps;
    RecorderState* recording = nullptr; // the frame inside Device::run, if any

    [[nodiscard]] Format realFormat(Format format) const { return format == Format::D24S8 ? packedDepthStencil : format; }
};

/// Each number once.
[[nodiscard]] std::uint64_t nextIdentity();

struct TextureState {
    std::shared_ptr<DeviceState> device;
    TextureDesc desc; // as allocated
    std::uint64_t allocatedBytes = 0;
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::Image image{nullptr};
    vk::raii::ImageView sampledView{nullptr}; // all mips; colour or depth; not of multisampled ones
    vk::raii::ImageView targetView{nullptr};  // mip 0, layer 0, all aspects; only of render targets
    Track track;
    std::uint64_t identity = nextIdentity();

    ~TextureState();
    [[nodiscard]] std::uint32_t layers() const { return desc.cube ? 6 : 1; }
};

struct BufferState {
    std::shared_ptr<DeviceState> device;
    BufferUsage usage = BufferUsage::Vertex;
    std::uint64_t bytes = 0;
    std::uint64_t allocatedBytes = 0;
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::Buffer buffer{nullptr};
    Track track;
    std::uint64_t identity = nextIdentity();

    ~BufferState();
};

struct SamplerHandle {
    std::shared_ptr<DeviceState> device;
    vk::raii::Sampler sampler{nullptr};
    std::uint64_t identity = nextIdentity();
};

struct PipelineHandle {
    std::shared_ptr<DeviceState> device;
    std::string name;
    bool compute = false;
    std::vector<Binding> bindings; // by set, then binding
    std::vector<DescriptorCounts> setCounts;
    std::uint32_t vertexStride = 0; // 0: no vertex input
    std::vector<Format> colorFormats;
    std::optional<Format> depthFormat;
    std::uint32_t samples = 1;
    std::vector<vk::raii::DescriptorSetLayout> setLayouts;
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
    std::uint64_t identity = nextIdentity();
};

/// Records into a command buffer, submits it and waits. Throws Vulkan's exceptions.
void submitAndWait(DeviceState& device, const std::function<void(const vk::raii::CommandBuffer&)>& record);
/// The same for commands already recorded.
void submitAndWait(DeviceState& device, const vk::raii::CommandBuffer& commands);
[[nodiscard]] vk::raii::CommandBuffer beginCommands(DeviceState& device);
/// What has run serves the next submission: the validation layer keeps some kilobytes of every command buffer that there ever was.
void keepCommands(DeviceState& device, vk::raii::CommandBuffer commands) noexcept;

/// One image barrier over all mips and layers, and the track's change. Does nothing when there is nothing to wait for.
void transition(const vk::raii::CommandBuffer& commands, TextureState& texture, const Use& use);
[[nodiscard]] vk::ImageMemoryBarrier2 imageBarrier(const TextureState& texture, const Dependency& dependency, const Use& use);
[[nodiscard]] vk::BufferMemoryBarrier2 bufferBarrier(const BufferState& buffer, const Dependency& dependency, const Use& use);
void recordBarriers(const vk::raii::CommandBuffer& commands, std::span<const vk::ImageMemoryBarrier2> images,
                    std::span<const vk::BufferMemoryBarrier2> buffers);
/// After a copy to host memory: a fence alone does not make what the device wrote visible to the host.
void recordHostBarrier(const vk::raii::CommandBuffer& commands);

} // namespace tegument::gpu::detail
