#include "meshprep/prepare/carry_textures.h"

#include "host/support/parallel.h"
#include "meshprep/base/texel_owners.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tegument::prep {

namespace {

constexpr double kFiner = 1.4;
constexpr unsigned kMostTexels = 8192; // along each side

/// Between the four nearest texels; the picture repeats.
void sample(const Image& image, const glm::vec2& uv, float* out) {
    const auto wrapped = [](int texel, int side) { return (texel % side + side) % side; };
    const glm::dvec2 at = glm::dvec2(uv) * glm::dvec2(image.width, image.height) - 0.5;
    const glm::dvec2 low = glm::floor(at);
    const glm::dvec2 share = at - low;
    const int x[2] = {wrapped(static_cast<int>(low.x), image.width), wrapped(static_cast<int>(low.x) + 1, image.width)};
    const int y[2] = {wrapped(static_cast<int>(low.y), image.height), wrapped(static_cast<int>(low.y) + 1, image.height)};
    for (int c = 0; c < image.channels; ++c) {
        const auto row = [&](int j) {
            return std::lerp(static_cast<double>(image.at(x[0], y[j], c)), static_cast<double>(image.at(x[1], y[j], c)), share.x);
        };
        out[c] = static_cast<float>(std::lerp(row(0), row(1), share.y));
    }
}

/// Columns: tangent, bitangent, normal, as a pixel shader has them there.
glm::dmat3 frameAt(const Mesh& mesh, std::uint32_t triangle, const std::array<float, 3>& weights) {
    glm::dvec3 normal(0), tangent(0);
    const std::uint32_t* corner = &mesh.indices[3 * static_cast<std::size_t>(triangle)];
    for (std::size_t i = 0; i < 3; ++i) {
        normal += static_cast<double>(weights[i]) * glm::dvec3(mesh.normals[corner[i]]);
        tangent += static_cast<double>(weights[i]) * glm::dvec3(mesh.tangents[corner[i]]);
    }
    return {tangent, glm::cross(normal, tangent) * static_cast<double>(mesh.tangents[corner[0]].w), normal};
}

/// From one frame into another; what has no direction there is the surface's own.
void turn(const glm::dmat3& from, const glm::dmat3& to, float* texel) {
    const glm::dvec3 given = glm::dvec3(texel[0], texel[1], texel[2]) * 2.0 - 1.0;
    const glm::dvec3 turned = std::abs(glm::determinant(to)) > 1e-9 ? glm::inverse(to) * (from * given) : glm::dvec3(0);
    const double length = glm::length(turned);
    const glm::dvec3 stored = 0.5 + 0.5 * (std::isfinite(length) && length > 0 ? turned / length : glm::dvec3(0, 0, 1));
    for (int c = 0; c < 3; ++c)
        texel[c] = static_cast<float>(stored[c]);
}

void decode(Image& colours, float (*curve)(float)) {
    for (std::size_t i = 0; i < colours.pixels.size(); ++i)
        if (static_cast<int>(i % static_cast<std::size_t>(colours.channels)) < std::min(colours.channels, 3))
            colours.pixels[i] = curve(colours.pixels[i]);
}

Image carried(const Mesh& before, const Mesh& mesh, const EmbeddedTexture& texture, const TexelOwners& owners) {
    Image source = texture.image;
    const bool colours = texture.role == "color";
    if (colours) decode(source, srgbToLinear);
    Image image = plainImage(owners.size(), owners.size(), source.channels);
    image.bitsPerChannel = source.bitsPerChannel;
    forEachInParallel(static_cast<std::size_t>(owners.size()), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < owners.size(); ++x) {
            const std::uint32_t triangle = owners.at(x, y);
            if (triangle == TexelOwners::kNone) continue;
            const std::array<float, 3> weights = owners.weights(triangle, {x + 0.5, y + 0.5});
            glm::vec2 uv(0);
            for (std::size_t i = 0; i < 3; ++i)
                uv += weights[i] * before.uvs[before.indices[3 * static_cast<std::size_t>(triangle) + i]];
            sample(source, uv, &image.at(x, y, 0));
            if (texture.role == "normal" && source.channels >= 3)
                turn(frameAt(before, triangle, weights), frameAt(mesh, triangle, weights), &image.at(x, y, 0));
        }
    });
    owners.spread(image.pixels, static_cast<std::size_t>(image.channels));
    if (colours) decode(image, linearToSrgb);
    return image;
}

} // namespace

int carryTextures(const Mesh& before, Mesh& mesh) {
    int most = 0;
    for (const EmbeddedTexture& texture : before.textures) {
        const double side = kFiner * std::sqrt(static_cast<double>(texture.image.width) * texture.image.height);
        const int texels = static_cast<int>(std::min(kMostTexels, std::bit_ceil(static_cast<unsigned>(std::ceil(side)))));
        mesh.textures.push_back(
            {.role = texture.role, .image = carried(before, mesh, texture, TexelOwners(mesh.uvs, mesh.indices, texels))});
        most = std::max(most, texels);
    }
    return most;
}

} // namespace tegument::prep
