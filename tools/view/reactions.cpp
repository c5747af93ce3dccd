#include "tools/view/reactions.h"

#include <algorithm>
#include <cmath>

namespace tegument::view {

namespace {

constexpr double kMost = 0.95;

/// The least value that at least this share of the sorted values does not exceed.
double sharedBy(const std::vector<double>& sorted, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

} // namespace

std::vector<ReactionRow> reactionRows(const std::vector<Reaction>& reactions) {
    std::vector<ReactionRow> rows;
    for (const Reaction& reaction : reactions)
        if (std::ranges::find(rows, reaction.kind, &ReactionRow::kind) == rows.end()) rows.push_back({.kind = reaction.kind});
    for (ReactionRow& row : rows) {
        std::vector<double> times;
        for (const Reaction& reaction : reactions) {
            if (reaction.kind != row.kind) continue;
            times.push_back(reaction.milliseconds);
            row.unanswered = std::max(row.unanswered, reaction.unanswered);
        }
        std::ranges::sort(times);
        row.count = times.size();
        row.median = sharedBy(times, 0.5);
        row.p95 = sharedBy(times, kMost);
        row.most = times.back();
    }
    return rows;
}

} // namespace tegument::view
