#include "tools/test/table.h"

#include "host/support/file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <regex>

namespace tegument::testing {

namespace {

namespace fs = std::filesystem;

Error damaged(const fs::path& file, int line, std::string text) {
    return inputError(8204, {.file = file.string(), .line = line, .column = line == 0 ? 0 : 1}, std::move(text),
                      "CSV: numbers separated by commas, one row a line; NPY: numpy.save");
}

std::optional<double> number(std::string_view text) {
    double value = 0;
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

std::vector<std::string_view> cells(std::string_view line) {
    std::vector<std::string_view> found;
    for (;;) {
        const std::size_t comma = line.find(',');
        found.push_back(trim(line.substr(0, comma)));
        if (comma == std::string_view::npos) return found;
        line.remove_prefix(comma + 1);
    }
}

Result<Table> readCsv(const fs::path& file, std::string_view text) {
    Table table;
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view row = trim(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (row.empty() || row.starts_with('#')) continue;
        const std::vector<std::string_view> words = cells(row);
        if (table.columns == 0 && !number(words.front())) {
            table.names.assign(words.begin(), words.end());
            table.columns = words.size();
            continue;
        }
        if (table.columns == 0) table.columns = words.size();
        if (words.size() != table.columns)
            return damaged(file, line, fmt::format("a row of {} numbers in a table of {} columns", words.size(), table.columns));
        for (const std::string_view word : words) {
            const auto value = number(word);
            if (!value) return damaged(file, line, fmt::format("'{}' is no number", word));
            table.numbers.push_back(*value);
        }
    }
    if (table.numbers.empty()) return damaged(file, 0, "the table has no rows");
    return table;
}

template <class T>
std::vector<double> numbersAs(std::string_view bytes, std::size_t count) {
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
        T value{};
        std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
        numbers[i] = static_cast<double>(value);
    }
    return numbers;
}

std::vector<double> decoded(const std::string& type, std::string_view bytes, std::size_t count) {
    if (type == "f4") return numbersAs<float>(bytes, count);
    if (type == "f8") return numbersAs<double>(bytes, count);
    if (type == "i4") return numbersAs<std::int32_t>(bytes, count);
    if (type == "u4") return numbersAs<std::uint32_t>(bytes, count);
    return numbersAs<std::int64_t>(bytes, count);
}

Result<Table> readNpy(const fs::path& file, std::string_view bytes) {
    const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at])); };
    if (bytes.size() < 12) return damaged(file, 0, "the file ends in its head");
    const bool wide = byte(6) > 1; // version 2 counts the head's bytes by four
    const std::size_t start = wide ? 12 : 10;
    const std::size_t length = byte(8) + (byte(9) << 8U) + (wide ? (byte(10) << 16U) + (byte(11) << 24U) : 0);
    if (start + length > bytes.size()) return damaged(file, 0, "the file ends in its head");
    const std::string head(bytes.substr(start, length));
    static const std::regex kHead(R"('descr':\s*'[<|](f4|f8|i4|u4|i8)'[^}]*'fortran_order':\s*False[^}]*'shape':\s*\((\d+),?\s*(\d*)\))");
    std::smatch match;
    if (!std::regex_search(head, match, kHead))
        return damaged(file, 0, fmt::format("a table of another kind: {}", trim(head.substr(0, 120))));
    const std::string type = match[1];
    const auto rows = number(match[2].str()).value_or(0);
    const auto columns = match[3].length() == 0 ? 1.0 : number(match[3].str()).value_or(0);
    const std::string_view body = bytes.substr(start + length);
    const auto size = static_cast<double>(type[1] - '0');
    if (rows * columns < 1 || rows * columns * size > static_cast<double>(body.size()))
        return damaged(file, 0, fmt::format("{} x {} numbers are announced, and {} bytes are there", rows, columns, body.size()));
    return Table{.columns = static_cast<std::size_t>(columns),
                 .numbers = decoded(type, body, static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns))};
}

} // namespace

Result<Table> readTable(const fs::path& file) {
    const auto bytes = readFile(file);
    if (!bytes) return bytes.error();
    return bytes->starts_with("\x93NUMPY") ? readNpy(file, *bytes) : readCsv(file, *bytes);
}

} // namespace tegument::testing
