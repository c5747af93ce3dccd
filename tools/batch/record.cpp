#include "tools/batch/record.h"

#include "host/support/file.h"

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

fs::path recordsOf(const fs::path& folder) {
    return folder / "records";
}

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

std::pair<std::string, std::string> keyOf(const Record& record) {
    return {record.input, fmt::format("{}", fmt::join(record.command, "\n"))};
}

/// The files of a folder that are whole: what a writer that died left behind has another ending.
std::vector<fs::path> filesOf(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code code;
    for (fs::directory_iterator entry(recordsOf(folder), code), end; !code && entry != end; entry.increment(code))
        if (entry->path().extension() == ".json") files.push_back(entry->path());
    return files;
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

fs::path recordFile(const fs::path& folder, const std::string& input, const std::vector<std::string>& command) {
    return recordsOf(folder) / (contentHash(fmt::format("{}\n{}", input, fmt::join(command, "\n"))) + ".json");
}

std::string lineOf(const Record& record) {
    const Json json = {{"input", record.input},           {"state", stateOf(record)},
                       {"seconds", record.seconds},       {"processor_seconds", record.processorSeconds},
                       {"peak_bytes", record.peakBytes},  {"exit_code", record.exitCode},
                       {"out_of_time", record.outOfTime}, {"command", record.command},
                       {"identity", record.identity},     {"host", record.host},
                       {"ended", record.ended},           {"result", resultOf(record)},
                       {"messages", record.messages}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<void> writeRecord(const fs::path& folder, const Record& record) {
    return writeFile(recordFile(folder, record.input, record.command), lineOf(record) + "\n");
}

Result<Record> readRecord(const fs::path& file) {
    const auto text = readFile(file);
    if (!text) return text.error();
    try {
        const Json json = Json::parse(*text);
        Record record{.input = json.at("input"),
                      .command = json.at("command"),
                      .identity = json.at("identity"),
                      .exitCode = wholeOf<int>(json, "exit_code"),
                      .outOfTime = json.at("out_of_time"),
                      .seconds = json.at("seconds"),
                      .processorSeconds = json.at("processor_seconds"),
                      .peakBytes = wholeOf<std::size_t>(json, "peak_bytes"),
                      .result = textOf(json.at("result")),
                      .messages = json.at("messages"),
                      .host = json.at("host"),
                      .ended = json.at("ended")};
        return record;
    } catch (const Json::exception& error) {
        return inputError(8105, {.file = file.string(), .byte = {}}, fmt::format("is no record of a batch: {}", error.what()),
                          "remove it, and run the batch again: it does only what is missing");
    }
}

Result<std::vector<Record>> readRecords(const std::vector<fs::path>& folders) {
    std::map<std::pair<std::string, std::string>, Record> latest;
    for (const fs::path& folder : folders) {
        const std::vector<fs::path> files = filesOf(folder);
        if (files.empty())
            return usageError(8106, fmt::format("{} holds no records of a batch", folder.string()), "name the folder that --results had");
        for (const fs::path& file : files) {
            auto record = readRecord(file);
            if (!record) return record.error();
            auto [at, isNew] = latest.try_emplace(keyOf(*record), *record);
            if (!isNew && record->ended > at->second.ended) at->second = std::move(*record);
        }
    }
    std::vector<Record> all;
    for (auto& [key, record] : latest)
        all.push_back(std::move(record));
    return all;
}

std::string valueAt(const Record& record, const std::string& pointer) {
    const Json result = resultOf(record);
    try {
        const Json::json_pointer at(pointer);
        return result.contains(at) ? textOf(result.at(at)) : std::string();
    } catch (const Json::exception&) {
        return {};
    }
}

} // namespace tegument::batch
