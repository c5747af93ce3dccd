#pragma once
// Text in pictures: capital and small letters, digits and a few signs in a grid of 5 x 9 dots, drawn as squares.

#include "host/image/image.h"

#include <string_view>

namespace tegument::app {

inline constexpr int kLetterWidth = 6; // dots, with the gap behind it
inline constexpr int kLetterHeight = 9;

/// Width in pixels.
[[nodiscard]] int textWidth(std::string_view text, int dot);

/// Draws black text on what is there, its upper left corner at (x, y), dots of `dot` pixels; what lies outside the image is left out. Other
/// characters than those known are drawn as a box.
void drawText(Image& image, int x, int y, std::string_view text, int dot);

} // namespace tegument::app
