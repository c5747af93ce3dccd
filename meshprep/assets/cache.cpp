#include "meshprep/assets/cache.h"

#include "host/image/dds.h"
#include "host/support/file.h"

#include <fmt/format.h>

#include <chrono>

namespace tegument::assets {

Result<std::filesystem::path> cachedDds(const std::string& folder, const std::string& name, const std::string& what, const Say& say,
                                        const std::function<Result<void>(const std::filesystem::path&)>& make) {
    const std::filesystem::path file = cacheFolder() / folder / "made" / (name + ".dds");
    if (isWholeDds(file)) return file;
    const auto start = std::chrono::steady_clock::now();
    if (const auto made = make(file); !made) return made.error();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (say) say(fmt::format("made {} in {:.1f} s: {}", what, seconds, file.string()));
    return file;
}

} // namespace tegument::assets
