#include "tests/meshprep/scan_files.h"

#include "host/support/file.h"
#include "tools/process/process.h"

#include <cstdlib>

namespace tegument::testing_prep {

namespace fs = std::filesystem;

namespace {

fs::path unpacked(const fs::path& packed, const std::string& name, const std::string& program, const fs::path& folder) {
    const fs::path copy = folder / packed.filename();
    fs::copy_file(packed, copy, fs::copy_options::overwrite_existing);
    fs::permissions(copy, fs::perms::owner_write, fs::perm_options::add);
    const auto done = runProcess({.arguments = {program, "-d", "-f", copy.string()}}, 60);
    return done && done->exitCode == 0 ? folder / name : fs::path();
}

} // namespace

fs::path findScan(const std::string& name, const fs::path& folder) {
    const char* shared = std::getenv("TEGUMENT_SHARED_DATA");
    for (const fs::path& from : {fs::path(shared && *shared ? shared : "../shared/data") / "stanford", cacheFolder() / "data" / "dragon"})
        for (const auto& [ending, program] : {std::pair(".xz", "xz"), std::pair(".gz", "gzip")})
            if (fs::exists(from / (name + ending))) return unpacked(from / (name + ending), name, program, folder);
    return {};
}

} // namespace tegument::testing_prep
