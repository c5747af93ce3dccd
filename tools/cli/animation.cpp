#include "tools/cli/animation.h"

#include "host/support/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <string>

#include <webp/encode.h>
#include <webp/mux.h>

namespace tegument::app {

namespace {

constexpr float kQuality = 90; // strands and pores stay; a third of the bytes of 100

/// A picture as libwebp holds it.
struct Frame {
    WebPPicture picture{};

    Frame() = default;
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;
    ~Frame() { WebPPictureFree(&picture); }
};

Error cannotEncode(const char* why) {
    return machineError(5205, fmt::format("WebP cannot be encoded: {}", why && *why ? why : "libwebp gives no reason"));
}

class WebpAnimation final : public Animation {
public:
    WebpAnimation(WebPAnimEncoder* encoder, const AnimationFormat& format) : encoder_(encoder), format_(format) {}
    ~WebpAnimation() override { WebPAnimEncoderDelete(encoder_); }
    Result<void> add(const Image& radiance) override;
    Result<void> write(const std::filesystem::path& path) override;

private:
    WebPAnimEncoder* encoder_;
    AnimationFormat format_;
    int end_ = 0; // milliseconds of what was added
};

Result<void> WebpAnimation::add(const Image& radiance) {
    assert(radiance.width == format_.width && radiance.height == format_.height && radiance.channels >= 3);
    WebPConfig config;
    Frame frame;
    if (WebPConfigPreset(&config, WEBP_PRESET_PHOTO, kQuality) == 0 || WebPPictureInit(&frame.picture) == 0)
        return cannotEncode("another version of libwebp is installed than was built with");
    frame.picture.use_argb = 1;
    frame.picture.width = format_.width;
    frame.picture.height = format_.height;
    const std::string bytes = shownBytes(radiance);
    if (WebPPictureImportRGB(&frame.picture, reinterpret_cast<const std::uint8_t*>(bytes.data()), 3 * format_.width) == 0)
        return cannotEncode("not enough memory");
    if (WebPAnimEncoderAdd(encoder_, &frame.picture, end_, &config) == 0) return cannotEncode(WebPAnimEncoderGetError(encoder_));
    end_ += format_.milliseconds;
    return {};
}

Result<void> WebpAnimation::write(const std::filesystem::path& path) {
    WebPData data;
    WebPDataInit(&data);
    const bool done = WebPAnimEncoderAdd(encoder_, nullptr, end_, nullptr) != 0 && WebPAnimEncoderAssemble(encoder_, &data) != 0;
    const Result<void> written = done ? writeFile(path, std::string(reinterpret_cast<const char*>(data.bytes), data.size))
                                      : Result<void>(cannotEncode(WebPAnimEncoderGetError(encoder_)));
    WebPDataClear(&data);
    return written;
}

} // namespace

std::string shownBytes(const Image& radiance) {
    const Image shown = displayed(radiance);
    std::string bytes;
    bytes.reserve(shown.pixels.size());
    for (const float value : shown.pixels)
        bytes.push_back(value > 0 ? static_cast<char>(std::lround(std::min(value, 1.0F) * 255)) : '\0'); // NaN is black
    return bytes;
}

Result<std::unique_ptr<Animation>> makeAnimation(const AnimationFormat& format) {
    WebPAnimEncoderOptions options;
    if (WebPAnimEncoderOptionsInit(&options) == 0) return cannotEncode("another version of libwebp is installed than was built with");
    WebPAnimEncoder* encoder = WebPAnimEncoderNew(format.width, format.height, &options);
    if (!encoder) return cannotEncode("not enough memory, or a side beyond 16383 pixels");
    return std::unique_ptr<Animation>(std::make_unique<WebpAnimation>(encoder, format));
}

} // namespace tegument::app
