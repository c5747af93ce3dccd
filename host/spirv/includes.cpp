#include "host/spirv/includes.h"

#include "host/support/file.h"

#include <algorithm>
#include <system_error>

namespace tegument {

namespace fs = std::filesystem;

IncludeReader::IncludeReader(const std::string& file, const std::vector<fs::path>& folders)
    : folders_{fs::path(file).parent_path()}, roots_(rootsOf(file, folders)) {
    folders_.insert(folders_.end(), folders.begin(), folders.end());
}

std::optional<IncludeReader::Found> IncludeReader::open(const fs::path& name) {
    for (const fs::path& folder : folders_)
        if (auto found = read(folder / name, name.string())) return found;
    return {};
}

std::optional<IncludeReader::Found> IncludeReader::openFrom(const fs::path& includer, const fs::path& name) {
    if (auto found = read(includer.parent_path() / name, name.string())) return found;
    return open(name);
}

std::optional<IncludeReader::Found> IncludeReader::read(const fs::path& path, const std::string& asked) {
    std::error_code code;
    if (!fs::is_regular_file(path, code) || !roots_.hold(path)) return {};
    const std::string normal = path.lexically_normal().string();
    auto text = readFile(normal);
    if (!text) {
        if (!unread_) unread_ = text.error();
        return {};
    }
    asked_[asked] = normal;
    if (std::ranges::find(files_, normal, &IncludedFile::path) == files_.end()) files_.push_back({normal, contentHash(*text)});
    return Found{normal, std::move(*text)};
}

std::string IncludeReader::pathOf(const std::string& asked) const {
    const auto found = asked_.find(asked);
    return found == asked_.end() ? asked : found->second;
}

} // namespace tegument
