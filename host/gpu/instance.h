#pragma once
// From nothing to a logical device with one queue.

#include "host/gpu/device_state.h"

#include "host/support/result.h"

namespace tegument::gpu::detail {

/// Opens the loader and creates the instance, with validation when asked for, and the surface of the window when there is one.
[[nodiscard]] Result<std::shared_ptr<DeviceState>> makeInstance(const DeviceOptions& options);

/// The physical device that `options` and TEGUMENT_DEVICE ask for, among those that can run this library.
[[nodiscard]] Result<void> choosePhysicalDevice(DeviceState& state, const DeviceOptions& options);

[[nodiscard]] bool hasExtension(const vk::raii::PhysicalDevice& device, std::string_view name);

/// The logical device, its queue and its command pool, with every optional feature that is present.
[[nodiscard]] Result<void> makeLogicalDevice(DeviceState& state);

} // namespace tegument::gpu::detail
