#include "tools/cli/output.h"

#include "host/mesh/read_mesh.h"
#include "host/support/file.h"
#include "host/support/kept_inputs.h"
#include "host/support/text.h"
#include "meshprep/assets/picture.h"
#include "meshprep/groom/groom_file.h"
#include "meshprep/write/write_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace tegument::app {

Json toJson(const Diagnostic& diagnostic) {
    constexpr const char* kSeverity[] = {"note", "warning", "error"};
    Json json{{"severity", kSeverity[static_cast<int>(diagnostic.severity)]}, {"code", fmt::format("TG{:04}", diagnostic.code)}};
    if (!diagnostic.at.file.empty()) json["file"] = diagnostic.at.file;
    if (diagnostic.at.line > 0) json["line"] = diagnostic.at.line;
    if (diagnostic.at.column > 0) json["column"] = diagnostic.at.column;
    if (diagnostic.at.byte) json["byte"] = *diagnostic.at.byte;
    json["text"] = diagnostic.text;
    if (!diagnostic.hint.empty()) json["hint"] = diagnostic.hint;
    return json;
}

Json toJson(const std::vector<Diagnostic>& diagnostics) {
    Json list = Json::array();
    for (const Diagnostic& diagnostic : diagnostics)
        list.push_back(toJson(diagnostic));
    return list;
}

void print(const Json& json) {
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

void say(const std::string& line) {
    std::fputs((line + '\n').c_str(), stderr);
}

namespace {

bool saidThatInputsAreKept = false;

/// What is no mesh may be a groom.
Error withWayOfGrooms(Error error) {
    Diagnostic& first = error.diagnostics.front();
    if (first.code != 5300 && first.code != 5306) return error;
    const std::string file = first.at.file.empty() ? "FILE" : shellWord(first.at.file);
    if (first.code == 5300 && isGroom(first.at.file))
        first.hint = fmt::format("a groom, not a mesh: tegument fur import {} --mesh SKIN -o NEW.glb", file);
    else if (first.code == 5306 && isGroom(first.at.file))
        first.hint += fmt::format("; lines that are strands: tegument fur import {} --mesh SKIN -o NEW.glb", file);
    return error;
}

} // namespace

int fail(const Error& given, bool json) {
    const auto kept = inputsAreKept(); // a reader takes a file that is to be written for one that is not there
    const Error error = withWayOfGrooms(kept ? given : kept.error());
    if (!kept && saidThatInputsAreKept) return static_cast<int>(error.blame);
    saidThatInputsAreKept = saidThatInputsAreKept || !kept;
    if (json) print({{"diagnostics", toJson(error.diagnostics)}});
    say(format(error));
    return static_cast<int>(error.blame);
}

int keepingInputs(int code) {
    const auto kept = inputsAreKept();
    if (kept || saidThatInputsAreKept) return code;
    return code == 0 ? fail(kept.error(), false) : static_cast<int>(kept.error().blame); // a report has said it
}

void warn(const std::vector<Diagnostic>& warnings) {
    for (const Diagnostic& warning : warnings)
        say(format(warning));
}

namespace {

/// Whether the program has written this picture or mesh: each says so near its beginning.
bool isOurs(const std::filesystem::path& path) {
    constexpr std::size_t kBeginning = std::size_t{1} << 20;
    std::string bytes(kBeginning, '\0');
    std::ifstream in(path, std::ios::binary); // not as an input
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes.find("egument") != std::string::npos || bytes.substr(0, 128).find("TGMT") != std::string::npos;
}

/// For kinds of files that carry a mark.
void warnOfForeign(const std::filesystem::path& path) {
    std::error_code code;
    if (!(assets::isPicture(path) || meshWriterOf(path) || isGroom(path)) || !std::filesystem::is_regular_file(path, code) || isOurs(path))
        return;
    Diagnostic diagnostic{.severity = Severity::Warning, .code = 8028};
    diagnostic.text = fmt::format("{} was not written by Tegument, and is to be replaced", path.string());
    diagnostic.hint = "the next release will refuse that without --force";
    warn({diagnostic});
}

} // namespace

Result<void> checkOutput(const std::string& path, const std::vector<std::string>& endings, const std::string& hint) {
    if (path.empty()) return {};
    const std::string ending = toLower(std::filesystem::path(path).extension().string());
    if (!endings.empty() && std::ranges::find(endings, ending) == endings.end())
        return usageError(8024, fmt::format("cannot write {}: its name must end in {}", path, fmt::join(endings, " or ")), hint);
    auto can = willWrite(path);
    if (can) warnOfForeign(path);
    return can;
}

Result<void> checkFolder(const std::string& folder) {
    return canWrite(std::filesystem::path(folder) / ".tegument");
}

std::string counted(std::size_t number, const std::string& what) {
    return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const std::string& cell : header)
        widths.push_back(cell.size());
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());

    const auto line = [&](const std::vector<std::string>& cells) {
        std::string text;
        for (std::size_t i = 0; i < cells.size(); ++i)
            text += i == 0 ? fmt::format("{:<{}}", cells[i], widths[i]) : fmt::format("  {:>{}}", cells[i], widths[i]);
        return text + '\n';
    };
    std::string text = line(header);
    for (const auto& row : rows)
        text += line(row);
    return text;
}

} // namespace tegument::app
