#pragma once
// The file's mouth stands a little open; without teeth behind them the lips must meet.

#include "host/support/result.h"
#include "meshprep/human/bust.h"

namespace tegument {

struct LipGap {
    float before = 0; // mm, the widest place, corners left out
    float after = 0;  // negative: they overlap by so much
};

/// Moves upper and lower lip towards each other, each by half of the gap between them at its x (measured on the limit surface), fading out
/// over kReach along the skin. A bust without a mouth (a chart inside the head that crosses x = 0) stays as it is.
[[nodiscard]] Result<LipGap> closeLips(Bust& bust, int subdivisionLevels);

} // namespace tegument
