// decodeImage on any bytes: an image of the size that it says, or one error.
#include "host/image/image.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto image = tegument::decodeImage({reinterpret_cast<const std::byte*>(data), size}, "fuzz");
    if (!image) return image.error().diagnostics.size() == 1 ? 0 : (std::abort(), 0);
    const auto samples =
        static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height) * static_cast<std::size_t>(image->channels);
    if (image->pixels.size() != samples) std::abort();
    return 0;
}
