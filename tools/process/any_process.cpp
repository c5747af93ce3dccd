// What process.h offers and no system does differently.

#include "tools/process/any_process.h"

#include "tools/process/process.h"

#include <algorithm>
#include <utility>

namespace tegument {

namespace fs = std::filesystem;

std::optional<fs::path> findInFolders(NativeView folders, fs::path::value_type separator, const fs::path& name,
                                      const std::function<std::optional<fs::path>(const fs::path&)>& asProgram) {
    while (!folders.empty()) {
        const std::size_t end = std::min(folders.find(separator), folders.size());
        if (auto found = asProgram(fs::path(folders.substr(0, end)) / name)) return found;
        folders.remove_prefix(std::min(end + 1, folders.size()));
    }
    return std::nullopt;
}

std::optional<std::string> takeLine(std::string& text) {
    const std::size_t length = text.find('\n');
    if (length == std::string::npos) return std::nullopt;
    std::string line = text.substr(0, length);
    text.erase(0, length + 1);
    return line;
}

BackgroundProcess::BackgroundProcess(BackgroundProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)), output_(std::exchange(other.output_, -1)), pending_(std::move(other.pending_)) {}

BackgroundProcess& BackgroundProcess::operator=(BackgroundProcess&& other) noexcept {
    if (this != &other) {
        stop();
        id_ = std::exchange(other.id_, -1);
        output_ = std::exchange(other.output_, -1);
        pending_ = std::move(other.pending_);
    }
    return *this;
}

BackgroundProcess::~BackgroundProcess() {
    stop();
}

} // namespace tegument
