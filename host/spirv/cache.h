#pragma once
// Compiled shaders on disk, by content. What cannot be read is a miss, never an error.

#include "host/spirv/compile.h"
#include "host/spirv/includes.h"

namespace tegument {

struct CachedShader {
    Shader shader;
    std::vector<IncludedFile> includes;
};

/// Part of every key: take another number with every change of a struct that is kept.
inline constexpr std::string_view kShaderFormat = "shader 2";

[[nodiscard]] std::string encodeShader(const CachedShader& cached);
[[nodiscard]] std::optional<CachedShader> decodeShader(std::string_view bytes);

/// The shader stored under this key, if the files that it included are what they were.
[[nodiscard]] std::optional<Shader> loadCachedShader(const std::string& key);
void storeCachedShader(const std::string& key, const CachedShader& cached);

} // namespace tegument
