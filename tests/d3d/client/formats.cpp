#include "formats.h"

#include "com.h"

#include <cstring>

namespace client {

namespace {

constexpr TargetFormat kFormats[] = {
    {"R16F", D3DFMT_R16F, DXGI_FORMAT_R16_FLOAT, 1, Stored::Halves},
    {"G16R16F", D3DFMT_G16R16F, DXGI_FORMAT_R16G16_FLOAT, 2, Stored::Halves},
    {"A16B16G16R16F", D3DFMT_A16B16G16R16F, DXGI_FORMAT_R16G16B16A16_FLOAT, 4, Stored::Halves},
    {"A16B16G16R16", D3DFMT_A16B16G16R16, DXGI_FORMAT_R16G16B16A16_UNORM, 4, Stored::Shares},
    {"R32F", D3DFMT_R32F, DXGI_FORMAT_R32_FLOAT, 1, Stored::Floats},
    {"G32R32F", D3DFMT_G32R32F, DXGI_FORMAT_R32G32_FLOAT, 2, Stored::Floats},
    {"A32B32G32R32F", D3DFMT_A32B32G32R32F, DXGI_FORMAT_R32G32B32A32_FLOAT, 4, Stored::Floats},
};

// Of effects of other hosts; the application's is read back.
constexpr TargetFormat kForeign[] = {
    {"A8R8G8B8", D3DFMT_A8R8G8B8, DXGI_FORMAT_B8G8R8A8_UNORM, 4, Stored::Shares},
    {"A8B8G8R8", D3DFMT_A8R8G8B8, DXGI_FORMAT_R8G8B8A8_UNORM, 4, Stored::Shares},
    {"A2B10G10R10", D3DFMT_A2B10G10R10, DXGI_FORMAT_R10G10B10A2_UNORM, 4, Stored::Shares},
};

constexpr TargetFormat kDepth = {"D24S8", D3DFMT_D24S8, DXGI_FORMAT_D24_UNORM_S8_UINT, 1, Stored::Floats};
constexpr TargetFormat kReadableDepth = {"D32F", D3DFMT_D32F_LOCKABLE, DXGI_FORMAT_D32_FLOAT, 1, Stored::Floats};

} // namespace

const TargetFormat& colorFormat(const std::string& name) {
    for (const TargetFormat& format : kFormats)
        if (upper(name) == format.name) return format;
    for (const TargetFormat& format : kForeign)
        if (upper(name) == format.name) return format;
    fail("no target of format '" + name + "'");
}

const TargetFormat& targetFormat(const TargetShape& shape) {
    if (!shape.depth) return colorFormat(shape.format);
    return isReadableDepth(shape) ? kReadableDepth : kDepth;
}

bool isReadableDepth(const TargetShape& shape) {
    return shape.depth && upper(shape.format).rfind("D32F", 0) == 0;
}

TextureFormat textureFormat(TexelFormat format) {
    switch (format) {
    case TexelFormat::Rgba8: return {D3DFMT_A8R8G8B8, DXGI_FORMAT_R8G8B8A8_UNORM};
    case TexelFormat::Rgba8Srgb: return {D3DFMT_A8R8G8B8, DXGI_FORMAT_R8G8B8A8_UNORM_SRGB};
    case TexelFormat::Rgba16: return {D3DFMT_A16B16G16R16, DXGI_FORMAT_R16G16B16A16_UNORM};
    case TexelFormat::R16Float: return {D3DFMT_R16F, DXGI_FORMAT_R16_FLOAT};
    case TexelFormat::Rg16Float: return {D3DFMT_G16R16F, DXGI_FORMAT_R16G16_FLOAT};
    case TexelFormat::Rgba16Float: return {D3DFMT_A16B16G16R16F, DXGI_FORMAT_R16G16B16A16_FLOAT};
    case TexelFormat::R32Float: return {D3DFMT_R32F, DXGI_FORMAT_R32_FLOAT};
    case TexelFormat::Rg32Float: return {D3DFMT_G32R32F, DXGI_FORMAT_R32G32_FLOAT};
    case TexelFormat::Rgba32Float: return {D3DFMT_A32B32G32R32F, DXGI_FORMAT_R32G32B32A32_FLOAT};
    }
    fail("a texture has an unknown format");
}

Pixels readRows(const TargetShape& shape, const void* rows, unsigned pitch) {
    const TargetFormat& format = targetFormat(shape);
    Pixels pixels{shape.width, shape.height, format.channels, {}};
    appendRows(pixels, rows, pitch, format.stored);
    if (!shape.depth || isReadableDepth(shape)) return pixels;
    for (float& value : pixels.values) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        value = static_cast<float>(bits >> 8) / static_cast<float>(0xffffff);
    }
    return pixels;
}

} // namespace client
