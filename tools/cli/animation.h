#pragma once
// Pictures that follow each other in one file: animated WebP, by libwebp, and GIF, by giflib.

#include "host/image/image.h"

#include <memory>
#include <vector>

namespace tegument::app {

/// By the name's ending, .webp or .gif, in small letters or capitals.
[[nodiscard]] bool isAnimation(const std::filesystem::path& path);

class Animation {
public:
    Animation() = default;
    Animation(const Animation&) = delete;
    Animation& operator=(const Animation&) = delete;
    virtual ~Animation() = default;

    /// Radiance, of the animation's size; shown as in the PNG of a picture. TG5205.
    [[nodiscard]] virtual Result<void> add(const Image& radiance) = 0;
    /// Once, after all pictures. TG5205, and TG5002 where the file cannot be written.
    [[nodiscard]] virtual Result<void> write(const std::filesystem::path& path) = 0;
};

struct AnimationFormat {
    int width = 0;
    int height = 0;
    int milliseconds = 0; // that each picture is shown; the last is followed by the first, for ever. GIF counts in steps of 10
};

/// Of the kind that the path's ending names. TG5205 where the encoder cannot be had.
[[nodiscard]] Result<std::unique_ptr<Animation>> makeAnimation(const std::filesystem::path& path, const AnimationFormat& format);

// Inside: what the two encoders share, and each of them.

/// Red, green, blue of each pixel, as the PNG has them.
[[nodiscard]] std::vector<unsigned char> shownBytes(const Image& radiance);
[[nodiscard]] Result<std::unique_ptr<Animation>> makeWebp(const AnimationFormat& format);
[[nodiscard]] Result<std::unique_ptr<Animation>> makeGif(const AnimationFormat& format);

} // namespace tegument::app
