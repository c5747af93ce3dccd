#include "tools/check/resources.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tegument {

namespace {

ResourceRow& rowOf(ResourceTable& table, const FileReport& file, const PassUsage& usage) {
    const std::string effect = file.file.filename().string();
    const auto found = std::ranges::find_if(table.rows, [&](const ResourceRow& row) {
        return row.effect == effect && row.technique == usage.technique && row.pass == usage.pass && row.profile == usage.profile;
    });
    if (found != table.rows.end()) return *found;
    table.rows.push_back(
        {.effect = effect, .technique = usage.technique, .pass = usage.pass, .entry = usage.entry, .profile = usage.profile});
    return table.rows.back();
}

std::string cell(const ResourceRow& row, int Sm3Usage::*what) {
    std::vector<int> numbers;
    for (const Sm3Usage& usage : row.usage)
        numbers.push_back(usage.*what);
    const bool alike = std::ranges::all_of(numbers, [&](int number) { return number == numbers.front(); });
    return alike && !numbers.empty() ? std::to_string(numbers.front()) : fmt::format("{}", fmt::join(numbers, " / "));
}

std::string heading() {
    std::string first = "| technique | pass | stage |";
    std::string second = "|---|---|---|";
    for (const Sm3Limit& limit : kSm3Limits) {
        first += fmt::format(" {} (of {} / {}) |", limit.what, limit.vertex, limit.pixel);
        second += "---|";
    }
    return first + "\n" + second + "\n";
}

} // namespace

ResourceTable resourceTable(const CheckReport& report) {
    ResourceTable table;
    for (const FileReport& file : report.files) {
        if (std::ranges::find(table.variants, file.variant) == table.variants.end()) table.variants.push_back(file.variant);
        for (const PassUsage& usage : file.sm3)
            rowOf(table, file, usage).usage.push_back(usage.usage);
    }
    std::ranges::stable_sort(table.rows, {}, &ResourceRow::effect);
    return table;
}

std::string toMarkdown(const ResourceTable& table) {
    std::string text;
    std::string effect;
    for (const ResourceRow& row : table.rows) {
        if (row.effect != effect) {
            effect = row.effect;
            text += fmt::format("{}### {}\n\n{}", text.empty() ? "" : "\n", effect, heading());
        }
        text += fmt::format("| {} | {} | {} {} |", row.technique, row.pass, row.profile.substr(0, 2), row.entry);
        for (const Sm3Limit& limit : kSm3Limits)
            text += fmt::format(" {} |", cell(row, limit.used));
        text += "\n";
    }
    return text;
}

} // namespace tegument
