// The first row of a texture of roots, held against the texels that are really there.

#include "meshprep/fur/roots/root_texture.h"

#include <cmath>

namespace tegument {

namespace {

constexpr std::size_t kRootsOfRow = kRootColumns / kRootTexels;
constexpr double kMostPoints = 32; // of a curve: a ribbon's vertices tell no more places apart

glm::dvec4 texel(const Image& image, std::size_t number) {
    const float* from = &image.pixels[4 * number];
    return {from[0], from[1], from[2], from[3]};
}

bool isCount(double number) {
    return number >= 1 && number < 16777216 && number == std::floor(number); // 2^24, what a float counts to
}

} // namespace

std::size_t RootHeader::addressOf(std::size_t number) const {
    return firstRoot + number / kRootsOfRow * kRootColumns + number % kRootsOfRow * kRootTexels;
}

std::optional<RootHeader> rootHeader(const Image& image) {
    if (image.width != kRootColumns || image.channels != 4 || image.height < 1) return std::nullopt;
    const double count = texel(image, 2).z;
    const double first = texel(image, 6).x;
    RootHeader header{.count = isCount(count) ? static_cast<std::size_t>(count) : 0,
                      .firstRoot = isCount(first) ? static_cast<std::size_t>(first) : 0,
                      .density = texel(image, 3).w,
                      .centre = glm::dvec3(texel(image, 4)),
                      .ballRadius = texel(image, 4).w};
    const bool plausible = header.density > 0 && std::isfinite(header.density) && header.ballRadius > 0 &&
                           std::isfinite(header.ballRadius + header.centre.x + header.centre.y + header.centre.z);
    if (!plausible || header.count == 0 || header.firstRoot % kRootColumns != 0 || header.firstRoot == 0) return std::nullopt;
    const std::size_t texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (header.addressOf(header.count - 1) + kRootTexels > texels) return std::nullopt;
    if (texel(image, 1).w != 0) return header; // there is a grid, and no curve
    const glm::dvec4 curves = texel(image, 8);
    if (!isCount(curves.x) || !(curves.y >= 2 && curves.y <= kMostPoints) || !(curves.z > 0) || !(curves.w > 0)) return std::nullopt;
    header.firstPoint = static_cast<std::size_t>(curves.x);
    header.curvePoints = static_cast<std::size_t>(curves.y);
    header.farthest = curves.z;
    header.widest = curves.w;
    header.painted = texel(image, 9).x > 0;
    header.low = glm::vec3(texel(image, 10));
    header.high = glm::vec3(texel(image, 11));
    if (header.firstPoint + header.count * header.curvePoints > texels) return std::nullopt;
    return header;
}

} // namespace tegument
