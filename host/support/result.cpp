#include "host/support/result.h"

#include <fmt/format.h>

namespace tegument {

namespace {

std::string_view name(Severity severity) {
    switch (severity) {
    case Severity::Note: return "note";
    case Severity::Warning: return "warning";
    case Severity::Error: return "error";
    }
    return "error";
}

std::string place(const SourcePosition& at) {
    if (at.file.empty()) return "tegument: ";
    if (at.byte) return fmt::format("{}(byte {}): ", at.file, *at.byte);
    if (at.line == 0) return fmt::format("{}: ", at.file);
    return fmt::format("{}({},{}): ", at.file, at.line, at.column);
}

/// Tabs stay tabs under the caret, so that it points at the same column whatever the tab width.
std::string caretLine(const std::string& sourceLine, int column) {
    std::string caret;
    for (int i = 0; i + 1 < column && i < static_cast<int>(sourceLine.size()); ++i)
        caret += sourceLine[static_cast<std::size_t>(i)] == '\t' ? '\t' : ' ';
    return caret + '^';
}

Error single(Blame blame, int code, SourcePosition at, std::string text, std::string hint) {
    return Error{blame,
                 {Diagnostic{.code = code, .at = std::move(at), .text = std::move(text), .hint = std::move(hint), .sourceLine = {}}}};
}

} // namespace

std::string format(const Diagnostic& diagnostic) {
    std::string line = fmt::format("{}{} TG{:04}: {}", place(diagnostic.at), name(diagnostic.severity), diagnostic.code, diagnostic.text);
    if (!diagnostic.hint.empty()) line += "; " + diagnostic.hint;
    if (diagnostic.sourceLine.empty() || diagnostic.at.column == 0) return line;
    return fmt::format("{}\n    {}\n    {}", line, diagnostic.sourceLine, caretLine(diagnostic.sourceLine, diagnostic.at.column));
}

std::string format(const Error& error) {
    std::string text;
    for (const Diagnostic& diagnostic : error.diagnostics) {
        if (!text.empty()) text += '\n';
        text += format(diagnostic);
    }
    return text;
}

Error inputError(int code, SourcePosition at, std::string text, std::string hint) {
    return single(Blame::Input, code, std::move(at), std::move(text), std::move(hint));
}

Error usageError(int code, std::string text, std::string hint) {
    return single(Blame::Usage, code, {}, std::move(text), std::move(hint));
}

Error machineError(int code, std::string text, std::string hint) {
    return single(Blame::Machine, code, {}, std::move(text), std::move(hint));
}

} // namespace tegument
