#pragma once
// The triangle below a root: the texture of roots does not say which it is.

#include "meshprep/fur/ribbons/rooted.h"
#include "meshprep/fur/roots/fur_surface.h"
#include "meshprep/rays/surface_tree.h"

#include <optional>

namespace tegument {

class Below {
public:
    /// `surface` must outlive this.
    explicit Below(const FurSurface& surface, unsigned threads);

    /// Nothing where there is no surface within 0.02 radii.
    [[nodiscard]] std::optional<SurfacePoint> found(const RootedPlace& root) const;
    /// There the root itself.
    [[nodiscard]] SurfacePoint at(const RootedPlace& root) const;

private:
    [[nodiscard]] glm::vec2 barycentric(std::uint32_t triangle, const glm::vec3& place) const;

    const FurSurface& surface_;
    SurfaceTree tree_;
};

} // namespace tegument
