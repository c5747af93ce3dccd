#pragma once
// What graphics and compute pipelines have in common: bindings, set layouts, shader modules.

#include "host/gpu/device_state.h"

namespace tegument::gpu::detail {

/// "set 0 binding 3 (texture)".
[[nodiscard]] std::string describe(const Binding& binding);
[[nodiscard]] std::string_view kindName(BindingKind kind);

/// Fills bindings, setCounts, setLayouts and layout; sets that no binding names get an empty layout. TG6022, TG6023.
[[nodiscard]] Result<void> makeLayout(PipelineHandle& pipeline, const std::vector<Binding>& bindings, vk::ShaderStageFlags stages);

[[nodiscard]] vk::raii::ShaderModule makeModule(const DeviceState& device, std::span<const std::uint32_t> words);

} // namespace tegument::gpu::detail
