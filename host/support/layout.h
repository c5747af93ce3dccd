#pragma once
// What a GPU has to be told of memory, as plain data that needs no GPU: formats of texels, bindings of shaders, attributes of vertices.

#include <cstdint>
#include <string_view>

namespace tegument {

enum class PixelFormat {
    R8,
    RG8,
    RGBA8,
    BGRA8,
    RGBA8Srgb,
    RGBA16,
    RGB10A2,
    R16F,
    RG16F,
    RGBA16F,
    R32F,
    RG32F,
    RGBA32F,
    D16,
    D24S8,
    D32F,
    D32FS8
};
[[nodiscard]] bool isDepth(PixelFormat format);
[[nodiscard]] bool hasStencil(PixelFormat format);
/// Of one pixel in memory. D32FS8 counts 8.
[[nodiscard]] std::uint32_t bytesPerPixel(PixelFormat format);
[[nodiscard]] std::string_view name(PixelFormat format);

enum class BindingKind { UniformBuffer, Texture, Sampler, StorageBuffer, StorageTexture };
struct Binding {
    std::uint32_t set = 0;
    std::uint32_t binding = 0;
    BindingKind kind = BindingKind::UniformBuffer;
};

/// One float attribute of the single vertex stream. `offset` in bytes.
struct VertexAttribute {
    std::uint32_t location = 0;
    std::uint32_t components = 4;
    std::uint32_t offset = 0;
};

} // namespace tegument
