#pragma once
// What each optimisation of the seed is worth, one at a time: milliseconds and error with it and without.

#include "lab/bench/bench.h"

#include <optional>
#include <string>
#include <vector>

namespace tegument::bench {

/// One line. `change` is to the line that its group begins with.
struct AblationRow {
    std::string group;
    std::string what;
    double milliseconds = 0;
    double noise = 0;
    double change = 0;
    std::optional<double> relativeL2; // against brute force; none where the picture stays the same
};

/// On the options' first scene with their first size of maps. Setting `seed` for culling, as the seed prints it; `corrected` for the rest.
[[nodiscard]] Result<std::vector<AblationRow>> measureAblation(gpu::Device& device, const BenchOptions& options, const BenchTools& tools);

} // namespace tegument::bench
