#pragma once
// What the program says: messages on standard error, results on standard output, JSON for programs.

#include "host/support/result.h"
#include "tools/cli/progress.h"

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

/// A line on standard error. Where it cannot be written the work goes on.
void say(const std::string& line);

/// Prints the error (with `json` as {"diagnostics": [...]} on standard output too) and returns the exit code that belongs to it.
/// Where an input was to be written it is that error instead (TG5004).
int fail(const Error& error, bool json);
/// The exit code of a command, or of TG5004 where a reader took an input that was to be written for one that is not there.
int keepingInputs(int code);
void warn(const std::vector<Diagnostic>& warnings);

/// TG8024 when the path's ending is none of these (".png", ...), TG5002 when nothing can be written there, TG5004 when it is read: asked
/// before the work. Warns of a picture or mesh that the program has not written (TG8028). An empty path is none.
[[nodiscard]] Result<void> checkOutput(const std::string& path, const std::vector<std::string>& endings, const std::string& hint = {});
/// TG5002 when files cannot be written into this folder.
[[nodiscard]] Result<void> checkFolder(const std::string& folder);

/// "1 strand", "2 strands".
[[nodiscard]] std::string counted(std::size_t number, const std::string& what);
/// Left-aligned first column, right-aligned others.
[[nodiscard]] std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

} // namespace tegument::app
