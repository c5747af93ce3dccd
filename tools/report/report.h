#pragma once
// A report as one file of HTML: data as JSON, and the script that shows it. It needs no network and no other file.

#include "host/support/result.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tegument::report {

using Json = nlohmann::ordered_json;

struct Page {
    std::string title;                                      // "tegument verify"
    std::string summary;                                    // one sentence: what came out
    std::string verdict;                                    // "pass", "fail", or empty where there is none
    std::vector<std::pair<std::string, std::string>> facts; // device, driver, ...
    std::vector<Json> sections;                             // docs/design/reports.md
};

/// How a column is shown and sorted: "text", "code", "number", "verdict" (pass, fail, anything else), or "share" (of a limit: a bar).
struct Column {
    std::string title;
    std::string kind = "text";
    std::string help; // where the title does not say it
};

/// Rows are lists with as many values as there are columns; null is shown as a dash.
[[nodiscard]] Json table(const std::string& title, const std::string& note, const std::vector<Column>& columns, Json rows);
/// Paragraphs.
[[nodiscard]] Json notes(const std::string& title, const std::vector<std::string>& paragraphs);

/// The page's text.
[[nodiscard]] std::string html(const Page& page);
/// TG5002 where it cannot be written.
[[nodiscard]] Result<void> write(const std::filesystem::path& path, const Page& page);

} // namespace tegument::report
