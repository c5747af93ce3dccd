#pragma once
// One frame while it is recorded. Tracks that it changes are put back unless the frame is submitted.

#include "host/gpu/device_state.h"

#include <unordered_map>

namespace tegument::gpu::detail {

/// A clear that waits for its texture's next use: it becomes the load operation of a rendering scope if that use is as a target.
struct PendingClear {
    TextureState* texture = nullptr;
    std::optional<std::array<float, 4>> color;
    std::optional<float> depth;
    std::optional<std::uint32_t> stencil;
};

/// Attachments of the rendering scope that is open.
struct Scope {
    std::vector<TextureState*> colors;
    TextureState* depth = nullptr;
    bool operator==(const Scope&) const = default;
};

struct RecorderState {
    explicit RecorderState(DeviceState& deviceState);
    RecorderState(const RecorderState&) = delete;
    RecorderState& operator=(const RecorderState&) = delete;
    ~RecorderState();

    DeviceState& device;
    vk::raii::CommandBuffer commands;
    std::optional<Scope> scope;
    std::size_t scopesOpened = 0;
    std::vector<PendingClear> clears;
    std::vector<vk::ImageMemoryBarrier2> imageBarriers; // waiting for flushBarriers
    std::vector<vk::BufferMemoryBarrier2> bufferBarriers;
    std::unordered_map<Track*, Track> before; // of every resource used, as it was when the frame began
    std::vector<std::string> timers;
    bool timing = false;
    bool submitted = false;
    std::optional<Error> failure; // of a call that cannot report its own
};

/// TG6043 when the frame being recorded has used the resource: its state is then what it will be, not what it is.
[[nodiscard]] Result<void> checkIdle(const DeviceState& device, const Track& track, std::string_view what);

/// Queue the barrier, if one is needed.
void use(RecorderState& recorder, TextureState& texture, const Use& use);
void use(RecorderState& recorder, BufferState& buffer, const Use& use);
/// Ends the open scope if barriers are queued, then records them.
void flushBarriers(RecorderState& recorder);
void endScope(RecorderState& recorder);

/// A texture with the waiting clear as its content.
void flushClear(RecorderState& recorder, TextureState& texture);
void flushAllClears(RecorderState& recorder);

/// Opens a scope with these attachments, or keeps the open one when it has the same ones and nothing is to be cleared.
void openScope(RecorderState& recorder, const Scope& wanted);

/// Descriptor sets for one draw or dispatch: written and bound.
void bindResources(RecorderState& recorder, const PipelineHandle& pipeline, std::span<const BoundResource* const> resources);

} // namespace tegument::gpu::detail
