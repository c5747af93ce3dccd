#pragma once
// Pictures of 256 colours, for GIF.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tegument::app {

using Rgb = std::array<std::uint8_t, 3>;

inline constexpr std::size_t kPaletteSize = 256;

/// The colours that stand nearest to a picture's: its colours are parted where they vary most, again and again, and each part gives its
/// mean (Wan, Wong and Prusinkiewicz 1990). At most 256, fewer where the picture has fewer; at least one. `rgb`: three bytes a pixel.
[[nodiscard]] std::vector<Rgb> paletteOf(std::span<const std::uint8_t> rgb);

/// Each pixel's colour as its number in the palette. What a pixel loses goes to its neighbours (Floyd and Steinberg 1976), lines from left
/// and from right in turn, so that smooth shades stay smooth on the mean.
[[nodiscard]] std::vector<std::uint8_t> dithered(std::span<const std::uint8_t> rgb, std::size_t width, std::span<const Rgb> palette);

} // namespace tegument::app
