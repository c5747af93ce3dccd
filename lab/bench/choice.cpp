#include "lab/bench/choice.h"

#include "generated/setting_names.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tegument::bench {

namespace {

double milliseconds(const Row& row) {
    return row.drawn.milliseconds.median;
}

/// Whether a row's time is the fastest's but for what is no gain, or for their spread: the range of the middle half of the frames, which on
/// a busy machine counts up to a quarter of the time.
bool isAsFast(const Row& row, const Row& fastest) {
    constexpr double kNoGain = 0.05;
    constexpr double kMost = 0.25;
    const Spread& one = row.drawn.milliseconds;
    const Spread& other = fastest.drawn.milliseconds;
    const double spread = std::max({one.noise, other.noise, one.p75 - one.p25, other.p75 - other.p25});
    return one.median - other.median <= std::clamp(spread, kNoGain * other.median, kMost * other.median);
}

std::string define(const std::string& name, const std::string& value) {
    for (std::size_t i = 0; i < kSettingNames.size(); ++i)
        if (name == kSettingSwitch && value == std::to_string(i)) return std::string(" --setting ") + kSettingNames.at(i);
    return " -D " + shellWord(name + "=" + value);
}

} // namespace

std::optional<Choice> pick(const std::vector<Row>& rows, const Limit& limit) {
    std::vector<std::size_t> within;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool keeps = (!limit.error || rows[i].errors.relativeL2 <= *limit.error) &&
                           (!limit.milliseconds || milliseconds(rows[i]) <= *limit.milliseconds);
        if (keeps && !rows[i].failure && (limit.withoutDiffusion || rows[i].contender.claim != Claim::Delta)) within.push_back(i);
    }
    if (within.empty()) return std::nullopt;
    const auto time = [&](std::size_t i) { return milliseconds(rows[i]); };
    const auto error = [&](std::size_t i) { return rows[i].errors.relativeL2; };
    std::vector<std::size_t> ties = within;
    if (limit.error) {
        const Row& fastest = rows[*std::ranges::min_element(within, {}, time)];
        std::erase_if(ties, [&](std::size_t i) { return !isAsFast(rows[i], fastest); });
    }
    Choice choice{.row = *std::ranges::min_element(ties, {}, error)};
    if (!limit.error) { // by the time's spread these might have been within it
        ties.clear();
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (!rows[i].failure && error(i) < error(choice.row) && rows[i].drawn.milliseconds.p25 <= *limit.milliseconds)
                ties.push_back(i);
    }
    std::erase(ties, choice.row);
    choice.ties = std::move(ties);
    return choice;
}

std::optional<double> shareOfNoDiffusion(const std::vector<Row>& rows, std::size_t row) {
    for (const Row& other : rows)
        if (!other.failure && other.contender.claim == Claim::Delta && other.scene == rows[row].scene &&
            other.mapSize == rows[row].mapSize && other.shadowSize == rows[row].shadowSize && other.errors.relativeL2 > 0)
            return rows[row].errors.relativeL2 / other.errors.relativeL2;
    return std::nullopt;
}

std::string renderCommand(const Row& row) {
    std::string command =
        fmt::format("tegument render {} -t {}", shellWord(row.contender.effect.string()), shellWord(row.contender.technique));
    for (const auto& [name, value] : row.contender.defines)
        command += define(name, value);
    for (const auto& [name, numbers] : row.contender.parameters)
        command += " -s " + shellWord(fmt::format("{}={}", name, fmt::join(numbers, ",")));
    command += fmt::format(" --map-size {}", row.mapSize);
    if (row.shadowSize != row.mapSize) command += fmt::format(" --shadow-size {}", row.shadowSize);
    return command + fmt::format(" --size {}x{} -w {}", row.width, row.height, shellWord(row.workspace.string()));
}

} // namespace tegument::bench
