#pragma once
// Two runs of one command, figure by figure: what got slower, larger or less accurate.

#include "tools/report/report.h"

#include <string>
#include <vector>

namespace tegument::report {

/// A measured figure of which less is better.
struct Figure {
    std::string subject; // "Separable7 corrected, sphere-10"
    std::string name;    // "ms"
    double value = 0;
    double noise = 0; // a difference below this is none
};

struct Change {
    std::string subject;
    std::string name;
    double before = 0;
    double after = 0;
    double share = 0; // after / before - 1; infinite where `before` is 0
};

struct Changes {
    std::vector<Change> worse; // the worst first
    std::vector<Change> better;
    std::size_t compared = 0;
    std::vector<std::string> onlyBefore; // "subject: name" of figures that one run alone has
    std::vector<std::string> onlyAfter;
};

/// Worse: greater than before by more than the share `threshold` of it and by more than both runs' noise together. Better: likewise less.
/// A figure that is no number any more is worse.
[[nodiscard]] Changes compareRuns(const std::vector<Figure>& before, const std::vector<Figure>& after, double threshold);

/// A table of both, and in its note the threshold and what could not be compared.
[[nodiscard]] Json changesSection(const Changes& changes, const std::string& file, double threshold);

/// For the terminal: one line for each figure that is worse, and the sum.
[[nodiscard]] std::string changesText(const Changes& changes, const std::string& file, double threshold);

} // namespace tegument::report
