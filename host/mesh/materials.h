#pragma once
// Materials that are carried from file to file as glTF writes them.

#include "host/mesh/mesh.h"

#include <string_view>

namespace tegument {

/// Takes out every reference to a texture, and the pictures: the mesh has no texture coordinates for them. Gives the number of pictures.
std::size_t dropTextures(MaterialSet& materials);

/// "image/png", "image/jpeg", "image/webp", "image/ktx2" or "image/vnd-ms.dds" by the first bytes; empty for anything else, and for PNG and
/// JPEG files that end early.
[[nodiscard]] std::string_view pictureType(std::string_view bytes);

} // namespace tegument
