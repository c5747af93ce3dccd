#pragma once
// Inside host/mesh only: EXT_meshopt_compression.

#include "host/mesh/gltf_json.h"

namespace tegument::meshfile {

/// What a buffer view packed by the extension stands for. TG5302 what the extension does not allow, TG5303 a size that so few bytes cannot
/// hold, TG5307 a later form of the codec.
[[nodiscard]] Result<std::string> unpackMeshopt(const GltfValue& packed, std::string_view bytes);

} // namespace tegument::meshfile
