#include "tools/report/against.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace tegument::report {

namespace {

constexpr std::size_t kNamed = 6; // figures of one run alone that are named, before "and N more"

std::string keyOf(const Figure& figure) {
    return figure.subject + ": " + figure.name;
}

/// 1 worse, -1 better, 0 neither.
int direction(const Figure& before, const Figure& after, double threshold) {
    if (std::isfinite(before.value) != std::isfinite(after.value)) return std::isfinite(before.value) ? 1 : -1;
    if (!std::isfinite(after.value)) return 0;
    const double difference = after.value - before.value;
    if (std::abs(difference) <= std::max(threshold * std::abs(before.value), before.noise + after.noise)) return 0;
    return difference > 0 ? 1 : -1;
}

Change changeOf(const Figure& before, const Figure& after) {
    const double share = before.value != 0 ? after.value / before.value - 1 : after.value > 0 ? INFINITY : 0;
    return {.subject = after.subject, .name = after.name, .before = before.value, .after = after.value, .share = share};
}

Json numberOrNull(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

void addRows(Json& rows, const std::vector<Change>& changes, const char* verdict) {
    for (const Change& change : changes)
        rows.push_back({verdict, change.subject, change.name, numberOrNull(change.before), numberOrNull(change.after),
                        numberOrNull(100 * change.share)});
}

std::string namedOnly(const std::vector<std::string>& keys, const std::string& which) {
    if (keys.empty()) return {};
    const std::size_t shown = std::min(keys.size(), kNamed);
    std::string text = fmt::format(" Only in {}: {}", which, fmt::join(std::span(keys).first(shown), "; "));
    if (shown < keys.size()) text += fmt::format(" and {} more", keys.size() - shown);
    return text + ".";
}

std::string sumOf(const Changes& changes, double threshold) {
    return fmt::format("{} of {} figures are worse by more than {:g} %, {} are better by more than that", changes.worse.size(),
                       changes.compared, 100 * threshold, changes.better.size());
}

} // namespace

Changes compareRuns(const std::vector<Figure>& before, const std::vector<Figure>& after, double threshold) {
    std::map<std::string, const Figure*> old;
    for (const Figure& figure : before)
        old[keyOf(figure)] = &figure;
    Changes changes;
    for (const Figure& figure : after) {
        const auto found = old.find(keyOf(figure));
        if (found == old.end()) {
            changes.onlyAfter.push_back(keyOf(figure));
            continue;
        }
        ++changes.compared;
        const int which = direction(*found->second, figure, threshold);
        if (which != 0) (which > 0 ? changes.worse : changes.better).push_back(changeOf(*found->second, figure));
        old.erase(found);
    }
    for (const auto& [key, figure] : old)
        changes.onlyBefore.push_back(key);
    const auto strain = [](const Change& change) { return std::isfinite(change.after) ? change.share : INFINITY; };
    std::ranges::stable_sort(changes.worse, std::ranges::greater(), strain);
    std::ranges::stable_sort(changes.better, std::ranges::less(), strain);
    return changes;
}

Json changesSection(const Changes& changes, const std::string& file, double threshold) {
    Json rows = Json::array();
    addRows(rows, changes.worse, "worse");
    addRows(rows, changes.better, "better");
    const std::string note =
        fmt::format("{}, beside {}. A difference below the noise of both runs counts as none.{}{}", sumOf(changes, threshold), file,
                    namedOnly(changes.onlyBefore, "the earlier run"), namedOnly(changes.onlyAfter, "this run"));
    return table("What changed", note,
                 {{"", "verdict", {}},
                  {"what", "text", {}},
                  {"figure", "text", {}},
                  {"before", "number", {}},
                  {"now", "number", {}},
                  {"change, %", "number", "after / before - 1"}},
                 std::move(rows));
}

std::string changesText(const Changes& changes, const std::string& file, double threshold) {
    std::string text;
    for (const Change& change : changes.worse)
        text += fmt::format("worse: {}: {} {:.4g}, was {:.4g} ({:+.1f} %)\n", change.subject, change.name, change.after, change.before,
                            100 * change.share);
    return text + fmt::format("{}, beside {}\n", sumOf(changes, threshold), file);
}

} // namespace tegument::report
