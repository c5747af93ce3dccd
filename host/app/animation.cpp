#include "host/app/animation.h"

#include "host/support/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include <webp/encode.h>
#include <webp/mux.h>

namespace tegument::app {

namespace {

constexpr float kQuality = 90; // strands and pores stay; a third of the bytes of 100

struct Encoder {
    WebPAnimEncoder* handle = nullptr;

    Encoder() = default;
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;
    ~Encoder() { WebPAnimEncoderDelete(handle); }
};

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

std::vector<unsigned char> bytesOf(const Image& radiance) {
    const Image shown = displayed(radiance);
    std::vector<unsigned char> bytes;
    bytes.reserve(shown.pixels.size());
    for (const float value : shown.pixels)
        bytes.push_back(value > 0 ? static_cast<unsigned char>(std::lround(std::min(value, 1.0F) * 255)) : 0); // NaN is black
    return bytes;
}

} // namespace

struct Animation::State {
    Encoder encoder;
    int width = 0;
    int height = 0;
    int milliseconds = 0;
    int end = 0; // of what was added
};

Animation::Animation(std::unique_ptr<State> state) : state_(std::move(state)) {}
Animation::Animation(Animation&&) noexcept = default;
Animation& Animation::operator=(Animation&&) noexcept = default;
Animation::~Animation() = default;

Result<Animation> Animation::create(int width, int height, int millisecondsEach) {
    WebPAnimEncoderOptions options;
    if (WebPAnimEncoderOptionsInit(&options) == 0) return cannotEncode("another version of libwebp is installed than was built with");
    auto state = std::make_unique<State>();
    state->encoder.handle = WebPAnimEncoderNew(width, height, &options);
    if (!state->encoder.handle) return cannotEncode("not enough memory, or a side beyond 16383 pixels");
    state->width = width;
    state->height = height;
    state->milliseconds = millisecondsEach;
    return Animation(std::move(state));
}

Result<void> Animation::add(const Image& radiance) {
    assert(radiance.width == state_->width && radiance.height == state_->height && radiance.channels >= 3);
    WebPConfig config;
    Frame frame;
    if (WebPConfigPreset(&config, WEBP_PRESET_PHOTO, kQuality) == 0 || WebPPictureInit(&frame.picture) == 0)
        return cannotEncode("another version of libwebp is installed than was built with");
    frame.picture.use_argb = 1;
    frame.picture.width = state_->width;
    frame.picture.height = state_->height;
    const std::vector<unsigned char> bytes = bytesOf(radiance);
    if (WebPPictureImportRGB(&frame.picture, bytes.data(), 3 * state_->width) == 0) return cannotEncode("not enough memory");
    WebPAnimEncoder* encoder = state_->encoder.handle;
    if (WebPAnimEncoderAdd(encoder, &frame.picture, state_->end, &config) == 0) return cannotEncode(WebPAnimEncoderGetError(encoder));
    state_->end += state_->milliseconds;
    return {};
}

Result<void> Animation::write(const std::filesystem::path& path) {
    WebPAnimEncoder* encoder = state_->encoder.handle;
    WebPData data;
    WebPDataInit(&data);
    const bool done = WebPAnimEncoderAdd(encoder, nullptr, state_->end, nullptr) != 0 && WebPAnimEncoderAssemble(encoder, &data) != 0;
    const Result<void> written = done ? writeFile(path, std::string(reinterpret_cast<const char*>(data.bytes), data.size))
                                      : Result<void>(cannotEncode(WebPAnimEncoderGetError(encoder)));
    WebPDataClear(&data);
    return written;
}

} // namespace tegument::app
