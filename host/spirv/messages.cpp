#include "host/spirv/messages.h"

#include "host/spirv/scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <tuple>

namespace tegument {

namespace {

constexpr int kCompilerError = 3001;
constexpr int kCompilerWarning = 3007;

/// Takes `:123` off the end.
std::optional<int> takeTrailingNumber(std::string_view& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos) return {};
    const auto value = wholeNumber(text.substr(colon + 1));
    if (value) text = text.substr(0, colon);
    return value;
}

void add(Messages& messages, bool error, SourcePosition at, std::string_view text, std::string line) {
    (error ? messages.errors : messages.warnings)
        .push_back({.severity = error ? Severity::Error : Severity::Warning,
                    .code = error ? kCompilerError : kCompilerWarning,
                    .at = std::move(at),
                    .text = std::string(text),
                    .sourceLine = std::move(line)});
}

struct LineDirective {
    int line = 1;
    std::string_view file; // empty: not said
};

/// Of a line without blanks around it.
std::optional<LineDirective> lineDirective(std::string_view text) {
    if (!text.starts_with("#line ")) return std::nullopt;
    const std::string_view rest = trim(text.substr(6));
    const std::size_t quote = rest.find('"');
    LineDirective directive{.line = wholeNumber(trim(rest.substr(0, quote))).value_or(1)};
    if (quote != std::string_view::npos) directive.file = rest.substr(quote + 1, rest.rfind('"') - quote - 1);
    return directive;
}

struct Kind {
    std::string_view marker;
    bool error;
};

/// Default values of parameters are the host's work (it uploads them), and techniques are not for this compiler.
bool isNoise(std::string_view text) {
    return text.ends_with("initializer ignored") || text.find("effect object ignored") != std::string_view::npos ||
           text.find("effect state block ignored") != std::string_view::npos;
}

/// Column of `token` in `line` as a whole word, else of the first letter.
int columnOf(std::string_view line, std::string_view token) {
    const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = token.empty() ? std::string_view::npos : line.find(token); at != std::string_view::npos;
         at = line.find(token, at + 1)) {
        const bool before = at == 0 || !isWord(line[at - 1]) || !isWord(token.front());
        const bool after = at + token.size() >= line.size() || !isWord(line[at + token.size()]) || !isWord(token.back());
        if (before && after) return static_cast<int>(at) + 1;
    }
    const std::size_t first = line.find_first_not_of(" \t");
    return first == std::string_view::npos ? 1 : static_cast<int>(first) + 1;
}

/// glslang's `'token' : text` as `text: 'token'`.
std::string glslangText(std::string_view raw, std::string_view token) {
    const std::size_t separator = raw.find(" : ");
    if (separator == std::string_view::npos || !raw.starts_with('\'')) return std::string(raw);
    const std::string_view text = trim(raw.substr(separator + 3));
    return token.empty() ? std::string(text) : fmt::format("{} '{}'", text, token);
}

void readGlslangLine(std::string_view line, bool error, std::string_view code, const std::string& file, Messages& into) {
    const std::size_t separator = line.find(": ");
    std::string_view place = separator == std::string_view::npos ? std::string_view() : line.substr(0, separator);
    const auto lineNumber = takeTrailingNumber(place);
    if (!lineNumber) return add(into, error, {.file = file}, line, {});
    const std::string_view raw = trim(line.substr(separator + 2));
    const std::size_t quote = raw.starts_with('\'') ? raw.find('\'', 1) : std::string_view::npos;
    const std::string_view token = quote == std::string_view::npos ? std::string_view() : raw.substr(1, quote - 1);
    // What glslang says next of a line that it has refused already follows from that.
    const auto sameLine = [&](const Diagnostic& other) { return other.at.line == *lineNumber && other.at.file == place; };
    if (error && std::ranges::any_of(into.errors, sameLine)) return;
    std::string source = sourceLine(code, place, *lineNumber);
    const int column = columnOf(source, token);
    add(into, error, {.file = std::string(place), .line = *lineNumber, .column = column}, glslangText(raw, token), std::move(source));
}

} // namespace

SourcePosition lastLineDirective(std::string_view code, const std::string& file) {
    SourcePosition at{.file = file};
    forEachLine(code, [&](std::string_view text) {
        const auto directive = lineDirective(text);
        if (!directive || directive->file.empty()) return;
        at.file = directive->file;
        at.line = directive->line;
    });
    return at;
}

std::string sourceLine(std::string_view code, std::string_view file, int line) {
    std::string_view current;
    int next = 1;
    std::string found;
    while (!code.empty()) {
        const std::size_t end = std::min(code.find('\n'), code.size());
        const std::string_view text = code.substr(0, end);
        code.remove_prefix(std::min(end + 1, code.size()));
        const std::string_view trimmed = trim(text);
        if (const auto directive = lineDirective(trimmed)) {
            next = directive->line;
            if (!directive->file.empty()) current = directive->file;
            continue;
        }
        if (next++ == line && current == file && !trimmed.empty()) found = text;
        if (!found.empty()) return found;
    }
    return found;
}

Messages readDxcMessages(std::string_view log, std::string_view code, const std::string& file) {
    static constexpr Kind kKinds[] = {{": fatal error: ", true}, {": error: ", true}, {": warning: ", false}};
    Messages messages;
    forEachLine(log, [&](std::string_view line) {
        for (const Kind& kind : kKinds) {
            const std::size_t separator = line.find(kind.marker);
            if (separator == std::string_view::npos) continue;
            std::string_view place = line.substr(0, separator);
            const std::string_view text = line.substr(separator + kind.marker.size());
            const int column = takeTrailingNumber(place).value_or(0);
            const int lineNumber = takeTrailingNumber(place).value_or(0);
            if (!isNoise(text))
                add(messages, kind.error, {.file = std::string(place), .line = lineNumber, .column = column}, text,
                    sourceLine(code, place, lineNumber));
            return;
        }
        if (line.starts_with("error: ") || line.starts_with("fatal error: "))
            add(messages, true, {.file = file}, line.substr(line.find(": ") + 2), {});
    });
    return messages;
}

Messages readGlslangMessages(std::string_view log, std::string_view code, const std::string& file) {
    Messages messages;
    forEachLine(log, [&](std::string_view line) {
        const bool error = line.starts_with("ERROR: ");
        if (!error && !line.starts_with("WARNING: ")) return;
        line.remove_prefix(error ? 7 : 9);
        if (line.find("compilation errors.  No code generated") == std::string_view::npos)
            readGlslangLine(line, error, code, file, messages);
    });
    return messages;
}

std::vector<Diagnostic> shortened(std::vector<Diagnostic> messages) {
    std::set<std::tuple<std::string, int, int, std::string>> seen;
    std::vector<Diagnostic> kept;
    std::size_t more = 0;
    for (Diagnostic& message : messages) {
        if (!seen.emplace(message.at.file, message.at.line, message.at.column, message.text).second) continue;
        if (kept.size() < kShownMessages)
            kept.push_back(std::move(message));
        else
            ++more;
    }
    if (more == 0) return kept;
    kept.push_back({.severity = Severity::Note,
                    .code = kept.front().code,
                    .at = {.file = kept.front().at.file},
                    .text = fmt::format("and {} more", more)});
    return kept;
}

} // namespace tegument
