// tegument merge: the records of a batch, of any number of shards, as one table.

#include "host/support/file.h"
#include "tools/batch/table.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <memory>
#include <sstream>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct MergeOptions {
    std::vector<std::string> folders;
    std::vector<std::string> columns;
    std::string output;
    std::string joined;
    bool onlyFailed = false;
    bool json = false;
};

Result<std::string> textFor(const fs::path& file, const batch::Table& table, const std::vector<batch::Record>& records) {
    const std::string ending = toLower(file.extension().string());
    if (ending == ".csv") return csvOf(table);
    if (ending == ".md") return markdownOf(table);
    if (ending == ".html") return pageOf(table, sumsOf(records));
    std::string lines;
    for (const batch::Record& record : records)
        lines += lineOf(record) + "\n";
    return lines;
}

Result<void> writeAll(const MergeOptions& options, const batch::Table& table, const std::vector<batch::Record>& records) {
    const auto write = [](const std::string& file, const Result<std::string>& text) -> Result<void> {
        if (!text) return text.error();
        if (auto written = writeFile(file, *text); !written) return written.error();
        fmt::print(stderr, "wrote {}\n", file);
        return {};
    };
    if (!options.joined.empty())
        if (auto written = write(options.joined, joinedResults(records)); !written) return written;
    if (options.output.empty()) return {};
    return write(options.output, textFor(options.output, table, records));
}

/// The messages stand behind the table: they are of any length.
void printTable(batch::Table all, const std::string& sums) {
    std::vector<std::string> messages;
    all.header.pop_back();
    for (auto& row : all.rows) {
        messages.push_back(std::move(row.back()));
        row.pop_back();
    }
    std::istringstream lines(table(all.header, all.rows));
    std::string line;
    std::getline(lines, line);
    fmt::print("{}\n", line);
    for (const std::string& message : messages)
        if (std::getline(lines, line)) fmt::print("{}{}{}\n", line, message.empty() ? "" : "  ", message);
    fmt::print("\n{}\n", sums);
}

int merge(const MergeOptions& options) {
    for (const auto& able : {checkOutput(options.output, {".csv", ".md", ".html", ".jsonl"}), checkOutput(options.joined, {".json"})})
        if (!able) return fail(able.error(), options.json);
    std::vector<batch::Column> columns;
    for (const std::string& text : options.columns) {
        auto column = batch::columnOf(text);
        if (!column) return fail(column.error(), options.json);
        columns.push_back(std::move(*column));
    }
    auto records = batch::readRecords({options.folders.begin(), options.folders.end()});
    if (!records) return fail(records.error(), options.json);
    const std::string sums = sumsOf(*records);
    if (options.onlyFailed) std::erase_if(*records, batch::isDone);
    const batch::Table all = tableOf(*records, columns);
    if (const auto written = writeAll(options, all, *records); !written) return fail(written.error(), options.json);
    if (options.json) {
        for (const batch::Record& record : *records)
            fmt::print("{}\n", lineOf(record));
    } else if (options.output.empty() && options.joined.empty()) {
        printTable(all, sums);
    }
    return 0;
}

} // namespace

void addMerge(CLI::App& program, Action& action) {
    auto options = std::make_shared<MergeOptions>();
    CLI::App* command = program.add_subcommand("merge", "The records of a batch as a table, a page or one JSON file");
    command->add_option("folders", options->folders, "Folders that --results of tegument batch named")->required();
    repeatable(
        command->add_option("--column", options->columns,
                            "One more column: a JSON pointer into what the command printed, /faces or faces=/mesh/faces; may be repeated"));
    command->add_option("-o,--output", options->output, "Write it: .csv, .md, .html, .jsonl");
    command->add_option("--join", options->joined, "Write what the commands printed as one .json, for example for bench --markdown");
    command->add_flag("--failed", options->onlyFailed, "Only what failed");
    command->add_flag("--json", options->json, "Print the records, one a line");
    addExamples(*command, {{"merge done", "what is done, what failed and why"},
                           {"merge done --column /faces -o report.html", "a page"},
                           {"merge done --failed", "only what failed"}});
    command->callback([options, &action] { action = [options] { return merge(*options); }; });
}

} // namespace tegument::app
