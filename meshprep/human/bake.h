#pragma once
// A texture filled by asking a function for the value of every texel that the mesh covers.

#include "host/image/image.h"
#include "meshprep/human/head_surface.h"

#include <glm/glm.hpp>

#include <functional>

namespace tegument {

/// The point of the surface under a texel's centre.
struct SurfacePoint {
    glm::vec3 position{0};  // mm
    glm::vec3 normal{0};    // unit
    glm::vec3 tangent{0};   // unit, as the shaders make it: perpendicular to the normal
    glm::vec3 bitangent{0}; // unit: tangent.w * cross(normal, tangent)
    glm::vec2 sourceUv{0};  // v up
    BustPart part = BustPart::Skin;
    float texelMm = 0; // size of a texel on the surface
};

using TexelFunction = std::function<glm::vec4(const SurfacePoint&)>;

/// A size x size image of `channels` channels. Texels that no triangle covers take the value of the nearest covered one (by steps to the
/// eight neighbours), so that filtering and mip maps never meet another colour. The function is called from several threads.
[[nodiscard]] Image bakeTexture(const HeadSurface& head, int size, int channels, const TexelFunction& texel);

/// `times` a binomial filter of five taps along rows and columns of an image with one channel: reaches 2 * `times` texels.
void soften(Image& image, int times);

} // namespace tegument
