#pragma once
// A frame drawn piece by piece, so that whoever waits for it can stop it between two (RunOptions::pieces).
// Between two things that a frame needs made: may whoever waits be kept waiting? What was made is found by the next call.

#include "host/run/frame.h"
#include "host/run/run_options.h"
#include "host/support/result.h"

namespace tegument::run {

struct PiecesDrawn {
    std::vector<gpu::TimedSection> sections; // as of a frame in one, of what was drawn
    std::size_t begun = 0;                   // of the frame's items
    std::size_t done = 0;                    // wholly
    bool givenUp = false;
};

/// Without the nodes before it. Each draw is a piece, with the clears and copies in front of it, or each band of it; and the resolve. The
/// first piece is always drawn. Behind a band that took longer than 60 ms, those of the pass that are left are halved.
[[nodiscard]] Result<PiecesDrawn> drawInPieces(gpu::Device& device, const Frame& frame, std::size_t items, const DrawnInPieces& pieces);

/// Rows of a target of that height, in at most so many bands: each begins at a multiple of 64, which is how software devices tile, and
/// pixels whose derivatives are taken together stay together.
[[nodiscard]] std::vector<gpu::RowRange> bandsOf(std::uint32_t height, std::uint32_t bands);

/// No message, and nobody sees it: it says that RunOptions::pieces gave the frame up before it was drawn.
[[nodiscard]] Error givenUp();
[[nodiscard]] bool isGivenUp(const Error& error);

/// To be called once something was made. An error: givenUp().
[[nodiscard]] Result<void> pauseAfter(const RunOptions& options);

} // namespace tegument::run
