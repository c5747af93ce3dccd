#include "tools/report/plane.h"

#include <glm/gtc/packing.hpp>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tegument::report {

namespace {

constexpr double kLargestHalf = 32768; // a power of two below the largest half, 65504
constexpr int kDeflateLevel = 6;       // zlib's own

/// A power of two that brings the largest value into the range of halves and keeps small ones from vanishing there: no value loses a bit.
double scaleOf(const Image& image) {
    double largest = 0;
    for (const float value : image.pixels)
        if (std::isfinite(value)) largest = std::max(largest, std::abs(static_cast<double>(value)));
    if (largest <= 0) return 1;
    return std::exp2(std::ceil(std::log2(largest / kLargestHalf)));
}

/// All values of one channel stand together: neighbours are alike there.
std::vector<std::uint16_t> halvesOf(const Image& image, double scale) {
    const auto channels = static_cast<std::size_t>(image.channels);
    std::vector<std::uint16_t> halves;
    halves.reserve(image.pixels.size());
    for (std::size_t channel = 0; channel < channels; ++channel)
        for (std::size_t i = channel; i < image.pixels.size(); i += channels)
            halves.push_back(glm::packHalf1x16(static_cast<float>(image.pixels[i] / scale)));
    return halves;
}

std::string bytesOf(const std::vector<std::uint16_t>& halves) {
    std::string bytes;
    bytes.reserve(2 * halves.size());
    for (const int shift : {8, 0}) {
        std::uint8_t before = 0;
        for (const std::uint16_t half : halves) {
            const auto byte = static_cast<std::uint8_t>(half >> shift);
            bytes += static_cast<char>(static_cast<std::uint8_t>(byte - before));
            before = byte;
        }
    }
    return bytes;
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string result(size, '\0');
    compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
              static_cast<uLong>(bytes.size()), kDeflateLevel); // it fails for want of room only, and has as much as it can need
    result.resize(size);
    return result;
}

std::string base64(const std::string& bytes) {
    constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    const auto at = [&](std::size_t i) { return i < bytes.size() ? static_cast<std::uint8_t>(bytes[i]) : 0U; };
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const unsigned three = at(i) << 16U | at(i + 1) << 8U | at(i + 2);
        for (const unsigned shift : {18U, 12U, 6U, 0U})
            text += kLetters[three >> shift & 63U];
    }
    for (std::size_t missing = (3 - bytes.size() % 3) % 3; missing > 0; --missing)
        text[text.size() - missing] = '=';
    return text;
}

} // namespace

Json plane(const Image& image) {
    const double scale = scaleOf(image);
    return {{"width", image.width},
            {"height", image.height},
            {"channels", image.channels},
            {"scale", scale},
            {"data", base64(deflated(bytesOf(halvesOf(image, scale))))}};
}

} // namespace tegument::report
