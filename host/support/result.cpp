#include "host/support/result.h"

#include <fmt/format.h>

#include <algorithm>

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

/// Bytes of a well-formed UTF-8 sequence at `at`; 0 where there is none.
std::size_t sequence(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(at);
    const std::size_t length = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    if (length == 0 || at + length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(at + i) & 0xC0U) != 0x80U) return 0;
    return length;
}

/// What a terminal may get: control characters and bytes that are no UTF-8 become question marks, one for each, so that columns stay.
std::string printable(std::string_view text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = sequence(text, at);
        const auto first = static_cast<unsigned char>(text[at]);
        const bool control = length == 1 && (first == 0x7F || (first < ' ' && first != '\t' && first != '\n'));
        if (length == 0 || control)
            result += '?';
        else
            result += text.substr(at, length);
        at += std::max<std::size_t>(length, 1);
    }
    return result;
}

/// Tabs stay tabs under the caret, so that it points at the same column whatever the tab width.
std::string caretLine(const std::string& sourceLine, int column) {
    std::string caret;
    for (int i = 0; i + 1 < column && i < static_cast<int>(sourceLine.size()); ++i)
        caret += sourceLine[static_cast<std::size_t>(i)] == '\t' ? '\t' : ' ';
    return caret + '^';
}

Error single(Blame blame, int code, SourcePosition at, std::string text, std::string hint) {
    return Error{blame, {Diagnostic{.code = code, .at = std::move(at), .text = std::move(text), .hint = std::move(hint)}}};
}

} // namespace

std::string format(const Diagnostic& diagnostic) {
    std::string line = fmt::format("{}{} TG{:04}: {}", place(diagnostic.at), name(diagnostic.severity), diagnostic.code, diagnostic.text);
    if (!diagnostic.hint.empty()) line += "; " + diagnostic.hint;
    line = printable(line);
    if (diagnostic.sourceLine.empty() || diagnostic.at.column == 0) return line;
    return fmt::format("{}\n    {}\n    {}", line, printable(diagnostic.sourceLine),
                       caretLine(diagnostic.sourceLine, diagnostic.at.column));
}

std::string format(const Error& error) {
    std::string text;
    for (const Diagnostic& diagnostic : error.diagnostics) {
        if (!text.empty()) text += '\n';
        text += format(diagnostic);
    }
    return text;
}

Diagnostic inputWarning(int code, SourcePosition at, std::string text, std::string hint) {
    return {.severity = Severity::Warning, .code = code, .at = std::move(at), .text = std::move(text), .hint = std::move(hint)};
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
