#include "tools/batch/table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

namespace tegument::batch {

using Json = nlohmann::ordered_json;

namespace {

constexpr double kMiB = 1024.0 * 1024.0;

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

/// A text, or nothing: any command's JSON is read here.
std::string textAt(const Json& json, const char* key, const char* otherwise = "") {
    const auto found = json.find(key);
    if (found == json.end()) return otherwise;
    return found->is_string() ? found->get<std::string>() : std::string();
}

/// Of the first error among the diagnostics that stand somewhere in printed JSON: "a.fx(3): TG1101: text".
std::string firstDiagnostic(const Json& json, int depth = 0) {
    constexpr int kDeepest = 32;
    if (json.is_object() && json.contains("code") && textAt(json, "severity", "error") == "error" && json.contains("text")) {
        const std::string place = textAt(json, "file") + (json.contains("line") ? fmt::format("({})", json["line"].dump()) : "");
        return fmt::format("{}{}{}: {}", place, place.empty() ? "" : ": ", textAt(json, "code"), textAt(json, "text"));
    }
    if (json.is_structured() && depth < kDeepest)
        for (const Json& part : json)
            if (std::string found = firstDiagnostic(part, depth + 1); !found.empty()) return found;
    return {};
}

/// The first line that tells of an error, else the first line; of a command that said nothing what it printed.
std::string firstMessage(const Record& record) {
    if (isDone(record)) return {};
    if (record.messages.empty()) return firstDiagnostic(Json::parse(record.result, nullptr, false));
    const std::size_t error = record.messages.find("error");
    const std::size_t begin = error == std::string::npos ? 0 : record.messages.rfind('\n', error) + 1;
    return record.messages.substr(begin, record.messages.find('\n', begin) - begin);
}

std::string quoted(const std::string& cell) {
    if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
    return '"' + replaced(cell, "\"", "\"\"") + '"';
}

std::string markdownCell(const std::string& cell) {
    return replaced(replaced(cell, "|", "\\|"), "\n", " ");
}

std::string htmlCell(const std::string& cell) {
    return replaced(replaced(replaced(cell, "&", "&amp;"), "<", "&lt;"), ">", "&gt;");
}

template <class Each>
std::string joined(const std::vector<std::string>& cells, std::string_view between, Each each) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i)
        line += (i > 0 ? std::string(between) : std::string()) + each(cells[i]);
    return line;
}

std::string htmlRow(const std::vector<std::string>& cells, std::string_view tag) {
    std::string row = "<tr>";
    for (const std::string& cell : cells)
        row += fmt::format("<{}>{}</{}>", tag, htmlCell(cell), tag);
    return row + "</tr>\n";
}

} // namespace

Result<Column> columnOf(const std::string& text) {
    const std::size_t at = text.find('/');
    const bool titled = at != std::string::npos && at > 1 && text[at - 1] == '=';
    if (at != 0 && !titled)
        return usageError(8108, fmt::format("'{}' is no column", text), "a column is a JSON pointer such as /faces, or faces=/mesh/faces");
    return titled ? Column{text.substr(0, at - 1), text.substr(at)} : Column{text.substr(text.rfind('/') + 1), text};
}

Table tableOf(const std::vector<Record>& records, const std::vector<Column>& columns) {
    Table table{.header = {"input", "state", "seconds", "MiB"}, .rows = {}};
    for (const Column& column : columns)
        table.header.push_back(column.title);
    table.header.emplace_back("message");
    std::vector<const Record*> order;
    for (const Record& record : records)
        order.push_back(&record);
    std::ranges::stable_sort(order, {}, [](const Record* record) { return isDone(*record); });
    for (const Record* record : order) {
        std::vector<std::string> row{record->input, stateOf(*record), fmt::format("{:.2f}", record->seconds),
                                     fmt::format("{:.0f}", static_cast<double>(record->peakBytes) / kMiB)};
        for (const Column& column : columns)
            row.push_back(valueAt(*record, column.pointer));
        row.push_back(firstMessage(*record));
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::string sumsOf(const std::vector<Record>& records) {
    double processor = 0;
    for (const Record& record : records)
        processor += record.processorSeconds;
    const auto done = std::ranges::count_if(records, isDone);
    return fmt::format("{} inputs: {} done, {} failed; {:.0f} s of processor time", records.size(), done,
                       static_cast<std::ptrdiff_t>(records.size()) - done, processor);
}

std::string csvOf(const Table& table) {
    std::string text = joined(table.header, ",", quoted) + "\n";
    for (const auto& row : table.rows)
        text += joined(row, ",", quoted) + "\n";
    return text;
}

std::string markdownOf(const Table& table) {
    std::string text = "| " + joined(table.header, " | ", markdownCell) + " |\n|";
    for (std::size_t i = 0; i < table.header.size(); ++i)
        text += "---|";
    text += "\n";
    for (const auto& row : table.rows)
        text += "| " + joined(row, " | ", markdownCell) + " |\n";
    return text;
}

std::string pageOf(const Table& table, const std::string& sums) {
    std::string page = "<!doctype html>\n<meta charset=\"utf-8\"><title>Tegument: a batch</title>\n"
                       "<style>body{font:15px sans-serif;margin:2em}table{border-collapse:collapse}"
                       "td,th{border-bottom:1px solid #ccc;padding:.3em .8em;text-align:left}</style>\n";
    page += fmt::format("<p>{}</p>\n<table>\n{}", htmlCell(sums), htmlRow(table.header, "th"));
    for (const auto& row : table.rows)
        page += htmlRow(row, "td");
    return page + "</table>\n";
}

Result<std::string> joinedResults(const std::vector<Record>& records) {
    Json all = Json::object();
    for (const Record& record : records) {
        if (!isDone(record)) continue;
        const Json printed = Json::parse(record.result, nullptr, false);
        if (!printed.is_object())
            return inputError(8109, {.file = record.input, .byte = {}}, "the command printed no JSON object for this input",
                              "give it --json");
        for (const auto& [key, value] : printed.items()) {
            if (!all.contains(key))
                all[key] = value;
            else if (value.is_array() && all[key].is_array())
                all[key].insert(all[key].end(), value.begin(), value.end());
        }
    }
    return all.dump(1) + "\n";
}

} // namespace tegument::batch
