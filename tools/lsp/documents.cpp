#include "tools/lsp/documents.h"

#include "host/support/file.h"
#include "tools/lsp/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace tegument::lsp {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kScheme = "file://";

/// Bytes of the character that begins with this one, and its 16-bit units. A byte that begins none counts as one of each.
std::pair<int, int> lengths(char first) {
    const auto byte = static_cast<unsigned char>(first);
    if (byte >= 0xF0 && byte < 0xF8) return {4, 2};
    if (byte >= 0xE0 && byte < 0xF0) return {3, 1};
    if (byte >= 0xC0 && byte < 0xE0) return {2, 1};
    return {1, 1};
}

bool isPlain(char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
           std::string_view("-._~/").find(letter) != std::string_view::npos;
}

} // namespace

std::string pathOf(const std::string& uri) {
    if (!uri.starts_with(kScheme)) return {};
    std::string path;
    for (std::size_t i = kScheme.size(); i < uri.size(); ++i) {
        int code = 0;
        const char* const first = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(first, first + 2, code, 16).ptr == first + 2) {
            path += static_cast<char>(code);
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path.starts_with('/') && path.find('\0') == std::string::npos ? normal(path) : std::string();
}

std::string uriOf(const std::string& path) {
    std::string uri(kScheme);
    for (const char letter : path)
        uri += isPlain(letter) ? std::string(1, letter) : fmt::format("%{:02X}", static_cast<unsigned char>(letter));
    return uri;
}

std::string normal(const fs::path& path) {
    std::error_code code;
    const fs::path absolute = fs::absolute(path, code);
    return (code ? path : absolute).lexically_normal().string();
}

int byteColumn(std::string_view line, int units) {
    std::size_t at = 0;
    for (int counted = 0; at < line.size() && counted < units;) {
        const auto [bytes, these] = lengths(line[at]);
        at += static_cast<std::size_t>(bytes);
        counted += these;
    }
    return static_cast<int>(std::min(at, line.size())) + 1;
}

int unitsBefore(std::string_view line, int column) {
    int units = 0;
    for (std::size_t at = 0; at < line.size() && static_cast<int>(at) + 1 < column;) {
        const auto [bytes, these] = lengths(line[at]);
        at += static_cast<std::size_t>(bytes);
        units += these;
    }
    return units;
}

const std::string* Documents::find(const std::string& path) const {
    const auto found = texts_.find(path);
    return found == texts_.end() ? nullptr : &found->second;
}

FileReader Documents::reader(const fs::path& effect, const LoadOptions& options) const {
    return [this, confined = confinedReader(effect, rootsOfEffect(effect, options.includeFolders, options.roots))](
               const fs::path& path) -> Result<std::string> {
        if (const std::string* text = find(normal(path))) return *text;
        return confined(path);
    };
}

std::string Documents::textOf(const std::string& path) const {
    if (const std::string* text = find(path)) return *text;
    const auto text = readFile(path);
    return text ? *text : std::string();
}

Json positionJson(std::string_view text, int line, int column) {
    return {{"line", std::max(line - 1, 0)}, {"character", unitsBefore(lineOf(text, line), column)}};
}

Json rangeJson(std::string_view text, const SourcePosition& at) {
    const std::string_view line = lineOf(text, at.line);
    const int column = std::max(at.column, 1);
    const int length = std::max(1, static_cast<int>(wordAt(line, column).size()));
    return {{"start", positionJson(text, at.line, column)}, {"end", positionJson(text, at.line, column + length)}};
}

Json diagnosticJson(std::string_view text, const Diagnostic& diagnostic) {
    constexpr int kSeverity[] = {3, 2, 1}; // information, warning, error
    return {{"range", rangeJson(text, diagnostic.at)},
            {"severity", kSeverity[static_cast<int>(diagnostic.severity)]},
            {"code", fmt::format("TG{:04}", diagnostic.code)},
            {"source", "tegument"},
            {"message", diagnostic.hint.empty() ? diagnostic.text : diagnostic.text + "; " + diagnostic.hint}};
}

} // namespace tegument::lsp
