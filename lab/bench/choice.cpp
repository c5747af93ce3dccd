#include "lab/bench/choice.h"

#include "generated/setting_names.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace tegument::bench {

namespace {

double milliseconds(const Row& row) {
    return row.drawn.milliseconds.median;
}

std::string define(const std::string& name, const std::string& value) {
    for (std::size_t i = 0; i < kSettingNames.size(); ++i)
        if (name == kSettingSwitch && value == std::to_string(i)) return std::string(" --setting ") + kSettingNames.at(i);
    return " -D " + shellWord(name + "=" + value);
}

} // namespace

std::vector<std::size_t> paretoFront(const std::vector<Row>& rows) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (!rows[i].failure) order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::pair(milliseconds(rows[i]), rows[i].errors.relativeL2); });
    std::vector<std::size_t> front;
    double best = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
        if (rows[i].errors.relativeL2 >= best) continue;
        best = rows[i].errors.relativeL2;
        front.push_back(i);
    }
    return front;
}

std::optional<std::size_t> pick(const std::vector<Row>& rows, const Limit& limit) {
    const std::vector<std::size_t> front = paretoFront(rows); // faster to slower, the error falls
    std::optional<std::size_t> chosen;
    for (const std::size_t i : front) {
        if (limit.error && rows[i].errors.relativeL2 <= *limit.error) return i;
        if (limit.milliseconds && milliseconds(rows[i]) <= *limit.milliseconds) chosen = i;
    }
    return chosen;
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
