#pragma once
// Lengths for messages.

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace tegument {

/// Three digits, or all before the point: 0.0123, 15.5, 1553, 4000000000. Nobody reads 4e+09 mm as four thousand kilometres.
[[nodiscard]] inline std::string lengthText(double mm) {
    constexpr double kDigits = 999.5; // from here on three digits round to four
    constexpr double kExact = 1e15;   // beyond, the digits of a double say nothing
    return std::abs(mm) >= kDigits && std::abs(mm) < kExact ? fmt::format("{:.0f}", mm) : fmt::format("{:.3g}", mm);
}

} // namespace tegument
