#include "host/run/read_back.h"

#include "host/run/pixels.h"

namespace tegument::run {

Result<Image> readBack(gpu::Device& device, gpu::Texture& texture) {
    const auto bytes = device.readback(texture);
    if (!bytes) return bytes.error();
    const gpu::TextureDesc& desc = texture.desc();
    return imageFrom(*bytes, static_cast<int>(desc.width), static_cast<int>(desc.height), desc.format);
}

} // namespace tegument::run
