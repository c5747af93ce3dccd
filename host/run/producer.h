#pragma once
// Textures that another effect renders (annotation Producer), cached on disk by the content that went into them.

#include "host/run/prepare.h"
#include "host/run/texture_source.h"

#include <filesystem>
#include <string>

namespace tegument::run {

/// Runs the producing effect with the same definitions, mesh, workspace and those settings that it knows, or reads what an earlier run left
/// in the cache; a damaged cache file is rendered again. TG4035 circle, TG4036 the effect does not draw that target.
[[nodiscard]] Result<TextureData> produceTexture(const RunInput& input, const Parameter& parameter, const ProducerSource& source,
                                                 std::vector<Diagnostic>& warnings);

/// Names what `prepared` draws into `target`: sources, definitions, compiler, device, values, textures, mesh.
[[nodiscard]] Result<std::string> productKey(const RunInput& input, const Prepared& prepared, const std::string& target);
[[nodiscard]] std::filesystem::path productPath(const std::string& key);

} // namespace tegument::run
