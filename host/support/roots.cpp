#include "host/support/roots.h"

#include "host/support/file.h"
#include "host/support/system.h"
#include "host/support/text.h"

#include <algorithm>
#include <array>
#include <cstdint>
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

fs::path commonParent(const fs::path& a, const fs::path& b) {
    fs::path folder;
    for (auto [i, j] = std::pair(a.begin(), b.begin()); i != a.end() && j != b.end() && *i == *j; ++i, ++j)
        folder /= *i;
    return folder;
}

/// The folder that both lie below, where it can be a project; else empty.
fs::path sharedFolder(const fs::path& file, const fs::path& other) {
    const fs::path folder = commonParent(resolved(file).parent_path(), resolved(other).parent_path());
    return folder.has_relative_path() && !isHome(folder) ? folder : fs::path();
}

/// Holds what has nothing to do with each other: the home folder and what is above it, the system's folders, that of temporary files.
bool holdsStrangers(const fs::path& folder) {
    std::error_code code;
    const fs::path home = homeFolder();
    return !folder.has_relative_path() || !folder.parent_path().has_relative_path() || folder == resolved(fs::temp_directory_path(code)) ||
           (!home.empty() && isBelow(folder, resolved(home)));
}

/// The texts in double quotes, and in angle brackets behind #include, that can be names of files.
std::vector<std::string> quotedNames(const std::string& text) {
    constexpr std::size_t kLongest = 1000;
    std::vector<std::string> names;
    for (std::size_t at = text.find_first_of("\"<"); at != std::string::npos; at = text.find_first_of("\"<", at)) {
        const std::size_t end = text.find_first_of(text[at] == '<' ? ">\n" : "\"\n", at + 1);
        if (end == std::string::npos) break;
        if (text[end] != '\n' && end - at < kLongest) names.push_back(text.substr(at + 1, end - at - 1));
        at = text[at] == '<' ? at + 1 : end + 1; // annotations hold names in angle brackets
    }
    return names;
}

/// Has the size of a source, and is none of what textures and meshes are stored in.
bool isText(const fs::path& file) {
    constexpr std::uintmax_t kLargest = 1U << 20;
    std::error_code code;
    return fs::file_size(file, code) <= kLargest && !code &&
           std::ranges::none_of(std::array{".png", ".jpg", ".dds", ".tga", ".bmp", ".x"},
                                [&](const char* end) { return equalsIgnoreCase(file.extension().string(), end); });
}

/// The common parent of the effect and of the files that it and its includes name relatively.
fs::path parentOfNamed(const fs::path& effect) {
    constexpr std::size_t kMostFiles = 256;
    fs::path parent = resolved(effect).parent_path();
    std::vector<fs::path> files{resolved(effect)};
    for (std::size_t i = 0; i < files.size() && files.size() < kMostFiles; ++i) {
        std::error_code none;
        if (!fs::is_regular_file(files[i], none)) continue; // a pipe can be read once
        const Result<std::string> text = readFile(files[i]);
        if (!text) continue;
        for (std::string& name : quotedNames(*text)) {
            std::ranges::replace(name, '\\', '/');
            std::error_code code;
            const bool relative = !name.empty() && fs::path(name).is_relative() && name.find('\0') == std::string::npos;
            fs::path written;
            for (const fs::path& folder : {files[i].parent_path(), files.front().parent_path()}) { // as #include looks for it
                if (!relative || fs::is_regular_file(written, code)) break;
                written = (folder / name).lexically_normal();
                if (fs::path(name).has_extension() && !fs::exists(written, code))
                    written = findInAnyCase(folder, name).value_or(written).lexically_normal();
            }
            if (!relative || !fs::is_regular_file(written, code) || resolved(written) != written) continue;
            const fs::path common = commonParent(parent, written.parent_path());
            if (common != parent && holdsStrangers(common)) continue;
            parent = common;
            if (isText(written) && std::ranges::find(files, written) == files.end()) files.push_back(written);
        }
    }
    return parent;
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
    Roots roots{.anywhere = more.anywhere};
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

Roots rootsOfEffect(const fs::path& file, const std::vector<fs::path>& named, const Roots& more) {
    Roots roots = rootsOf(file, named, more);
    if (roots.anywhere || !more.folders.empty() || !projectOf(resolved(file).parent_path()).empty()) return roots;
    std::error_code code;
    add(roots.folders, parentOfNamed(file));
    const fs::path here = resolved(fs::current_path(code));
    if (!code && !holdsStrangers(here) && isBelow(here, resolved(file))) add(roots.folders, here);
    return roots;
}

std::optional<fs::path> folderOfInclude(const std::string& name, const fs::path& effect, const Roots& roots) {
    constexpr int kLevels = 3;
    constexpr int kMostFiles = 8000;
    fs::path above = resolved(effect).parent_path();
    std::vector<fs::path> tops{above}; // the nearest first
    for (int i = 0; i < kLevels && !holdsStrangers(above.parent_path()); ++i)
        add(tops, above = above.parent_path());
    for (const fs::path& folder : roots.folders)
        add(tops, folder);
    std::string written = name;
    std::ranges::replace(written, '\\', '/');
    const fs::path wanted = fs::path(written).lexically_normal();
    int left = kMostFiles;
    for (const fs::path& top : tops) {
        std::error_code code;
        if (holdsStrangers(top)) continue;
        for (fs::recursive_directory_iterator entry(top, fs::directory_options::skip_permission_denied, code), end;
             !code && entry != end && left > 0; entry.increment(code), --left) {
            const fs::path& path = entry->path();
            if (path.filename().string().starts_with('.')) {
                entry.disable_recursion_pending();
                continue;
            }
            if (!equalsIgnoreCase(path.filename().string(), wanted.filename().string()) || !entry->is_regular_file(code)) continue;
            fs::path folder = path;
            bool same = true;
            for (fs::path part = wanted; same && part.has_filename(); part = part.parent_path(), folder = folder.parent_path())
                same = equalsIgnoreCase(folder.filename().string(), part.filename().string());
            if (same) return folder;
        }
    }
    return std::nullopt;
}

Diagnostic outsideOf(const fs::path& file, SourcePosition at) {
    const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
    return {.severity = Severity::Error,
            .code = 1014,
            .at = std::move(at),
            .text = fmt::format("{} lies outside of the effect's folder and its project", file.string()),
            .hint = fmt::format("if it may be read: -I {}, or --anywhere", shellWord(folder))};
}

Diagnostic outsideOfMesh(const fs::path& file, const fs::path& mesh) {
    const fs::path shared = sharedFolder(file, mesh);
    return {.severity = Severity::Error,
            .code = 1014,
            .at = {.file = mesh.string()},
            .text = fmt::format("{} lies outside of the mesh's folder and its project", file.string()),
            .hint = shared.empty() ? "if it may be read, put it below the mesh's folder"
                                   : fmt::format("if it may be read: touch {}, and that folder is one project",
                                                 shellWord((shared / ".tegument-root").string()))};
}

} // namespace tegument
