#include "host/support/file.h"
#include "tools/batch/batch.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

namespace tegument::batch {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kSignal = 128;

/// What the command printed, as part of our own JSON where it is JSON.
Json resultOf(const Record& record) {
    Json parsed = Json::parse(record.result, nullptr, false);
    return parsed.is_discarded() ? Json(record.result) : parsed;
}

/// A number that fits; the library's own conversion of one that does not is undefined.
template <class Number>
Number wholeOf(const Json& json, const char* name) {
    const Json& value = json.at(name);
    const auto fits = [](auto number) { return std::in_range<Number>(number); };
    if (value.is_number_unsigned() ? !fits(value.get<std::uint64_t>()) : !value.is_number_integer() || !fits(value.get<std::int64_t>()))
        throw Json::type_error::create(302, fmt::format("'{}' is no whole number, or too large", name), &value);
    return value.get<Number>();
}

std::string textOf(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

Json jsonOf(const FileStates& files) {
    Json json = Json::object();
    for (const auto& [file, state] : files)
        json[file] = {{"bytes", state.bytes}, {"hash", state.hash}};
    return json;
}

FileStates statesFrom(const Json& json) {
    FileStates files;
    for (const auto& [file, state] : json.items())
        files[file] = {.bytes = wholeOf<std::size_t>(state, "bytes"), .hash = state.at("hash")};
    return files;
}

std::string valueAt(const Json& result, const std::string& pointer) {
    try {
        const Json::json_pointer at(pointer);
        return result.contains(at) ? textOf(result.at(at)) : std::string();
    } catch (const Json::exception&) {
        return {};
    }
}

/// The first line that tells of an error, else the first line.
std::string firstMessage(const Record& record) {
    if (isDone(record)) return {};
    const std::size_t error = record.messages.find("error");
    const std::size_t begin = error == std::string::npos ? 0 : record.messages.rfind('\n', error) + 1;
    return record.messages.substr(begin, record.messages.find('\n', begin) - begin);
}

} // namespace

bool isDone(const Record& record) {
    return record.exitCode == 0 && !record.outOfTime;
}

std::string stateOf(const Record& record) {
    if (record.outOfTime) return "out of time";
    if (record.exitCode == 0) return "done";
    if (record.exitCode > kSignal) return fmt::format("killed by signal {}", record.exitCode - kSignal);
    return fmt::format("failed ({})", record.exitCode);
}

FileStates statesOf(const std::vector<fs::path>& files) {
    FileStates states;
    for (const fs::path& file : files)
        if (const auto bytes = readFile(file)) states[file.string()] = {.bytes = bytes->size(), .hash = contentHash(*bytes)};
    return states;
}

bool areUnchanged(const FileStates& files) {
    return std::ranges::all_of(files, [](const auto& one) {
        const auto& [file, state] = one;
        std::error_code code;
        if (fs::file_size(file, code) != state.bytes || code) return false;
        const auto bytes = readFile(file);
        return bytes && contentHash(*bytes) == state.hash;
    });
}

fs::path recordFile(const fs::path& folder, const Record& record) {
    return folder / "records" / (contentHash(fmt::format("{}\n{}", record.input, fmt::join(record.command, "\n"))) + ".json");
}

std::string lineOf(const Record& record) {
    const Json json = {
        {"input", record.input},        {"state", stateOf(record)},          {"seconds", record.seconds},  {"peak_bytes", record.peakBytes},
        {"exit_code", record.exitCode}, {"out_of_time", record.outOfTime},   {"command", record.command},  {"program", record.program},
        {"read", jsonOf(record.read)},  {"written", jsonOf(record.written)}, {"result", resultOf(record)}, {"messages", record.messages}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<Record> readRecord(const fs::path& file) {
    const auto text = readFile(file);
    if (!text) return text.error();
    try {
        const Json json = Json::parse(*text);
        return Record{.input = json.at("input"),
                      .command = json.at("command"),
                      .program = json.at("program"),
                      .read = statesFrom(json.at("read")),
                      .written = statesFrom(json.at("written")),
                      .exitCode = wholeOf<int>(json, "exit_code"),
                      .outOfTime = json.at("out_of_time"),
                      .seconds = json.at("seconds"),
                      .peakBytes = wholeOf<std::size_t>(json, "peak_bytes"),
                      .result = textOf(json.at("result")),
                      .messages = json.at("messages")};
    } catch (const Json::exception& error) {
        return inputError(8105, {.file = file.string()}, fmt::format("is no record of a batch: {}", error.what()),
                          "remove it, and run the batch again: it does only what is missing");
    }
}

Result<std::vector<Record>> readRecords(const fs::path& folder) {
    std::vector<Record> all;
    std::error_code code;
    for (fs::directory_iterator entry(folder / "records", code), end; !code && entry != end; entry.increment(code)) {
        if (entry->path().extension() != ".json") continue; // what a writer that died left behind
        auto record = readRecord(entry->path());
        if (!record) return record.error();
        all.push_back(std::move(*record));
    }
    if (all.empty())
        return usageError(8106, fmt::format("{} holds no records of a batch", folder.string()), "name the folder that --results had");
    std::ranges::sort(all, {}, [](const Record& record) { return std::tuple(isDone(record), record.input, record.command); });
    return all;
}

Rows tableOf(const std::vector<Record>& records, const std::vector<std::string>& columns) {
    Rows rows{{"input", "state", "seconds", "MiB"}};
    for (const std::string& column : columns)
        rows.front().push_back(column.substr(column.rfind('/') + 1));
    rows.front().emplace_back("message");
    for (const Record& record : records) {
        rows.push_back({record.input, stateOf(record), fmt::format("{:.2f}", record.seconds),
                        fmt::format("{:.0f}", static_cast<double>(record.peakBytes) / 0x1p20)});
        const Json result = resultOf(record);
        for (const std::string& column : columns)
            rows.back().push_back(valueAt(result, column));
        rows.back().push_back(firstMessage(record));
    }
    return rows;
}

report::Page pageOf(const Rows& table) {
    std::vector<report::Column> columns;
    for (const std::string& title : table.front())
        columns.push_back({.title = title, .kind = "text"});
    const Json rows(std::vector(table.begin() + 1, table.end()));
    const std::string summary = fmt::format("{} inputs", rows.size());
    return {"tegument batch", summary, {}, {}, {report::table("Inputs", "", columns, rows)}};
}

} // namespace tegument::batch
