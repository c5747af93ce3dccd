#include "host/run/procedures.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tegument::run {

namespace {

constexpr int kSide = 128; // texels of a picture
constexpr int kFace = 64;  // of a face of the sky
constexpr int kChecks = 8; // squares along a side

using Texel = std::array<float, 4>;

Image drawn(int side, auto texel) {
    Image image{.width = side, .height = side, .channels = 4};
    image.pixels.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const Texel colour = texel(x, y);
            image.pixels.insert(image.pixels.end(), colour.begin(), colour.end());
        }
    return image;
}

/// The same numbers on every machine: a hash of the texel.
float noise(int x, int y, int channel) {
    auto h = static_cast<std::uint32_t>(x) * 0x9e3779b1U ^ static_cast<std::uint32_t>(y) * 0x85ebca77U ^
             static_cast<std::uint32_t>(channel) * 0xc2b2ae3dU;
    h = (h ^ h >> 15U) * 0x2c1b3c6dU;
    h = (h ^ h >> 12U) * 0x297a2d39U;
    return static_cast<float>((h ^ h >> 15U) & 0xffffU) / 65535.0F;
}

Texel checker(int x, int y) {
    const bool odd = (x * kChecks / kSide + y * kChecks / kSide) % 2 != 0;
    return odd ? Texel{0.55F, 0.5F, 0.45F, 1} : Texel{0.85F, 0.8F, 0.75F, 1};
}

glm::vec3 directionOf(int face, float u, float v) {
    switch (face) { // Direct3D's faces: +X -X +Y -Y +Z -Z
    case 0: return {1, -v, -u};
    case 1: return {-1, -v, u};
    case 2: return {u, 1, v};
    case 3: return {u, -1, -v};
    case 4: return {u, -v, 1};
    default: return {-u, -v, -1};
    }
}

Texel sky(const glm::vec3& direction) {
    const float up = glm::normalize(direction).y;
    const glm::vec3 zenith(0.25F, 0.45F, 0.8F);
    const glm::vec3 horizon(0.9F, 0.92F, 0.95F);
    const glm::vec3 ground(0.25F, 0.22F, 0.18F);
    const glm::vec3 colour = up > 0 ? glm::mix(horizon, zenith, std::sqrt(up)) : glm::mix(horizon, ground, std::min(1.0F, -up * 4));
    return {colour.x, colour.y, colour.z, 1};
}

} // namespace

Image plainPicture(const std::string& name) {
    if (name == "white") return drawn(4, [](int, int) { return Texel{1, 1, 1, 1}; });
    if (name == "grey") return drawn(4, [](int, int) { return Texel{0.5F, 0.5F, 0.5F, 1}; });
    if (name == "normal") return drawn(4, [](int, int) { return Texel{0.5F, 0.5F, 1, 1}; });
    if (name == "ramp")
        return drawn(kSide, [](int x, int) {
            const float t = static_cast<float>(x) / (kSide - 1);
            return Texel{t, t, t, 1};
        });
    if (name == "noise")
        return drawn(kSide, [](int x, int y) { return Texel{noise(x, y, 0), noise(x, y, 1), noise(x, y, 2), noise(x, y, 3)}; });
    return drawn(kSide, checker);
}

std::vector<Image> plainCube(const std::string& name) {
    std::vector<Image> faces;
    for (int face = 0; face < 6; ++face)
        faces.push_back(drawn(kFace, [face, normals = name == "normals"](int x, int y) {
            const auto along = [](int at) { return (static_cast<float>(at) + 0.5F) / kFace * 2 - 1; };
            const glm::vec3 direction = directionOf(face, along(x), along(y));
            if (!normals) return sky(direction);
            const glm::vec3 colour = glm::normalize(direction) * 0.5F + 0.5F;
            return Texel{colour.x, colour.y, colour.z, 1};
        }));
    return faces;
}

} // namespace tegument::run
