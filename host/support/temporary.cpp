#include "host/support/temporary.h"

#include <mutex>
#include <set>

namespace tegument {

namespace fs = std::filesystem;

namespace {

struct Known {
    std::mutex mutex;
    std::multiset<fs::path> paths;
};

/// Never destroyed: threads may still be at work while the program ends.
Known& known() {
    static auto* const kKnown = new Known;
    return *kKnown;
}

void removeWhole(const fs::path& path) {
    std::error_code code;
    if (!path.empty()) fs::remove_all(path, code);
}

} // namespace

Temporary::Temporary(fs::path path) : path_(std::move(path)) {
    const std::scoped_lock lock(known().mutex);
    known().paths.insert(path_);
}

Temporary::~Temporary() {
    const std::scoped_lock lock(known().mutex);
    known().paths.erase(known().paths.find(path_));
    removeWhole(path_);
}

void removeTemporaries() {
    known().mutex.lock(); // and never unlocked: what the others would do comes too late
    for (const fs::path& path : known().paths)
        removeWhole(path);
}

} // namespace tegument
