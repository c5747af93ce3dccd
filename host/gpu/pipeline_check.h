#pragma once
// What a graphics pipeline asks of the device beyond what every device has.

#include "host/gpu/device_state.h"

namespace tegument::gpu::detail {

/// Capabilities of the module that the device lacks: TG6024.
[[nodiscard]] Result<void> checkCapabilities(const DeviceState& device, std::span<const std::uint32_t> words, const std::string& pipeline);

/// Shaders, attachments and optional features: TG6020, TG6021, TG6024 to TG6026.
[[nodiscard]] Result<void> checkPipeline(const DeviceState& device, const PipelineDesc& desc);

} // namespace tegument::gpu::detail
