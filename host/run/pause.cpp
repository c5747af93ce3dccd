#include "host/run/pause.h"

namespace tegument::run {

namespace {

constexpr int kGivenUp = 0; // no diagnostic has it

} // namespace

Error givenUp() {
    return inputError(kGivenUp, {}, "given up");
}

bool isGivenUp(const Error& error) {
    return error.diagnostics.size() == 1 && error.diagnostics.front().code == kGivenUp;
}

Result<void> pauseAfter(const RunOptions& options) {
    if (!options.pieces.goOn || options.pieces.goOn()) return {};
    return givenUp();
}

} // namespace tegument::run
