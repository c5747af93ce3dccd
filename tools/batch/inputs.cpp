#include "tools/batch/inputs.h"

#include "host/support/file.h"
#include "host/support/system.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>
#include <unordered_set>

namespace tegument::batch {

namespace {

bool isPattern(const std::string& text) {
    return text.find_first_of("*?[") != std::string::npos;
}

Result<std::string> textOf(const std::string& list) {
    return list == "-" ? readStandardInput() : readFile(list);
}

bool readNumber(std::string_view text, std::size_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace

Result<Shard> shardOf(const std::string& text) {
    const std::size_t slash = text.find('/');
    Shard shard;
    if (slash != std::string::npos && readNumber(std::string_view(text).substr(0, slash), shard.index) &&
        readNumber(std::string_view(text).substr(slash + 1), shard.count) && shard.index >= 1 && shard.index <= shard.count)
        return shard;
    return usageError(8101, fmt::format("'{}' is no part of a batch", text), "parts count from 1: 1/8 is the first of eight");
}

Result<std::vector<std::string>> inputsOf(const std::vector<std::string>& named, const std::string& list) {
    std::vector<std::string> all;
    std::unordered_set<std::string> known;
    const auto add = [&](const std::string& input) {
        if (known.insert(input).second) all.push_back(input);
    };
    for (const std::string& input : named) {
        const std::vector<std::string> found = isPattern(input) ? filesLike(input) : std::vector{input};
        if (found.empty()) return usageError(8102, fmt::format("no file fits '{}'", input));
        for (const std::string& file : found)
            add(file);
    }
    if (!list.empty()) {
        const auto text = textOf(list);
        if (!text) return text.error();
        std::istringstream lines(*text);
        for (std::string line; std::getline(lines, line);)
            if (const std::string input(trim(line)); !input.empty() && input[0] != '#') add(input);
    }
    if (all.empty()) return usageError(8102, "there is no input", "name files or patterns, or a file that lists them with --list");
    return all;
}

std::vector<std::string> partOf(const std::vector<std::string>& inputs, Shard shard) {
    std::vector<std::string> part;
    for (std::size_t i = shard.index - 1; i < inputs.size(); i += shard.count)
        part.push_back(inputs[i]);
    return part;
}

} // namespace tegument::batch
