#pragma once
// `render --turntable N`: the scene from all sides, while it turns once.

#include "host/gpu/gpu.h"
#include "host/run/session_frame.h"
#include "tools/cli/job_options.h"
#include "tools/cli/picture_files.h"

#include <functional>

namespace tegument::app {

struct Turntable {
    std::vector<std::filesystem::path> files;
    SessionFrame first; // of the pictures; its times are those of one
};

/// The file of a picture, counted from 1.
[[nodiscard]] std::filesystem::path numbered(const std::filesystem::path& output, int number);

/// `pictures` of them, the first as it stands: one animation, or a file for each, numbered from 001. Camera and light stay where they are
/// for the viewer. `say` hears how many are done.
[[nodiscard]] Result<Turntable> renderTurntable(gpu::Device& device, const Job& job, const PictureOptions& options,
                                                const std::filesystem::path& output, int pictures,
                                                const std::function<void(int done)>& say);

} // namespace tegument::app
