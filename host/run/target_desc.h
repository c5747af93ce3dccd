#pragma once
// Sizes and formats of the targets that an effect declares, from their annotations (docs/running.md, "Targets").

#include "host/effect/model.h"
#include "host/support/layout.h"
#include "host/support/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tegument::run {

/// Pixels of the picture; targets without a size of their own take it.
struct Extent {
    std::uint32_t width = 1;
    std::uint32_t height = 1;
    bool operator==(const Extent&) const = default;
};

inline constexpr std::uint32_t kMaxExtent = 16384;

struct TargetDesc {
    Extent extent;
    PixelFormat format = PixelFormat::RGBA8;
    std::uint32_t mips = 1; // 0: full chain
    bool ownSize = false;   // does not depend on the picture's size
    std::uint32_t samples = 1;
    bool stored = false; // compute shaders write it
};

/// A D3DFORMAT name in any of the spellings that host/effect accepts.
[[nodiscard]] std::optional<PixelFormat> formatFromD3D(std::string_view name);
/// The D3DFORMAT name of a format that a target can have.
[[nodiscard]] std::string_view d3dName(PixelFormat format);
/// Channels that carry data: 1 for depth.
[[nodiscard]] int channelCount(PixelFormat format);

/// TG4020 a format that cannot be a target, TG4021 impossible size, TG4022 colour format for a depth target or the other way round.
[[nodiscard]] Result<TargetDesc> describeTarget(const Parameter& parameter, Extent picture);

} // namespace tegument::run
