#pragma once
// A program that measures by hand stops at the first thing that goes wrong, and says what.

#include "host/support/result.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

namespace tegument::measure {

[[noreturn]] inline void stop(const Error& error) {
    fmt::print(stderr, "{}\n", format(error));
    std::exit(static_cast<int>(error.blame));
}

template <class T>
T need(Result<T> result) {
    if (!result) stop(result.error());
    return std::move(*result);
}

} // namespace tegument::measure
