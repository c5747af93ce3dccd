#pragma once
// Results as JSON, CSV, Markdown and a table for the terminal.

#include "host/bench/bench.h"

#include <string>
#include <vector>

namespace tegument::bench {

struct Machine {
    std::string device;
    std::string driver;
    std::string compiler;
    std::string date; // UTC, 2026-11-21
    std::string version;
    bool cpu = false; // times are good as ratios only
};

/// A list with one object for each row (docs/bench.md); numbers that are not known are null.
[[nodiscard]] std::string toJson(const std::vector<Row>& rows, const Machine& machine);
/// The same figures, a line for each row under a line of names (RFC 4180).
[[nodiscard]] std::string toCsv(const std::vector<Row>& rows, const Machine& machine);

/// Cells of a table for people: a header and the rows.
struct Table {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};
[[nodiscard]] Table toTable(const std::vector<Row>& rows);
/// One Markdown table for each scene, size and machine of a list that toJson wrote, in the order of the list. TG8076
/// when it is no such list.
[[nodiscard]] Result<std::string> toMarkdown(const std::string& json, const std::string& nameForMessages);

} // namespace tegument::bench
