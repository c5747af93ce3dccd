#include "host/support/layout.h"

#include <array>

namespace tegument {

namespace {

struct FormatRow {
    std::string_view name;
    std::uint32_t bytes;
    bool depth;
    bool stencil;
};

/// In the order of the enumeration.
constexpr std::array kFormats = {
    FormatRow{"R8", 1, false, false},       FormatRow{"RG8", 2, false, false},       FormatRow{"RGBA8", 4, false, false},
    FormatRow{"BGRA8", 4, false, false},    FormatRow{"RGBA8Srgb", 4, false, false}, FormatRow{"RGBA16", 8, false, false},
    FormatRow{"RGB10A2", 4, false, false},  FormatRow{"R16F", 2, false, false},      FormatRow{"RG16F", 4, false, false},
    FormatRow{"RGBA16F", 8, false, false},  FormatRow{"R32F", 4, false, false},      FormatRow{"RG32F", 8, false, false},
    FormatRow{"RGBA32F", 16, false, false}, FormatRow{"D16", 2, true, false},        FormatRow{"D24S8", 4, true, true},
    FormatRow{"D32F", 4, true, false},      FormatRow{"D32FS8", 8, true, true},
};
static_assert(kFormats.size() == static_cast<std::size_t>(PixelFormat::D32FS8) + 1);

constexpr const FormatRow& row(PixelFormat format) {
    return kFormats[static_cast<std::size_t>(format)];
}

} // namespace

bool isDepth(PixelFormat format) {
    return row(format).depth;
}
bool hasStencil(PixelFormat format) {
    return row(format).stencil;
}
std::uint32_t bytesPerPixel(PixelFormat format) {
    return row(format).bytes;
}
std::string_view name(PixelFormat format) {
    return row(format).name;
}

} // namespace tegument
