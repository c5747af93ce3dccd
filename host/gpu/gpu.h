#pragma once
// A thin Vulkan 1.3 layer: a device, headless or with a window, textures, pipelines, and a recorder that tracks layouts and barriers
// itself. It knows nothing of effects or scenes. No Vulkan type and no exception crosses this header.

#include "host/support/layout.h"
#include "host/support/result.h"
#include "host/support/state.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace tegument::gpu {

using Format = PixelFormat;
using tegument::Binding;
using tegument::BindingKind;
using tegument::bytesPerPixel;
using tegument::hasStencil;
using tegument::isDepth;
using tegument::name;
using tegument::VertexAttribute;

/// What a window library gives, without its types. The surface belongs to the device, which must be gone before the window is.
struct WindowSurface {
    std::vector<std::string> instanceExtensions;
    /// A VkInstance in, a VkSurfaceKHR out.
    std::function<Result<std::uint64_t>(void* instance)> create;
};

struct DeviceOptions {
    bool validation = false; // Khronos validation with synchronization validation; a missing layer is an error
    /// Part of a device's name, ignoring case; "H200#2": the second of that name. Empty: $TEGUMENT_DEVICE, else discrete, integrated,
    /// virtual, CPU.
    std::string prefer;
    const WindowSurface* window = nullptr; // null: headless; else a device that can draw to it (host/gpu/present.h)
};

struct DeviceInfo {
    std::string name;   // "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver; // "llvmpipe Mesa 22.3.6"
    std::string apiVersion;
    bool cpu = false;        // a software device: its times are good as ratios only
    bool timestamps = false; // else every TimedSection reports 0 ms
};

namespace detail {
struct DeviceState;
struct TextureState;
struct BufferState;
struct SamplerHandle;
struct PipelineHandle;
struct RecorderState;
} // namespace detail

struct TextureDesc {
    std::string name;
    Format format = Format::RGBA8;
    std::uint32_t width = 1;
    std::uint32_t height = 1;
    std::uint32_t mips = 1;    // 0: full chain
    bool cube = false;         // six layers, in Direct3D's order +X -X +Y -Y +Z -Z
    bool renderTarget = false; // not with cube
    std::uint32_t samples = 1; // above 1: a render target of one mip that is cleared, drawn to and resolved, and nothing else
    bool storage = false;      // a colour render target of one sample that dispatches write, too
};

class Texture {
public:
    Texture();
    Texture(Texture&&) noexcept;
    Texture& operator=(Texture&&) noexcept;
    ~Texture();
    [[nodiscard]] const TextureDesc& desc() const; // format and mips as really allocated
    [[nodiscard]] std::uint64_t bytes() const;
    /// Another handle of the same texture, which lives until the last one goes.
    [[nodiscard]] Texture shared() const;
    [[nodiscard]] bool isShared() const { return state.use_count() > 1; }
    std::shared_ptr<detail::TextureState> state;
};

enum class BufferUsage { Vertex, Index, Storage }; // storage: read by draws, read and written by dispatches

class Buffer {
public:
    Buffer();
    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;
    ~Buffer();
    [[nodiscard]] std::uint64_t bytes() const;
    std::unique_ptr<detail::BufferState> state;
};

class Sampler {
public:
    Sampler();
    Sampler(Sampler&&) noexcept;
    Sampler& operator=(Sampler&&) noexcept;
    ~Sampler();
    std::unique_ptr<detail::SamplerHandle> state;
};

class Pipeline {
public:
    Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;
    ~Pipeline();
    std::unique_ptr<detail::PipelineHandle> state;
};

/// A number that no other texture, buffer, sampler or pipeline had, or will have, in this process.
template <class Handle>
[[nodiscard]] std::uint64_t identityOf(const Handle& handle);

enum class Topology { TriangleList, TriangleStrip };

struct ShaderCode {
    std::span<const std::uint32_t> spirv; // empty: no such stage
    std::string entry;
};

struct PipelineDesc {
    std::string name; // for messages
    ShaderCode vertex;
    ShaderCode pixel;
    std::vector<Binding> bindings; // union of both stages
    std::vector<VertexAttribute> attributes;
    std::uint32_t vertexStride = 0;
    Topology topology = Topology::TriangleList;
    std::vector<Format> colorFormats;
    std::optional<Format> depthFormat;
    std::uint32_t samples = 1; // of every target; the pixel shader runs once for those of one pixel that a triangle covers
    /// depthBias counts smallest steps of the depth format, as in Direct3D 10 and 11. scissorTest passes within Draw::rows.
    PipelineState state;
};

struct ComputePipelineDesc {
    std::string name;
    ShaderCode shader;
    std::vector<Binding> bindings;
};

/// Mip 0 of a texture that a dispatch reads and writes texel by texel. Its shader names no format.
struct StoredTexture {
    Texture* texture = nullptr;
};

