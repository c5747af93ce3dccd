#include "host/support/cache.h"

#include "host/support/file.h"

namespace tegument {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHash = 32; // digits of contentHash, which stand before what is kept

} // namespace

CacheKey::CacheKey(std::string_view maker) {
    add(maker);
}

CacheKey& CacheKey::add(std::string_view bytes) {
    all_ += contentHash(bytes); // of one length: parts stay apart
    return *this;
}

std::string CacheKey::text() const {
    return contentHash(all_);
}

std::optional<std::string> loadCached(const fs::path& name) {
    std::error_code code;
    const fs::path path = cacheFolder() / name;
    if (!fs::is_regular_file(path, code)) return {};
    auto bytes = readFile(path);
    if (!bytes || bytes->size() < kHash || contentHash(std::string_view(*bytes).substr(kHash)) != bytes->substr(0, kHash)) return {};
    return bytes->erase(0, kHash);
}

void storeCached(const fs::path& name, std::string_view bytes) {
    if (!writeFile(cacheFolder() / name, contentHash(bytes) + std::string(bytes))) return;
}

} // namespace tegument
