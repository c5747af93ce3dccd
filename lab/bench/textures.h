#pragma once
// Maps no finer than the picture's pixels.

#include "host/image/mips.h"
#include "lab/bench/scenes.h"
#include "lab/reference/bssrdf.h"

#include <vector>

namespace tegument::bench {

/// tegument::halved, of values that need not be rounded to 8 bits any more.
[[nodiscard]] Image halved(const Image& image, MeanOf mean);

/// Texels of a map of `size` texels a side that a pixel crosses: the third quartile over neighbouring pixels.
[[nodiscard]] double texelsPerPixel(const std::vector<reference::ShadedPoint>& points, int size);

/// Halves the scene's maps until a pixel crosses one texel at most, and has everybody read these: a sample in the middle of a pixel that
/// covers several bumps would tell nothing of their mean, which every technique takes from mip levels and a reference by samples does not.
void fitTextures(Scene& scene, const std::vector<reference::ShadedPoint>& points);

} // namespace tegument::bench
