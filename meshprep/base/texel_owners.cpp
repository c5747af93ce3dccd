#include "meshprep/base/texel_owners.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

double edgeFunction(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

bool covers(const std::array<glm::dvec2, 3>& p, double area, const glm::dvec2& centre) {
    const double sign = area > 0 ? 1 : -1;
    return sign * edgeFunction(p[0], p[1], centre) >= 0 && sign * edgeFunction(p[1], p[2], centre) >= 0 &&
           sign * edgeFunction(p[2], p[0], centre) >= 0;
}

} // namespace

TexelOwners::TexelOwners(std::span<const glm::vec2> uvs, std::span<const std::uint32_t> indices, int size)
    : uvs_(uvs), indices_(indices), size_(size), owner_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), kNone) {
    for (std::uint32_t t = 0; t < indices.size() / 3; ++t)
        claim(t);
}

std::array<std::uint32_t, 3> TexelOwners::corners(std::uint32_t triangle) const {
    const std::size_t first = 3 * std::size_t{triangle};
    return {indices_[first], indices_[first + 1], indices_[first + 2]};
}

std::array<glm::dvec2, 3> TexelOwners::texelCorners(std::uint32_t triangle) const {
    std::array<glm::dvec2, 3> result{};
    const auto vertices = corners(triangle);
    for (std::size_t c = 0; c < 3; ++c)
        result[c] = glm::dvec2(uvs_[vertices[c]]) * static_cast<double>(size_);
    return result;
}

double TexelOwners::area(std::uint32_t triangle) const {
    const auto p = texelCorners(triangle);
    return edgeFunction(p[0], p[1], p[2]);
}

std::array<float, 3> TexelOwners::weights(std::uint32_t triangle, const glm::dvec2& texel) const {
    const auto p = texelCorners(triangle);
    const double area = edgeFunction(p[0], p[1], p[2]);
    return {static_cast<float>(edgeFunction(p[1], p[2], texel) / area), static_cast<float>(edgeFunction(p[2], p[0], texel) / area),
            static_cast<float>(edgeFunction(p[0], p[1], texel) / area)};
}

/// Texels whose centre lies in the triangle become its own; the first one keeps a centre on a common edge.
void TexelOwners::claim(std::uint32_t triangle) {
    const auto p = texelCorners(triangle);
    const double area = edgeFunction(p[0], p[1], p[2]);
    if (area == 0 || !std::isfinite(area)) return;
    const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
    const auto first = [&](double v) { return static_cast<int>(std::ceil(std::clamp(v - 0.5, 0.0, static_cast<double>(size_)))); };
    const auto last = [&](double v) { return static_cast<int>(std::floor(std::clamp(v - 0.5, -1.0, size_ - 1.0))); };
    for (int y = first(y0); y <= last(y1); ++y)
        for (int x = first(x0); x <= last(x1); ++x) {
            std::uint32_t& owner = owner_[index(x, y)];
            if (owner == kNone && covers(p, area, glm::dvec2(x + 0.5, y + 0.5))) owner = triangle;
        }
}

/// Breadth first from the covered texels, in rows from the top.
void TexelOwners::spread(std::span<float> pixels, std::size_t channels) const {
    std::vector<std::uint32_t> front;
    std::vector<std::uint8_t> filled(owner_.size());
    for (std::size_t i = 0; i < owner_.size(); ++i) {
        filled[i] = owner_[i] != kNone;
        if (filled[i]) front.push_back(static_cast<std::uint32_t>(i));
    }
    while (!front.empty()) {
        std::vector<std::uint32_t> nextFront;
        for (const std::uint32_t from : front)
            for (int neighbour = 0; neighbour < 9; ++neighbour) {
                const int x = static_cast<int>(from % static_cast<std::uint32_t>(size_)) + neighbour % 3 - 1;
                const int y = static_cast<int>(from / static_cast<std::uint32_t>(size_)) + neighbour / 3 - 1;
                if (x < 0 || y < 0 || x >= size_ || y >= size_ || filled[index(x, y)]) continue;
                filled[index(x, y)] = 1;
                std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(from * channels), channels,
                            pixels.begin() + static_cast<std::ptrdiff_t>(index(x, y) * channels));
                nextFront.push_back(static_cast<std::uint32_t>(index(x, y)));
            }
        front = std::move(nextFront);
    }
}

} // namespace tegument
