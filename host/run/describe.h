#pragma once
// What a frame says of itself: passes, targets, metadata, warnings.

#include "host/run/frame.h"
#include "host/run/session_frame.h"

#include <span>

namespace tegument::run {

/// Without times.
[[nodiscard]] SessionFrame describe(std::span<const ObjectRun> objects, const Frame& frame, const gpu::DeviceInfo& device);

/// One execution of a pass, before anything is allocated.
[[nodiscard]] SessionPass describe(const DrawStep& step, const Prepared& prepared, int object = 0);

} // namespace tegument::run
