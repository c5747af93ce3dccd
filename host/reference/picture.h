#pragma once
// The picture of d'Eon and Luebke's technique as docs/skin.md defines it, each part in double precision: light by rays, one Gaussian of the
// whole width for each map, transmission by the thickness along the ray.

#include "host/reference/convolution.h"
#include "host/reference/profile.h"
#include "host/reference/skin.h"

#include <array>

namespace tegument::reference {

class SkinPicture {
public:
    /// Maps of `mapSize` texels a side; `light` must outlive the picture. `range`: mm between the light's planes, which alpha counts in
    /// where the setting stores depths.
    SkinPicture(const SkinScene& light, int mapSize, double range);

    /// M of docs/skin.md: six maps weighted, and what passes through the body.
    [[nodiscard]] glm::dvec3 diffused(const SurfacePoint& point) const;
    /// Linear radiance towards the eye.
    [[nodiscard]] glm::dvec3 radiance(const SurfacePoint& point, const glm::dvec3& eye) const;
    /// The same light without diffusion.
    [[nodiscard]] glm::dvec3 lambert(const SurfacePoint& point, const glm::dvec3& eye) const;

private:
    [[nodiscard]] double encode(const SurfacePoint& point) const;
    [[nodiscard]] double decode(double alpha) const;
    [[nodiscard]] glm::dvec3 through(const SurfacePoint& point, const std::array<glm::dvec4, 6>& here) const;

    const SkinScene& light_;
    double range_;
    std::array<Map, 6> maps_;
};

} // namespace tegument::reference
