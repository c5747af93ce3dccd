#pragma once
// How far results are from what they should be, and the argument lists to blame.

#include "tests/hlsl/evaluate.h"

#include <string>
#include <vector>

namespace tegument::test {

/// The largest error of one kind and where it was.
struct Worst {
    double error = 0;
    std::size_t list = 0;
    std::size_t component = 0;
};

struct Verdict {
    Worst absolute;
    Worst relative;                     // to the expected value
    Worst ulp;                          // of a 32-bit float at the expected value
    Worst allowed;                      // share of what the tolerance allows: above 1 is a failure
    std::vector<std::size_t> notFinite; // lists of finite arguments with a result that is not
    std::size_t compared = 0;
};

[[nodiscard]] Verdict judge(const FunctionCase& function, int setting, const Samples& samples, const Evaluated& evaluated);

/// "a0 = (0.1, 0.2, 0.3), a1 = 1e-07", to the last bit.
[[nodiscard]] std::string describe(const FunctionCase& function, std::span<const float> list);

} // namespace tegument::test
