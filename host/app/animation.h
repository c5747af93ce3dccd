#pragma once
// Pictures that follow each other in one file: animated WebP, by libwebp.

#include "host/image/image.h"

#include <memory>

namespace tegument::app {

/// The ending of such files.
inline constexpr const char* kAnimation = ".webp";

class Animation {
public:
    /// Each picture is shown for so long; the last is followed by the first, for ever. TG5205 where the encoder cannot be had.
    static Result<Animation> create(int width, int height, int millisecondsEach);
    Animation(Animation&&) noexcept;
    Animation& operator=(Animation&&) noexcept;
    ~Animation();

    /// Radiance, of the animation's size; shown as in the PNG of a picture. TG5205.
    [[nodiscard]] Result<void> add(const Image& radiance);
    /// TG5205, and TG5002 where the file cannot be written.
    [[nodiscard]] Result<void> write(const std::filesystem::path& path);

private:
    struct State;
    explicit Animation(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace tegument::app
