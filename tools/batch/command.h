#pragma once
// The command of each input: words with places to fill.

#include "host/support/result.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tegument::batch {

/// The words with `{}` replaced by the input, `{path}` by the input without its ending, `{file}` by its name without folders, `{name}` by
/// that without its ending.
[[nodiscard]] std::vector<std::string> commandFor(const std::vector<std::string>& words, const std::string& input);

/// TG8103 no word holds `{}`; TG8104 two inputs would be written to the same place.
[[nodiscard]] Result<void> commandsDiffer(const std::vector<std::string>& words, const std::vector<std::string>& inputs);

/// The files whose bytes decide what a command does because this word names them; none for any other word.
using FilesBehind = std::function<std::vector<std::filesystem::path>(const std::string& word)>;

/// What decides the outcome of the command for one input: the bytes of the files behind its words and of the files `with`, its words, the
/// program. Words with `{path}`, `{file}` or `{name}` are outputs: what lies there does not count. The same text: nothing to do again.
[[nodiscard]] std::string identityOf(const std::vector<std::string>& words, const std::string& input,
                                     const std::vector<std::filesystem::path>& with, const std::string& program,
                                     const FilesBehind& filesBehind);

/// The version and the bytes of the program that runs.
[[nodiscard]] Result<std::string> thisProgram(const std::string& version);

} // namespace tegument::batch
