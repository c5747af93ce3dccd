#pragma once
// How a target is to be shown, found from what it holds: depths and texture coordinates as well as light.

#include "host/image/image.h"
#include "tools/view/canvas.h"

namespace tegument::view {

/// Light between 0 and about 1 is shown as a picture is. Anything else is spread so that the middle 98 % of the written texels (not all
/// zeros) fill black to white: all channels alike where they are of one kind, each on its own where their ranges differ by more than 16.
[[nodiscard]] Levels levelsOf(const Image& image);

/// `stops` brighter: twice the light each.
[[nodiscard]] Levels brightened(const Levels& levels, double stops);

} // namespace tegument::view
