#pragma once
// What was drawn, as a file.

#include "host/image/image.h"

#include <filesystem>

namespace tegument::assets {

/// Whether a file of this ending is for looking: .png, .jpg, .jpeg. Others hold linear floats.
[[nodiscard]] bool isDisplayed(const std::filesystem::path& file);

/// Whether its ending is that of a picture: .exr and .dds, too.
[[nodiscard]] bool isPicture(const std::filesystem::path& file);

/// By the ending: .png and .jpg tone mapped in 8 bits, or as they are where `displayReferred` (effects of other hosts); .exr linear floats.
/// TG8016 another ending, TG5002 the file cannot be written.
[[nodiscard]] Result<void> writePicture(const std::filesystem::path& file, const Image& image, bool displayReferred = false);

} // namespace tegument::assets
