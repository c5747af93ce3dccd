#include "meshprep/human/bake.h"

#include "host/support/parallel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace tegument {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

double edgeFunction(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

class Baker {
public:
    Baker(const HeadSurface& head, int size)
        : head_(head), size_(size), owner_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), kNone) {
        for (std::uint32_t t = 0; t < head.parts.size(); ++t)
            claim(t);
    }

    Image bake(int channels, const TexelFunction& texel) {
        Image image{.width = size_, .height = size_, .channels = channels, .pixels = {}};
        image.pixels.resize(owner_.size() * static_cast<std::size_t>(channels));
        forEachInParallel(static_cast<std::size_t>(size_), [&](std::size_t row) { bakeRow(static_cast<int>(row), image, texel); });
        spread(image);
        return image;
    }

private:
    [[nodiscard]] std::array<std::uint32_t, 3> corners(std::uint32_t triangle) const {
        const std::size_t first = 3 * std::size_t{triangle};
        return {head_.mesh.indices[first], head_.mesh.indices[first + 1], head_.mesh.indices[first + 2]};
    }

    [[nodiscard]] std::array<glm::dvec2, 3> texelCorners(std::uint32_t triangle) const {
        std::array<glm::dvec2, 3> result{};
        const auto vertices = corners(triangle);
        for (std::size_t c = 0; c < 3; ++c)
            result[c] = glm::dvec2(head_.mesh.uvs[vertices[c]]) * static_cast<double>(size_);
        return result;
    }

    /// Texels whose centre lies in the triangle become its own; the first one keeps a centre on a common edge.
    void claim(std::uint32_t triangle) {
        const auto p = texelCorners(triangle);
        const double area = edgeFunction(p[0], p[1], p[2]);
        if (area == 0) return;
        const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
        const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
        const auto first = [](double v) { return std::max(0, static_cast<int>(std::ceil(v - 0.5))); };
        const auto last = [&](double v) { return std::min(size_ - 1, static_cast<int>(std::floor(v - 0.5))); };
        for (int y = first(y0); y <= last(y1); ++y)
            for (int x = first(x0); x <= last(x1); ++x) {
                std::uint32_t& owner = owner_[index(x, y)];
                if (owner == kNone && covers(p, area, glm::dvec2(x + 0.5, y + 0.5))) owner = triangle;
            }
    }

    static bool covers(const std::array<glm::dvec2, 3>& p, double area, const glm::dvec2& centre) {
        const double sign = area > 0 ? 1 : -1;
        return sign * edgeFunction(p[0], p[1], centre) >= 0 && sign * edgeFunction(p[1], p[2], centre) >= 0 &&
               sign * edgeFunction(p[2], p[0], centre) >= 0;
    }

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x);
    }

    void bakeRow(int row, Image& image, const TexelFunction& texel) const {
        for (int x = 0; x < size_; ++x) {
            const std::uint32_t triangle = owner_[index(x, row)];
            if (triangle == kNone) continue;
            const glm::vec4 value = texel(pointUnder(triangle, glm::dvec2(x + 0.5, row + 0.5)));
            for (int c = 0; c < image.channels; ++c)
                image.at(x, row, c) = value[c];
        }
    }

    [[nodiscard]] SurfacePoint pointUnder(std::uint32_t triangle, const glm::dvec2& centre) const {
        const auto p = texelCorners(triangle);
        const double area = edgeFunction(p[0], p[1], p[2]);
        const std::array<float, 3> weight = {static_cast<float>(edgeFunction(p[1], p[2], centre) / area),
                                             static_cast<float>(edgeFunction(p[2], p[0], centre) / area),
                                             static_cast<float>(edgeFunction(p[0], p[1], centre) / area)};
        SurfacePoint point{.part = head_.parts[triangle]};
        glm::vec4 tangent(0);
        const auto vertices = corners(triangle);
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

    /// Breadth first from the covered texels, in rows from the top.
    void spread(Image& image) {
        std::vector<std::uint32_t> front;
        std::vector<std::uint8_t> filled(owner_.size());
        for (std::size_t i = 0; i < owner_.size(); ++i) {
            filled[i] = owner_[i] != kNone;
            if (filled[i]) front.push_back(static_cast<std::uint32_t>(i));
        }
        const auto channels = static_cast<std::size_t>(image.channels);
        while (!front.empty()) {
            std::vector<std::uint32_t> nextFront;
            for (const std::uint32_t from : front)
                for (int neighbour = 0; neighbour < 9; ++neighbour) {
                    const int x = static_cast<int>(from % static_cast<std::uint32_t>(size_)) + neighbour % 3 - 1;
                    const int y = static_cast<int>(from / static_cast<std::uint32_t>(size_)) + neighbour / 3 - 1;
                    if (x < 0 || y < 0 || x >= size_ || y >= size_ || filled[index(x, y)]) continue;
                    filled[index(x, y)] = 1;
                    std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(from * channels), channels,
                                image.pixels.begin() + static_cast<std::ptrdiff_t>(index(x, y) * channels));
                    nextFront.push_back(static_cast<std::uint32_t>(index(x, y)));
                }
            front = std::move(nextFront);
        }
    }

    const HeadSurface& head_;
    int size_;
    std::vector<std::uint32_t> owner_; // of each texel: its triangle
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
