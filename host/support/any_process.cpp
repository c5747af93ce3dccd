// What process.h offers and no system does differently.

#include "host/support/process.h"
#include "host/support/system.h"

#include <utility>

namespace tegument {

namespace fs = std::filesystem;

std::optional<fs::path> folderAboveProgramWith(const fs::path& named) {
    std::error_code code;
    if (named.empty()) return std::nullopt;
    for (fs::path folder = programFile().parent_path(); folder.has_relative_path(); folder = folder.parent_path())
        if (fs::exists(folder / named, code)) return folder;
    return std::nullopt;
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
