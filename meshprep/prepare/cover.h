#pragma once
// Whether a triangle lies close to a surface, found by what of that surface lies over it.

#include "meshprep/prepare/near_surface.h"

namespace tegument::prep {

/// Looks at a surface along a triangle's normal: a sheet of the surface that hides all of the triangle has a point over each of its points.
/// How far that is varies linearly over each of the sheet's triangles, so it is greatest at a corner of what both have in common. The
/// answer is exact where the sheet does not fold, whatever the triangle's size.
class Cover {
public:
    /// `surface` outlives it.
    explicit Cover(const NearSurface& surface);

    /// True: no point of `triangle` is further than `most` from the surface. False: unknown. `near`: a triangle of the surface near it, and
    /// then one over its middle if there is one. Safe to call from several threads.
    [[nodiscard]] bool within(const std::array<glm::dvec3, 3>& triangle, std::uint32_t& near, double most) const;

private:
    class View;
    class Sheet;

    /// kNoHint at a border, and where more than two triangles meet.
    [[nodiscard]] std::uint32_t neighbour(std::uint32_t triangle, std::size_t side) const {
        return neighbours_[3 * std::size_t{triangle} + side];
    }

    const NearSurface& surface_;
    std::vector<std::uint32_t> neighbours_; // of each side
};

} // namespace tegument::prep
