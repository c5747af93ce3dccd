#include "host/support/roots.h"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
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
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// A repository of everything that a user has is no project.
bool isHome(const fs::path& folder) {
    const char* home = std::getenv("HOME");
    return home != nullptr && *home != '\0' && folder == resolved(home);
}

/// The nearest folder, from this one upwards, that holds one of these.
std::optional<fs::path> nearestWith(fs::path folder, std::initializer_list<const char*> markers) {
    std::error_code code;
    for (; folder.has_relative_path(); folder = folder.parent_path())
        for (const char* marker : markers)
            if (fs::exists(folder / marker, code)) return folder;
    return std::nullopt;
}

/// A shell takes it as one word.
bool isPlain(std::string_view word) {
    return std::ranges::all_of(word, [](unsigned char c) {
        return c > ' ' && std::string_view("'\"\\$`&|;<>()*?[]#~!").find(static_cast<char>(c)) == std::string_view::npos;
    });
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
        if (const auto project = nearestWith(folder, {".git", ".hg", ".svn", ".tegument-root"}); project && !isHome(*project))
            add(roots.folders, *project);
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
            .hint = fmt::format("if it may be read: -I {}, or --anywhere", isPlain(folder) ? folder : fmt::format("\"{}\"", folder)),
            .sourceLine = {}};
}

} // namespace tegument
