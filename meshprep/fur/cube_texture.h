#pragma once
// A cube map as a texture with its mip levels, whose faces fit each other whether a device filters across edges or not.

#include "host/image/dds.h"

#include <array>

namespace tegument {

/// Faces as drawCubeMap draws them. On every level the texels that meet at an edge or a corner of the cube hold their mean. Direct3D 9
/// filters each face by itself, up to half a texel beyond the outermost centres; where these are equal it comes to the value that a device
/// which filters across the edge comes to, and to the same on both sides.
[[nodiscard]] DdsTexture cubeTexture(const std::array<Image, 6>& faces, DdsFormat format);

} // namespace tegument
