#pragma once
// Which triangle of a mesh lies under each texel's centre of a square map over its texture coordinates.

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tegument {

class TexelOwners {
public:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// `uvs` and `indices` of the mesh, v down, must outlive this. What lies outside the unit square is left out.
    TexelOwners(std::span<const glm::vec2> uvs, std::span<const std::uint32_t> indices, int size);

    [[nodiscard]] int size() const { return size_; }
    /// Of a texel whose centre several triangles cover: the first.
    [[nodiscard]] std::uint32_t at(int x, int y) const { return owner_[index(x, y)]; }
    /// Vertices of a triangle.
    [[nodiscard]] std::array<std::uint32_t, 3> corners(std::uint32_t triangle) const;
    /// Of the corners at a point of the map, in texels; they sum to 1.
    [[nodiscard]] std::array<float, 3> weights(std::uint32_t triangle, const glm::dvec2& texel) const;
    /// Twice the triangle's area on the map, texels^2, signed.
    [[nodiscard]] double area(std::uint32_t triangle) const;

    /// Texels without a triangle take the value of the nearest one that has one (by steps to the eight neighbours), so that filtering and
    /// mip maps never meet another colour. `pixels`: size * size * channels.
    void spread(std::span<float> pixels, std::size_t channels) const;

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] std::array<glm::dvec2, 3> texelCorners(std::uint32_t triangle) const;
    void claim(std::uint32_t triangle);

    std::span<const glm::vec2> uvs_;
    std::span<const std::uint32_t> indices_;
    int size_;
    std::vector<std::uint32_t> owner_; // of each texel: its triangle
};

} // namespace tegument
