#pragma once
// Pictures that follow each other in one file: animated WebP, by libwebp, or a film in MP4, by the program ffmpeg where it is installed.

#include "host/image/image.h"
#include "host/support/text.h"

#include <memory>
#include <string>

namespace tegument::app {

/// By the name's ending, .mp4, in small letters or capitals.
[[nodiscard]] inline bool isFilm(const std::filesystem::path& path) {
    return toLower(path.extension().string()) == ".mp4";
}
/// The same, or .webp.
[[nodiscard]] inline bool isAnimation(const std::filesystem::path& path) {
    return toLower(path.extension().string()) == ".webp" || isFilm(path);
}

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
    int milliseconds = 0; // that each picture is shown; in WebP the last is followed by the first, for ever
};

/// TG5205 where the encoder cannot be had.
[[nodiscard]] Result<std::unique_ptr<Animation>> makeAnimation(const AnimationFormat& format);
[[nodiscard]] Result<std::unique_ptr<Animation>> makeFilm(const AnimationFormat& format);

/// Red, green and blue of each pixel, as the PNG of a picture has them.
[[nodiscard]] std::string shownBytes(const Image& radiance);

} // namespace tegument::app
