#pragma once
// What the program says: messages on standard error, results on standard output, JSON for programs.

#include "host/support/result.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace tegument::app {

/// Keys stay in the order in which they were added.
using Json = nlohmann::ordered_json;

/// {severity, code, file, line, column, text, hint}; what is unknown is left out.
[[nodiscard]] Json toJson(const Diagnostic& diagnostic);
[[nodiscard]] Json toJson(const std::vector<Diagnostic>& diagnostics);

/// Prints JSON that is valid UTF-8 whatever the file names hold.
void print(const Json& json);

/// Prints the error (with `json` as {"diagnostics": [...]} on standard output too) and returns the exit code that belongs to it.
int fail(const Error& error, bool json);
void warn(const std::vector<Diagnostic>& warnings);

/// A line that replaces itself while standard error is a terminal, and says nothing otherwise.
class Progress {
public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void say(const std::string& line);
    void clear();

private:
    bool terminal_;
    std::size_t width_ = 0;
};

/// Left-aligned first column, right-aligned others.
[[nodiscard]] std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

} // namespace tegument::app
