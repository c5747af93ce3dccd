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

Result<Image> readBackPart(gpu::Texture& texture, const gpu::TexelRect& part, std::uint32_t mip) {
    const auto bytes = gpu::readbackPart(texture, part, mip);
    if (!bytes) return bytes.error();
    return imageFrom(*bytes, static_cast<int>(part.width), static_cast<int>(part.height), texture.desc().format);
}

} // namespace tegument::run
