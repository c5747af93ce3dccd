#pragma once
// What a frame fetches and moves, by count: the same for every device, unlike its time.

#include "lab/bench/measure.h"

#include <vector>

namespace tegument::bench {

/// Counted on the device by shaders that count (lab/bench/count.h), in one frame behind another. Not in it: clears, vertices, what
/// blending and depth tests read, textures that are made once, the pixels of passes without a pixel shader. TG8082: a shader that cannot
/// count.
[[nodiscard]] Result<std::vector<Traffic>> trafficOf(gpu::Device& device, const Contest& contest, const Contender& contender);

} // namespace tegument::bench
