#include "tools/view/file_dialog.h"

#include "host/mesh/read_mesh.h"
#include "host/support/text.h"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <string_view>

namespace tegument::view {

namespace fs = std::filesystem;

namespace {

struct Kind {
    const char* title;
    std::vector<std::string_view> endings; // of files; the first is given to a new one
};

std::vector<std::string_view> meshes() {
    std::vector<std::string_view> endings;
    for (const MeshFormat& format : meshFormats())
        endings.push_back(format.extension);
    return endings;
}

const Kind& kindOf(FileUse use) {
    static const std::vector<Kind> kKinds = {
        {"", {}},
        {"Open mesh", meshes()},
        {"Open effect", {".fx"}},
        {"Open workspace", {".json"}},
        {"Open surroundings", {".dds", ".hdr", ".exr"}},
        {"Save picture", {".png"}},
        {"Save workspace", {".json"}},
    };
    return kKinds[static_cast<std::size_t>(use)];
}

fs::path typedPath(const fs::path& folder, const std::string& typed) {
    const char* home = std::getenv("HOME");
    if (home && (typed == "~" || typed.starts_with("~/"))) return fs::path(home) / typed.substr(std::min<std::size_t>(2, typed.size()));
    return (folder / typed).lexically_normal(); // what is absolute stays so
}

} // namespace

void FileDialog::open(FileUse what, const fs::path& near) {
    std::error_code failed;
    *this = {.use = what, .folder = {}, .typed = {}, .all = all, .entries = {}, .problem = {}, .replaced = {}};
    folder = fs::absolute(near.empty() ? fs::path(".") : near, failed).lexically_normal();
    while (!fs::is_directory(folder, failed) && folder.has_relative_path())
        folder = folder.parent_path();
    list();
}

const char* FileDialog::title() const {
    return kindOf(use).title;
}

std::string FileDialog::filter() const {
    std::string text;
    for (const std::string_view ending : kindOf(use).endings)
        text += (text.empty() ? "*" : " *") + std::string(ending);
    return text;
}

void FileDialog::list() {
    entries.clear();
    std::error_code failed;
    const auto& endings = kindOf(use).endings;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        std::error_code none;
        const std::string name = at->path().filename().string();
        const bool isFolder = at->is_directory(none);
        const bool wanted = isFolder || all || std::ranges::find(endings, toLower(at->path().extension().string())) != endings.end();
        if (wanted && !name.starts_with('.')) entries.push_back({name, isFolder});
    }
    problem = failed ? "cannot be read: " + failed.message() : std::string();
    std::ranges::sort(entries, [](const Entry& a, const Entry& b) { return a.folder != b.folder ? a.folder : a.name < b.name; });
}

fs::path FileDialog::choose() {
    fs::path path = typedPath(folder, typed);
    std::error_code failed;
    problem.clear();
    if (typed.empty() || fs::is_directory(path, failed)) {
        folder = path.has_filename() || !path.has_relative_path() ? path : path.parent_path();
        typed.clear();
        list();
        return {};
    }
    if (saves() && !path.has_extension()) path += kindOf(use).endings.front();
    const bool there = fs::exists(path, failed);
    if (!saves() && !there) {
        problem = "there is no such file";
        return {};
    }
    if (saves() && !fs::is_directory(path.parent_path(), failed)) {
        problem = "there is no such folder";
        return {};
    }
    if (saves() && there && replaced != path) {
        problem = path.filename().string() + " is there already: once more replaces it";
        replaced = path;
        return {};
    }
    return path;
}

} // namespace tegument::view
