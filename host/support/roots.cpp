#include "host/support/roots.h"

#include "host/support/system.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace tegument {

namespace fs = std::filesystem;

namespace {

/// Without links, `.` and `..`; empty where that cannot be said.
fs::path resolved(const fs::path& path) {
    std::error_code code;
    fs::path result = fs::weakly_canonical(path.empty() ? fs::path(".") : path, code);
    return code ? fs::path() : result;
}

bool isBelow(const fs::path& folder, const fs::path& file) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end(), sameName).first == folder.end();
}

/// A repository of everything that a user has is no project.
bool isHome(const fs::path& folder) {
    const fs::path home = homeFolder();
    return !home.empty() && folder == resolved(home);
}

using Markers = std::vector<const char*>;

/// The nearest folder, from this one upwards, that holds one of these.
std::optional<fs::path> nearestWith(fs::path folder, const Markers& markers) {
    std::error_code code;
    for (; folder.has_relative_path(); folder = folder.parent_path())
        for (const char* marker : markers)
            if (fs::exists(folder / marker, code)) return folder;
    return std::nullopt;
}

/// Somebody's own word first, then a repository; empty: none.
fs::path projectOf(const fs::path& folder) {
    for (const Markers& markers : {Markers{".tegument-root"}, Markers{".git", ".hg", ".svn"}})
        if (const auto project = nearestWith(folder, markers); project && !isHome(*project)) return *project;
    return {};
}

/// The folder that both lie below, where it can be a project; else empty.
fs::path sharedFolder(const fs::path& file, const fs::path& other) {
    fs::path folder;
    const fs::path a = resolved(file).parent_path();
    const fs::path b = resolved(other).parent_path();
    for (auto [i, j] = std::pair(a.begin(), b.begin()); i != a.end() && j != b.end() && *i == *j; ++i, ++j)
        folder /= *i;
    return folder.has_relative_path() && !isHome(folder) ? folder : fs::path();
}

/// A shell takes it as one word.
bool isPlain(std::string_view word) {
    return std::ranges::all_of(word, [](unsigned char c) {
        return c > ' ' && std::string_view("'\"\\$`&|;<>()*?[]#~!").find(static_cast<char>(c)) == std::string_view::npos;
    });
}

std::string asWord(const std::string& text) {
    return isPlain(text) ? text : fmt::format("\"{}\"", text);
}

void add(std::vector<fs::path>& folders, const fs::path& folder) {
    if (!folder.empty() && std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
}

} // namespace

bool Roots::hold(const fs::path& file) const {
    if (anywhere) return true;
    const fs::path place = resolved(file);
    return !place.empty() && std::ranges::any_of(folders, [&](const fs::path& folder) { return isBelow(folder, place); });
}

Roots rootsOf(const fs::path& file, const std::vector<fs::path>& named, const Roots& more) {
    Roots roots{.folders = {}, .anywhere = more.anywhere};
    if (roots.anywhere) return roots;
    for (const fs::path& folder : {resolved(file.parent_path()), resolved(file).parent_path()}) {
        add(roots.folders, folder);
        add(roots.folders, projectOf(folder));
        if (const auto library = nearestWith(folder, {"hlsl/platform.fxh"})) add(roots.folders, *library);
    }
    for (const auto* folders : {&named, &more.folders})
        for (const fs::path& folder : *folders)
            add(roots.folders, resolved(folder));
    return roots;
}

Diagnostic outsideOf(const fs::path& file, SourcePosition at) {
    const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
    return {.severity = Severity::Error,
            .code = 1014,
            .at = std::move(at),
            .text = fmt::format("{} lies outside of the effect's folder and its project", file.string()),
            .hint = fmt::format("if it may be read: -I {}, or --anywhere", asWord(folder)),
            .sourceLine = {}};
}

Diagnostic outsideOfMesh(const fs::path& file, const fs::path& mesh) {
    const fs::path shared = sharedFolder(file, mesh);
    return {.severity = Severity::Error,
            .code = 1014,
            .at = {.file = mesh.string(), .byte = {}},
            .text = fmt::format("{} lies outside of the mesh's folder and its project", file.string()),
            .hint = shared.empty() ? "if it may be read, put it below the mesh's folder"
                                   : fmt::format("if it may be read: touch {}, and that folder is one project",
                                                 asWord((shared / ".tegument-root").string())),
            .sourceLine = {}};
}

} // namespace tegument
