#include "host/support/kept_inputs.h"

#include "host/support/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

namespace tegument {

namespace fs = std::filesystem;

namespace {

/// Absolute paths: the working directory may change, and files may be replaced while the process runs.
struct Noted {
    std::mutex mutex;
    std::set<fs::path> read;
    std::set<fs::path> promised; // outputs to come
    std::set<fs::path> written;
    std::optional<Error> refused; // the first
};

std::atomic<bool> isKept = false;

Noted& noted() {
    static Noted all;
    return all;
}

fs::path fullName(const fs::path& path) {
    std::error_code code;
    const fs::path full = fs::absolute(path, code);
    return code ? path : full.lexically_normal();
}

bool liesBelow(const fs::path& path, const fs::path& folder) {
    return std::ranges::mismatch(folder, path).in1 == folder.end();
}

/// What lies in the cache is made anew at any time; the system's tables are no files.
bool isOwn(const fs::path& full) {
    return liesBelow(full, fullName(cacheFolder())) || liesBelow(full, "/proc") || liesBelow(full, "/sys");
}

/// The one of these that is the same file, which exists and is a regular one; none otherwise.
const fs::path* sameAmong(const std::set<fs::path>& all, const fs::path& path) {
    std::error_code code;
    if (!fs::is_regular_file(path, code)) return nullptr;
    const auto same = std::ranges::find_if(all, [&](const fs::path& one) {
        std::error_code failed;
        return fs::equivalent(one, path, failed);
    });
    return same == all.end() ? nullptr : &*same;
}

Error wouldReplace(const fs::path& output, const fs::path& input) {
    const std::string same = fullName(output) == input ? std::string() : fmt::format(", which is {}", input.string());
    return usageError(5004, fmt::format("{}{} is read by this command, and would be replaced by what it writes", output.string(), same),
                      "name another file for the output");
}

} // namespace

KeptInputs::KeptInputs() {
    isKept = true;
}

KeptInputs::~KeptInputs() {
    isKept = false;
    const std::scoped_lock lock(noted().mutex);
    if (const char* list = std::getenv(kFilesUsedVariable)) {
        std::ofstream out(list, std::ios::binary | std::ios::app);
        for (const auto& [kind, files] : {std::pair{'r', &noted().read}, {'w', &noted().written}})
            for (const fs::path& file : *files)
                out << kind << file.string() << '\0';
    }
    noted().refused.reset();
    for (std::set<fs::path>* files : {&noted().read, &noted().promised, &noted().written})
        files->clear();
}

Result<void> willWrite(const fs::path& path) {
    auto can = canWrite(path);
    if (can && isKept) {
        const std::scoped_lock lock(noted().mutex);
        noted().promised.insert(fullName(path));
    }
    return can;
}

Result<void> inputsAreKept() {
    const std::scoped_lock lock(noted().mutex);
    return noted().refused ? Result<void>(*noted().refused) : Result<void>();
}

Result<void> holdsNoInput(const fs::path& folder) {
    if (!isKept) return {};
    std::error_code code;
    const fs::path root = fs::canonical(folder, code);
    if (code) return {};
    const std::scoped_lock lock(noted().mutex);
    for (const fs::path& input : noted().read) {
        const fs::path own = fs::canonical(input, code);
        if (!code && liesBelow(own, root)) return wouldReplace(folder, input);
    }
    return {};
}

FilesUsed filesUsed(const fs::path& list) {
    FilesUsed used;
    std::ifstream in(list, std::ios::binary);
    for (std::string line; std::getline(in, line, '\0');) {
        const fs::path file = line.substr(std::min<std::size_t>(line.size(), 1));
        std::error_code code;
        if (fs::is_regular_file(file, code)) (line.front() == 'w' ? used.written : used.read).push_back(file);
    }
    return used;
}

namespace kept {

Result<void> noteRead(const fs::path& path) {
    if (!isKept) return {};
    const fs::path full = fullName(path);
    const std::scoped_lock lock(noted().mutex);
    if (noted().written.contains(full)) return {};
    if (!isOwn(full)) noted().read.insert(full);
    if (!sameAmong(noted().promised, path)) return {};
    if (!noted().refused) noted().refused = wouldReplace(path, full);
    return *noted().refused;
}

Result<void> mayWrite(const fs::path& path) {
    if (!isKept) return {};
    const std::scoped_lock lock(noted().mutex);
    const fs::path* input = sameAmong(noted().read, path);
    return input ? Result<void>(wouldReplace(path, *input)) : Result<void>();
}

void noteWritten(const fs::path& path) {
    if (!isKept) return;
    const fs::path full = fullName(path);
    const std::scoped_lock lock(noted().mutex);
    noted().promised.erase(full);
    noted().read.erase(full);
    if (!isOwn(full)) noted().written.insert(full);
}

} // namespace kept

} // namespace tegument
