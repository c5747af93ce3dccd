#include "meshprep/human/bake.h"

#include "host/support/parallel.h"
#include "meshprep/base/texel_owners.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace tegument {

namespace {

class Baker {
public:
    Baker(const HeadSurface& head, int size) : head_(head), owners_(head.mesh.uvs, head.mesh.indices, size) {}

    Image bake(int channels, const TexelFunction& texel) {
        const int size = owners_.size();
        Image image = plainImage(size, size, channels);
        forEachInParallel(static_cast<std::size_t>(size), [&](std::size_t row) { bakeRow(static_cast<int>(row), image, texel); });
        owners_.spread(image.pixels, static_cast<std::size_t>(channels));
        return image;
    }

private:
    void bakeRow(int row, Image& image, const TexelFunction& texel) const {
        for (int x = 0; x < image.width; ++x) {
            const std::uint32_t triangle = owners_.at(x, row);
            if (triangle == TexelOwners::kNone) continue;
            const glm::vec4 value = texel(pointUnder(triangle, glm::dvec2(x + 0.5, row + 0.5)));
            for (int c = 0; c < image.channels; ++c)
                image.at(x, row, c) = value[c];
        }
    }

    [[nodiscard]] SurfacePoint pointUnder(std::uint32_t triangle, const glm::dvec2& centre) const {
        const double area = owners_.area(triangle);
        const std::array<float, 3> weight = owners_.weights(triangle, centre);
        SurfacePoint point{.part = head_.parts[triangle]};
        glm::vec4 tangent(0);
        const auto vertices = owners_.corners(triangle);
        for (std::size_t c = 0; c < 3; ++c) {
            point.position += weight[c] * head_.mesh.positions[vertices[c]];
            point.normal += weight[c] * head_.mesh.normals[vertices[c]];
            tangent += weight[c] * head_.mesh.tangents[vertices[c]];
            point.sourceUv += weight[c] * head_.sourceUvs[3 * std::size_t{triangle} + c];
        }
        point.normal = glm::normalize(point.normal);
        const glm::vec3 along(tangent);
        point.tangent = glm::normalize(along - point.normal * glm::dot(along, point.normal));
        point.bitangent = glm::cross(point.normal, point.tangent) * (tangent.w < 0 ? -1.0f : 1.0f);
        const glm::vec3 a = head_.mesh.positions[vertices[1]] - head_.mesh.positions[vertices[0]];
        const glm::vec3 b = head_.mesh.positions[vertices[2]] - head_.mesh.positions[vertices[0]];
        point.texelMm = std::sqrt(glm::length(glm::cross(a, b)) / static_cast<float>(std::abs(area)));
        return point;
    }

    const HeadSurface& head_;
    TexelOwners owners_;
};

/// One line of a binomial filter of five taps; its ends are repeated outwards.
void blurLine(Image& image, std::size_t first, std::size_t step, int count) {
    std::vector<float> from(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < from.size(); ++i)
        from[i] = image.pixels[first + i * step];
    const auto at = [&](int i) { return from[static_cast<std::size_t>(std::clamp(i, 0, count - 1))]; };
    for (int i = 0; i < count; ++i)
        image.pixels[first + static_cast<std::size_t>(i) * step] = (at(i - 2) + 4 * at(i - 1) + 6 * at(i) + 4 * at(i + 1) + at(i + 2)) / 16;
}

} // namespace

void soften(Image& image, int times) {
    assert(image.channels == 1);
    const auto width = static_cast<std::size_t>(image.width);
    for (int i = 0; i < times; ++i) {
        for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
            blurLine(image, y * width, 1, image.width);
        for (std::size_t x = 0; x < width; ++x)
            blurLine(image, x, width, image.height);
    }
}

Image bakeTexture(const HeadSurface& head, int size, int channels, const TexelFunction& texel) {
    return Baker(head, size).bake(channels, texel);
}

} // namespace tegument