/// What a binding gets. Uniform bytes are copied when the draw is recorded.
struct BoundResource {
    std::uint32_t set = 0;
    std::uint32_t binding = 0;
    std::variant<std::span<const std::byte>, Texture*, const Sampler*, Buffer*, StoredTexture> resource;
};

struct Targets {
    std::vector<Texture*> colors; // mip 0; previous contents are kept (clear explicitly)
    Texture* depth = nullptr;
};

/// Of indices, or of vertices where a draw has no indices.
struct DrawRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t firstInstance = 0; // shaders count instances from it (SV_InstanceID)
    std::uint32_t instances = 0;     // 0: as many as the draw
};

/// Rows of the targets, from the top.
struct RowRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Clockwise or counter-clockwise as Direct3D sees it: the viewport is y-up like Direct3D's, depth 0..1.
struct Draw {
    const Pipeline* pipeline = nullptr;
    std::vector<BoundResource> resources; // every binding of the pipeline exactly once
    const Buffer* vertices = nullptr;
    const Buffer* indices = nullptr; // 32-bit; null: `count` vertices
    /// Of what is drawn once, instead of those two: copied when the draw is recorded.
    std::span<const std::byte> vertexBytes;
    std::span<const std::byte> indexBytes;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::vector<DrawRange> more; // drawn after that, in order
    std::uint32_t instances = 1;
    std::optional<RowRange> rows; // nothing is drawn outside of them; none: of all
};

/// Records one frame. Barriers and layouts are tracked here. A texture that is both a target and a bound resource of one draw is TG6xxx.
class Recorder {
public:
    explicit Recorder(detail::RecorderState& state) : state_(state) {}
    Result<void> clearColor(Texture& target, const std::array<float, 4>& rgba);
    Result<void> clearDepthStencil(Texture& target, std::optional<float> depth, std::optional<std::uint32_t> stencil);
    /// What has been asked to be cleared is cleared now; otherwise the first draw into it does that on the way.
    void clearNow();
    Result<void> draw(const Targets& targets, const Draw& draw);
    Result<void> dispatch(const Pipeline& pipeline, const std::vector<BoundResource>& resources, std::array<std::uint32_t, 3> groups);
    Result<void> generateMips(Texture& texture);
    /// All of `from`, its mip levels too, into a texture of the same size and format.
    Result<void> copy(Texture& from, Texture& to);
    /// Each pixel of `to` becomes the mean of its samples in `from`, which has more of them, one size and one colour format with it.
    Result<void> resolve(Texture& from, Texture& to);
    /// Named sections, not nested; repeated names are separate entries.
    void beginTimer(std::string name);
    void endTimer();

private:
    detail::RecorderState& state_;
};

struct TimedSection {
    std::string name;
    double milliseconds = 0;
};

/// Owns the Vulkan device, together with everything made from it: they may be destroyed in any order. One thread at a time.
class Device {
public:
    static Result<Device> create(const DeviceOptions& options = {});
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    [[nodiscard]] const DeviceInfo& info() const;

    /// Filled with zeros. D24S8 becomes the nearest supported depth format; everything else that the device lacks is an error naming the
    /// format.
    Result<Texture> createTexture(const TextureDesc& desc);
    /// `pixels`: tightly packed rows of one mip of one layer, row 0 first. Colour formats, and D32F: floats of 0 to 1.
    Result<void> upload(Texture& texture, std::span<const std::byte> pixels, std::uint32_t mip = 0, std::uint32_t layer = 0);
    /// Tightly packed rows. Of a depth format: the depth as one 32-bit float per pixel, whatever the format.
    Result<std::vector<std::byte>> readback(Texture& texture, std::uint32_t mip = 0, std::uint32_t layer = 0);
    Result<Buffer> createBuffer(BufferUsage usage, std::span<const std::byte> bytes);
    Result<std::vector<std::byte>> readback(Buffer& buffer);
    Result<Sampler> createSampler(const SamplerState& state);
    Result<Pipeline> createPipeline(const PipelineDesc& desc);
    Result<Pipeline> createPipeline(const ComputePipelineDesc& desc);

    /// Records, submits and waits. An error from `record` submits nothing. What is given to the recorder must live until `run` returns.
    /// While recording, textures and buffers may be created, but not uploaded to or read back once the frame has used them.
    Result<std::vector<TimedSection>> run(const std::function<Result<void>(Recorder&)>& record);

    /// Every message of the validation layers so far (empty when validation is off).
    [[nodiscard]] std::vector<std::string> validationMessages() const;
    /// Bytes of textures and buffers alive now.
    [[nodiscard]] std::uint64_t allocatedBytes() const;

private:
    friend class Presenter;
    explicit Device(std::shared_ptr<detail::DeviceState> state);
    std::shared_ptr<detail::DeviceState> state_;
};

} // namespace tegument::gpu
