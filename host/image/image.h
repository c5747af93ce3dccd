#pragma once
// Images in memory and on disk: EXR (linear float), PNG, JPEG; HDR, BMP, TGA (read only); DDS in dds.h.

#include "host/support/result.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tegument {

/// Row 0 is the top row. `pixels` holds width * height * channels floats. Values are as stored in the file: 8 and 16 bit files give 0..1
/// still encoded (sRGB or not is the reader's knowledge, see `srgbToLinear`), EXR gives its floats.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 4; // 1..4
    std::vector<float> pixels;
    int bitsPerChannel = 32; // of the file it came from: 8, 16 or 32
    std::map<std::string, std::string> metadata;

    [[nodiscard]] float& at(int x, int y, int channel) {
        return pixels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                          static_cast<std::size_t>(channels) +
                      static_cast<std::size_t>(channel)];
    }
    [[nodiscard]] float at(int x, int y, int channel) const { return const_cast<Image*>(this)->at(x, y, channel); }
};

/// Every number of every pixel is `value`.
[[nodiscard]] Image plainImage(int width, int height, int channels, float value = 0);

/// IEC 61966-2-1.
[[nodiscard]] float srgbToLinear(float encoded);
[[nodiscard]] float linearToSrgb(float linear);
/// The one tone map of this project (docs/conventions.md): linear radiance to 0..1 linear display light.
[[nodiscard]] float toneMap(float radiance);

/// PNG (8 and 16 bit), JPEG, EXR, HDR (Radiance's RGBE), DDS (its largest level), BMP, TGA, by content. Truncated or foreign files are one
/// clear TG52xx with the byte where it broke. At most 16384 x 16384.
[[nodiscard]] Result<Image> loadImage(const std::filesystem::path& path);
[[nodiscard]] Result<Image> decodeImage(std::span<const std::byte> bytes, const std::string& nameForMessages);

/// Half: values are rounded to the nearest, those beyond 65504 to infinity.
enum class ExrDepth { Float, Half };
/// EXR, ZIP, channels R G B A (or Y for one, R G for two), metadata as string attributes.
[[nodiscard]] Result<void> writeExr(const std::filesystem::path& path, const Image& image, ExrDepth depth = ExrDepth::Float);

/// How float values become 8-bit.
enum class PngEncoding {
    Display, // tone map, then sRGB; for radiance
    Srgb,    // sRGB curve only; for colour maps given in linear
    Raw      // clamp to 0..1, no curve; for normal maps and data
};
/// 8-bit PNG with metadata as tEXt chunks; alpha is written only for 2 and 4 channel images with Raw or Srgb.
[[nodiscard]] Result<void> writePng(const std::filesystem::path& path, const Image& image, PngEncoding encoding);
/// Values of 0..1 as they are, without alpha; for pages that show many pictures. Metadata as a comment.
[[nodiscard]] Result<void> writeJpeg(const std::filesystem::path& path, const Image& image);
/// Radiance as PngEncoding::Display has it, for writeJpeg: 0..1 still as floats, one channel or three, with the metadata.
[[nodiscard]] Image displayed(const Image& radiance);
/// The bytes that writePng writes.
[[nodiscard]] Result<std::string> encodePng(const Image& image, PngEncoding encoding);

} // namespace tegument
