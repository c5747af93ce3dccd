#pragma once
// DDS, the texture file of Direct3D: two-dimensional textures and cube maps, with mip levels, in the formats that the effects use.

#include "host/image/image.h"

#include <string_view>

namespace tegument {

enum class DdsFormat { Rgba8, Rgba8Srgb, R16F, Rg16F, Rgba16F, R32F, Rg32F, Rgba32F };
[[nodiscard]] int channelCount(DdsFormat format);
/// As DXGI calls it, without the prefix: "R16G16B16A16_FLOAT".
[[nodiscard]] std::string_view name(DdsFormat format);

/// `images[face * mips + mip]`, each with the channels of the format; faces in Direct3D's order +X -X +Y -Y +Z -Z. Values as stored: sRGB
/// ones are still encoded.
struct DdsTexture {
    DdsFormat format = DdsFormat::Rgba32F;
    int faces = 1; // 1 or 6
    int mips = 1;
    std::vector<Image> images;

    [[nodiscard]] bool isCube() const { return faces == 6; }
    [[nodiscard]] const Image& at(int face, int mip) const {
        return images[static_cast<std::size_t>(face) * static_cast<std::size_t>(mips) + static_cast<std::size_t>(mip)];
    }
};

/// Direct3D 9's loaders know the old header only; everything since 2007 reads both.
enum class DdsHeader { Dx10, Direct3D9 };

/// The first bytes are those of a DDS file.
[[nodiscard]] bool isDds(std::span<const std::byte> bytes);
/// Read are the formats above, their BGRA forms and Direct3D 9's names for them. Anything else, and every byte too few or too many, is one
/// TG52xx with its byte.
[[nodiscard]] Result<DdsTexture> decodeDds(std::span<const std::byte> bytes, const std::string& nameForMessages);
[[nodiscard]] Result<DdsTexture> loadDds(const std::filesystem::path& path);
/// There is a file, its header is one that loadDds reads, and all of its texels are there. In a cache anything else is made again.
[[nodiscard]] bool isWholeDds(const std::filesystem::path& path);

/// A texture of one face. Grey is spread to red, green and blue, a missing alpha is 1, surplus channels are left out. With `mips` the whole
/// chain, each level the mean of what it covers (Rgba8Srgb: of the light).
[[nodiscard]] DdsTexture makeDds(const Image& image, DdsFormat format, bool mips);
[[nodiscard]] std::string encodeDds(const DdsTexture& texture, DdsHeader header = DdsHeader::Dx10);
[[nodiscard]] Result<void> writeDds(const std::filesystem::path& path, const DdsTexture& texture, DdsHeader header = DdsHeader::Dx10);

} // namespace tegument
