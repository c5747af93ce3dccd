#include "tools/direct3d/microsoft_messages.h"

#include "host/spirv/scan.h"
#include "host/support/file.h"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace tegument {

namespace fs = std::filesystem;

namespace {

constexpr int kError = 3101;
constexpr int kWarning = 3102;

/// Where the messages come from.
struct Job {
    const fs::path& source;
    const std::vector<fs::path>& folders;
    const Roots& roots;
};

/// The file as the user would name it: like `source`, beside it, or in the first folder that has it.
std::string namedLike(const Job& job, std::string_view written) {
    const fs::path& source = job.source;
    const fs::path path = unixPath(written);
    std::error_code code;
    const fs::path absolute = fs::absolute(source, code).lexically_normal();
    if (path == absolute) return source.string();
    if (path.is_relative()) {
        const fs::path beside = (source.parent_path() / path).lexically_normal();
        for (const fs::path& folder : job.folders)
            if (!fs::exists(beside, code) && fs::exists(folder / path, code)) return (folder / path).lexically_normal().string();
        return beside.string();
    }
    if (source.is_absolute()) return path.string();
    return (source.parent_path() / path.lexically_relative(absolute.parent_path())).lexically_normal().string();
}

SourcePosition readPlace(std::string_view place, const Job& job) {
    SourcePosition at{.file = job.source.string()};
    const std::size_t open = place.rfind('(');
    if (open == std::string_view::npos || !place.ends_with(')')) return at;
    const std::string_view inside = place.substr(open + 1, place.size() - open - 2);
    const std::size_t comma = std::min(inside.find(','), inside.size());
    at.line = std::max(0, wholeNumber(inside.substr(0, comma)).value_or(0));
    if (comma < inside.size()) {
        const std::string_view columns = inside.substr(comma + 1);
        at.column = std::max(0, wholeNumber(columns.substr(0, columns.find('-'))).value_or(0));
    }
    at.file = namedLike(job, place.substr(0, open));
    return at;
}

/// The line itself, where the place points at; Microsoft's compiler does not print it.
std::string quotedLine(const SourcePosition& at, const std::string& text) {
    std::string found;
    int line = 0;
    for (std::string_view rest = text; !rest.empty() && line < at.line;) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        if (++line == at.line) found = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (found.ends_with('\r')) found.pop_back();
    return found;
}

std::string sourceLineAt(const SourcePosition& at) {
    if (at.line == 0) return {};
    const auto text = readFile(at.file);
    return text ? quotedLine(at, *text) : std::string();
}

std::string hintFor(std::string_view text) {
    if (text.find("error initializing the compiler") != std::string_view::npos)
        return "a technique10 or technique11 block stops fx_2_0: keep techniques inside #ifdef FX_TECHNIQUES, written `technique`";
    for (const std::string_view old :
         {"use /Gec", "enable compatibility mode", "not in dx9 compatibility mode", "Illegal character in shader file"})
        if (text.find(old) != std::string_view::npos)
            return "tegument check --gec compiles it as fxc does with /Gec, without a byte order mark";
    return {};
}

void add(Messages& messages, bool error, SourcePosition at, std::string_view text, const Roots& roots) {
    Diagnostic message{.severity = error ? Severity::Error : Severity::Warning,
                       .code = error ? kError : kWarning,
                       .at = std::move(at),
                       .text = std::string(text),
                       .hint = hintFor(text)};
    if (roots.hold(message.at.file)) message.sourceLine = sourceLineAt(message.at);
    (error ? messages.errors : messages.warnings).push_back(std::move(message));
}

struct Kind {
    std::string_view marker;
    bool error;
};

/// Effects are deprecated, every time; and a file's vertex and pixel shaders do without the memory that its compute shaders share.
bool isNoise(std::string_view line) {
    return line.find("X4717") != std::string_view::npos ||
           line.find("does not support groupshared, groupshared ignored") != std::string_view::npos;
}

void readLine(std::string_view line, const Job& job, Messages& into) {
    static constexpr Kind kKinds[] = {{"error ", true}, {"warning ", false}};
    for (const Kind& kind : kKinds) {
        const std::string marker = ": " + std::string(kind.marker);
        const std::size_t separator = line.find(marker);
        if (line.starts_with(kind.marker))
            return add(into, kind.error, {.file = job.source.string()}, line.substr(kind.marker.size()), job.roots);
        if (separator == std::string_view::npos) continue;
        return add(into, kind.error, readPlace(line.substr(0, separator), job), line.substr(separator + marker.size()), job.roots);
    }
    static constexpr Kind kLinkage[] = {{"Stage linkage error: ", true}, {"Stage linkage warning: ", false}};
    for (const Kind& kind : kLinkage)
        if (line.starts_with(kind.marker)) return add(into, kind.error, {.file = job.source.string()}, line, job.roots);
    constexpr std::string_view kEffect = "D3DEffectCompiler: ERROR: ";
    if (line.starts_with(kEffect)) return add(into, true, {.file = job.source.string()}, line.substr(kEffect.size()), job.roots);
    if (line.find("error") == std::string_view::npos) return;
    const std::size_t end = line.find("): "); // "file(3,42-67): There was an error compiling expression"
    if (end == std::string_view::npos) return add(into, true, {.file = job.source.string()}, line, job.roots);
    const SourcePosition at = readPlace(line.substr(0, end + 1), job);
    if (line.find("There was an error compiling expression") == std::string_view::npos || into.errors.empty())
        return add(into, true, at, line.substr(end + 3), job.roots);
    // It only says which `compile` the errors before it came from: the place of those that have none.
    for (Diagnostic& error : into.errors)
        if (error.at.line == 0) error.at = at, error.sourceLine = sourceLineAt(at);
}

} // namespace

Messages readMicrosoftMessages(std::string_view log, const fs::path& source, const std::vector<fs::path>& folders, const Roots& roots) {
    Messages messages;
    forEachLine(log, [&](std::string_view line) {
        if (!isNoise(line)) readLine(line, Job{source, folders, roots}, messages);
    });
    return messages;
}

} // namespace tegument
