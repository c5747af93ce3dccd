#include "tools/view/watch.h"

namespace tegument::view {

namespace fs = std::filesystem;

FileWatch::Stamp FileWatch::stampOf(const fs::path& file) {
    std::error_code failed;
    Stamp stamp;
    stamp.time = fs::last_write_time(file, failed);
    if (failed) return {};
    stamp.there = true;
    if (fs::is_regular_file(file, failed)) stamp.size = fs::file_size(file, failed);
    return stamp;
}

void FileWatch::watch(const std::vector<fs::path>& files) {
    std::map<fs::path, Stamp> stamps;
    for (const fs::path& file : files) {
        const auto known = stamps_.find(file);
        stamps.emplace(file, known == stamps_.end() ? stampOf(file) : known->second);
    }
    stamps_ = std::move(stamps);
}

bool FileWatch::changed() {
    bool any = false;
    for (auto& [file, stamp] : stamps_) {
        const Stamp now = stampOf(file);
        any = any || now != stamp;
        stamp = now;
    }
    return any;
}

} // namespace tegument::view
