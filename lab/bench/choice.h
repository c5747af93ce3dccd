#pragma once
// Which technique to take.

#include "lab/bench/bench.h"

#include <optional>
#include <string>
#include <vector>

namespace tegument::bench {

/// One of both, or none.
struct Limit {
    std::optional<double> error;        // relative L2
    std::optional<double> milliseconds; // median
    bool withoutDiffusion = false;      // techniques that claim no diffusion may be chosen, too
};

struct Choice {
    std::size_t row = 0;
    std::vector<std::size_t> ties; // other rows that the spread of the times does not tell apart from it
};

/// The cheapest row within the error, or the most accurate within the time; of those that tie, the most accurate. Indices of rows.
[[nodiscard]] std::optional<Choice> pick(const std::vector<Row>& rows, const Limit& limit);

/// The row's error over that of no diffusion on the same scene with the same maps, where that was measured: 0 the truth, 1 no gain.
[[nodiscard]] std::optional<double> shareOfNoDiffusion(const std::vector<Row>& rows, std::size_t row);

/// The command that draws this row's picture.
[[nodiscard]] std::string renderCommand(const Row& row);

} // namespace tegument::bench
