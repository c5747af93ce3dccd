#include "tools/cli/animation.h"

#include "host/support/text.h"

#include <algorithm>
#include <cmath>

namespace tegument::app {

namespace {

std::string endingOf(const std::filesystem::path& path) {
    return toLower(path.extension().string());
}

} // namespace

bool isAnimation(const std::filesystem::path& path) {
    return endingOf(path) == ".webp" || endingOf(path) == ".gif";
}

Result<std::unique_ptr<Animation>> makeAnimation(const std::filesystem::path& path, const AnimationFormat& format) {
    return endingOf(path) == ".gif" ? makeGif(format) : makeWebp(format);
}

std::vector<unsigned char> shownBytes(const Image& radiance) {
    const Image shown = displayed(radiance);
    std::vector<unsigned char> bytes;
    bytes.reserve(shown.pixels.size());
    for (const float value : shown.pixels)
        bytes.push_back(value > 0 ? static_cast<unsigned char>(std::lround(std::min(value, 1.0F) * 255)) : 0); // NaN is black
    return bytes;
}

} // namespace tegument::app
