#pragma once
// Tables of numbers in files: CSV and NPY.

#include "host/support/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tegument::testing {

struct Table {
    std::size_t columns = 0;
    std::vector<std::string> names; // of the columns; empty: the file has none
    std::vector<double> numbers;    // row after row

    [[nodiscard]] std::size_t rows() const { return columns == 0 ? 0 : numbers.size() / columns; }
};

/// By content: NPY (numbers of 4 or 8 bytes in one or two dimensions, in C's order), else CSV, whose first row may name the columns. TG8204
/// with the line or byte.
[[nodiscard]] Result<Table> readTable(const std::filesystem::path& file);

} // namespace tegument::testing
