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
};

/// Of one scene and size of maps: indices of the rows than which no other is both faster and nearer to the truth, fastest first.
[[nodiscard]] std::vector<std::size_t> paretoFront(const std::vector<Row>& rows);

/// The cheapest row within the error, or the most accurate within the time; the row's index.
[[nodiscard]] std::optional<std::size_t> pick(const std::vector<Row>& rows, const Limit& limit);

/// The command that draws this row's picture.
[[nodiscard]] std::string renderCommand(const Row& row);

} // namespace tegument::bench
