#include "host/support/temporary.h"

#include "host/support/file.h"
#include "host/support/kept_inputs.h"

#include <mutex>
#include <set>

namespace tegument {

namespace fs = std::filesystem;

namespace {

struct Known {
    std::recursive_mutex mutex; // a file that is put back is written by way of a temporary one
    std::multiset<fs::path> paths;
    std::set<const Borrowed*> borrowed;
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

Borrowed::Borrowed(fs::path path, std::string content) : path_(std::move(path)), content_(std::move(content)) {
    const std::scoped_lock lock(known().mutex);
    known().borrowed.insert(this);
}

Borrowed::~Borrowed() {
    const std::scoped_lock lock(known().mutex);
    known().borrowed.erase(this);
    putBack();
}

Result<void> Borrowed::change(std::string_view bytes) const {
    const std::scoped_lock lock(known().mutex);
    return rewriteFile(path_, bytes);
}

void Borrowed::putBack() const {
    if (const auto now = readFile(path_); !now || *now != content_) (void)rewriteFile(path_, content_); // nobody is there to hear of it
}

void removeTemporaries() {
    known().mutex.lock(); // and never unlocked: what the others would do comes too late
    for (const fs::path& path : known().paths)
        removeWhole(path);
    for (const Borrowed* file : known().borrowed)
        file->putBack();
}

} // namespace tegument
