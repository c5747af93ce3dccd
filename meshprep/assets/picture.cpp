#include "meshprep/assets/picture.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::assets {

namespace {

/// Three channels from 0 to 1: the alpha of effects of other hosts is not meant for looking through.
Image opaque(const Image& image) {
    if (image.channels < 3) return image;
    Image result{.width = image.width, .height = image.height, .channels = 3};
    result.metadata = image.metadata;
    for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels))
        for (std::size_t c = 0; c < 3; ++c)
            result.pixels.push_back(std::isfinite(image.pixels[i + c]) ? std::clamp(image.pixels[i + c], 0.0F, 1.0F) : 0.0F);
    return result;
}

} // namespace

bool isDisplayed(const std::filesystem::path& file) {
    const std::string ending = toLower(file.extension().string());
    return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

bool isPicture(const std::filesystem::path& file) {
    const std::string ending = toLower(file.extension().string());
    return isDisplayed(file) || ending == ".exr" || ending == ".dds";
}

Result<void> writePicture(const std::filesystem::path& file, const Image& image, bool displayReferred) {
    const std::string ending = toLower(file.extension().string());
    if (ending == ".exr") return writeExr(file, image);
    if (!isDisplayed(file)) return usageError(8016, fmt::format("{} is none of .png, .jpg and .exr", file.string()));
    if (displayReferred) return ending == ".png" ? writePng(file, opaque(image), PngEncoding::Raw) : writeJpeg(file, opaque(image));
    return ending == ".png" ? writePng(file, image, PngEncoding::Display) : writeJpeg(file, displayed(image));
}

} // namespace tegument::assets
