#pragma once
// Between two things that a frame needs made: may whoever waits be kept waiting? What was made is found by the next call.

#include "host/run/run_options.h"
#include "host/support/result.h"

namespace tegument::run {

/// No message, and nobody sees it: it says that RunOptions::pieces gave the frame up before it was drawn.
[[nodiscard]] Error givenUp();
[[nodiscard]] bool isGivenUp(const Error& error);

/// To be called once something was made. An error: givenUp().
[[nodiscard]] Result<void> pauseAfter(const RunOptions& options);

} // namespace tegument::run
