#pragma once
// What compilers print, turned into our diagnostics.

#include "host/support/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace tegument {

inline constexpr std::size_t kShownMessages = 20;

struct Messages {
    std::vector<Diagnostic> errors;
    std::vector<Diagnostic> warnings;
};

/// Clang's form: `file:line:column: error: text`, followed by source line and caret. `code` is the source with its #line directives.
[[nodiscard]] Messages readDxcMessages(std::string_view log, std::string_view code, const std::string& file);
/// `ERROR: file:line: 'token' : text`; columns are found by the token.
[[nodiscard]] Messages readGlslangMessages(std::string_view log, std::string_view code, const std::string& file);

/// The line of preprocessed source that `#line` directives call `line` of `file`; empty when there is none.
[[nodiscard]] std::string sourceLine(std::string_view code, std::string_view file, int line);

/// Where the last `#line` directive of preprocessed source says that its author's text stands; `file` alone when there is none.
[[nodiscard]] SourcePosition lastLineDirective(std::string_view code, const std::string& file);

/// Without repetitions, at most kShownMessages, then one that counts the rest.
[[nodiscard]] std::vector<Diagnostic> shortened(std::vector<Diagnostic> messages);

} // namespace tegument
