#pragma once
// Inside this room: what a program of the user's, in double precision, says that a shader should return.

#include "tools/test/device.h"

namespace tegument::testing {

/// Of each case. `file`: Python, whose function of the reference's name takes a number or a tuple for each argument and returns one; or a
/// shared library with `extern "C" void NAME(const double* arguments, double* result)`. `arguments`: of the first one all cases, and so on.
/// TG8206, with what the program said.
[[nodiscard]] Result<std::vector<std::array<float, 4>>> evaluate(const std::filesystem::path& file, const Reference& reference,
                                                                 std::span<const Recorded> arguments, std::uint32_t cases);

} // namespace tegument::testing
