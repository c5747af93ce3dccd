#pragma once
// What a frame says of itself: passes, targets, metadata, warnings.

#include "host/run/frame.h"
#include "host/run/session_frame.h"

#include <span>

namespace tegument::run {

/// Without times.
[[nodiscard]] SessionFrame describe(std::span<const ObjectRun> objects, const Frame& frame, const gpu::DeviceInfo& device);

} // namespace tegument::run
