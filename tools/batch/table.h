#pragma once
// Records as what people read, and as what other programs read.

#include "tools/batch/record.h"

#include <string>
#include <utility>
#include <vector>

namespace tegument::batch {

/// A column beyond the usual ones: its title, and where in the printed JSON its value stands.
struct Column {
    std::string title;
    std::string pointer;
};

/// "faces=/mesh/faces", or "/mesh/faces", whose title is its last word. TG8108 anything else.
[[nodiscard]] Result<Column> columnOf(const std::string& text);

struct Table {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

/// input, state, seconds, MiB, the columns, and the first message of what failed. What failed stands first.
[[nodiscard]] Table tableOf(const std::vector<Record>& records, const std::vector<Column>& columns);

/// "200 inputs: 197 done, 3 failed; 412 s of processor time".
[[nodiscard]] std::string sumsOf(const std::vector<Record>& records);

[[nodiscard]] std::string csvOf(const Table& table);
[[nodiscard]] std::string markdownOf(const Table& table);
/// One page without anything from elsewhere.
[[nodiscard]] std::string pageOf(const Table& table, const std::string& sums);

/// What all commands that succeeded printed, as one: of objects the arrays are joined, one behind another, and the rest is that of the
/// first. TG8109 something that was printed is no JSON object.
[[nodiscard]] Result<std::string> joinedResults(const std::vector<Record>& records);

} // namespace tegument::batch
