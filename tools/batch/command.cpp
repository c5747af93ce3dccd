#include "tools/batch/command.h"

#include "host/support/file.h"
#include "host/support/system.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>

namespace tegument::batch {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kInput = "{}";
constexpr std::array<std::string_view, 3> kParts{"{path}", "{file}", "{name}"};

void replace(std::string& text, std::string_view what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

std::string filled(std::string word, const std::string& input) {
    const fs::path path(input);
    replace(word, kParts[0], fs::path(path).replace_extension().string());
    replace(word, kParts[1], path.filename().string());
    replace(word, kParts[2], path.stem().string());
    replace(word, kInput, input);
    return word;
}

bool isOutput(const std::string& word) {
    return std::ranges::any_of(kParts, [&](std::string_view part) { return word.find(part) != std::string::npos; });
}

} // namespace

std::vector<std::string> commandFor(const std::vector<std::string>& words, const std::string& input) {
    std::vector<std::string> command;
    for (const std::string& word : words)
        command.push_back(filled(word, input));
    return command;
}

Result<void> commandsDiffer(const std::vector<std::string>& words, const std::vector<std::string>& inputs) {
    const auto holdsInput = [](const std::string& word) { return word.find(kInput) != std::string::npos; };
    if (std::ranges::none_of(words, holdsInput))
        return usageError(8103, "no word of the command is {}, where each input goes", "for example -- prep {} -o prepared/{name}.glb");
    for (const std::string& word : words) {
        if (!isOutput(word)) continue;
        std::unordered_map<std::string, std::string> owner;
        for (const std::string& input : inputs)
            if (const auto [first, isNew] = owner.emplace(filled(word, input), input); !isNew)
                return usageError(8104, fmt::format("{} and {} would both be written to {}", first->second, input, first->first),
                                  "{path} keeps the folders, {file} the ending");
    }
    return {};
}

std::string identityOf(const std::vector<std::string>& words, const std::string& input, const std::vector<fs::path>& with,
                       const std::string& program, const FilesBehind& filesBehind) {
    std::string all = program;
    const auto addFile = [&](const fs::path& file) {
        const auto bytes = readFile(file);
        all += fmt::format("\n{} {}", file.string(), bytes ? contentHash(*bytes) : std::string("-"));
    };
    for (const std::string& word : words) {
        const std::string own = filled(word, input);
        all += fmt::format("\n{} {}", own.size(), own);
        if (!isOutput(word)) std::ranges::for_each(filesBehind(own), addFile);
    }
    std::ranges::for_each(with, addFile);
    return contentHash(all);
}

Result<std::string> thisProgram(const std::string& version) {
    const auto bytes = readFile(programFile());
    if (!bytes) return bytes.error();
    return fmt::format("{} {}", version, contentHash(*bytes));
}

} // namespace tegument::batch
