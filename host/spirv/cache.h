#pragma once
// Compiled shaders on disk, by content. A file that is cut short, changed or from another version of this program is a miss, never an
// error.

#include "host/spirv/compile.h"
#include "host/spirv/includes.h"

namespace tegument {

struct CachedShader {
    Shader shader;
    std::vector<IncludedFile> includes;
};

/// The bytes of a cache file: magic, format version, checksum, content.
[[nodiscard]] std::string encodeShader(const CachedShader& cached);
[[nodiscard]] std::optional<CachedShader> decodeShader(std::string_view bytes);

/// The shader stored under this key, if the files that it included are what they were.
[[nodiscard]] std::optional<Shader> loadCachedShader(const std::string& key);
/// A full disk only costs the next run its time: failures are ignored.
void storeCachedShader(const std::string& key, const CachedShader& cached);

} // namespace tegument
