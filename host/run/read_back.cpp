#include "host/run/read_back.h"

#include "host/run/pixels.h"

#include <algorithm>

namespace tegument::run {

Result<Image> readBack(gpu::Device& device, gpu::Texture& texture, std::uint32_t mip, std::uint32_t face) {
    const auto bytes = device.readback(texture, mip, face);
    if (!bytes) return bytes.error();
    const gpu::TextureDesc& desc = texture.desc();
    return imageFrom(*bytes, static_cast<int>(std::max(desc.width >> mip, 1U)), static_cast<int>(std::max(desc.height >> mip, 1U)),
                     desc.format);
}

Result<Image> readBackRows(gpu::Device& device, gpu::Texture& texture, int rows) {
    const auto bytes = device.readback(texture);
    if (!bytes) return bytes.error();
    const gpu::TextureDesc& desc = texture.desc();
    const int height = static_cast<int>(desc.height);
    const int step = std::max(1, height / std::max(1, rows));
    const std::size_t row = bytes->size() / desc.height;
    std::vector<std::byte> some;
    int count = 0;
    for (int y = step / 2; y < height; y += step, ++count) {
        const auto begin = bytes->begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row);
        some.insert(some.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
    }
    return imageFrom(some, static_cast<int>(desc.width), count, desc.format);
}

Result<Image> readBackPart(gpu::Texture& texture, const gpu::TexelRect& part, std::uint32_t mip) {
    const auto bytes = gpu::readbackPart(texture, part, mip);
    if (!bytes) return bytes.error();
    return imageFrom(*bytes, static_cast<int>(part.width), static_cast<int>(part.height), texture.desc().format);
}

} // namespace tegument::run
