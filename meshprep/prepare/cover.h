#pragma once
// Whether a triangle lies close to a surface, found by walking over that surface.

#include "meshprep/prepare/near_surface.h"

namespace tegument::prep {

/// Cuts a triangle along the sides of the surface's triangles below it, so that each piece lies over one of them. The distance from one
/// triangle is greatest at a piece's corner, so the answer is exact where the pieces suit, whatever the triangle's size.
class Cover {
public:
    /// `surface` outlives it.
    explicit Cover(const NearSurface& surface);

    /// True: no point of `triangle` is further than `most` from the surface. False: unknown. `start`: a triangle of the surface near its
    /// first corner. Safe to call from several threads.
    [[nodiscard]] bool within(const std::array<glm::dvec3, 3>& triangle, std::uint32_t start, double most) const;

private:
    struct Polygon;
    class Cut;
    class Walk;

    [[nodiscard]] std::uint32_t neighbour(std::uint32_t triangle, std::size_t side) const;

    const NearSurface& surface_;
    std::vector<std::uint32_t> first_; // by point, into `faces_`
    std::vector<std::uint32_t> faces_;
};

} // namespace tegument::prep
