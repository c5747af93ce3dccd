#pragma once
// The pictures of both techniques as docs/design/skin.md defines them, each part in double precision: light by rays; d'Eon and Luebke's
// with one Gaussian of the whole width for each map and transmission by the thickness along the ray, Gosselin's with its discs.

#include "lab/reference/chart_map.h"
#include "lab/reference/profile.h"
#include "lab/reference/skin.h"

#include <array>

namespace tegument::reference {

/// Radiance towards the eye of skin in which light does not spread.
[[nodiscard]] glm::dvec3 lambert(const SkinScene& light, const SurfacePoint& point, const glm::dvec3& eye);

class SkinPicture {
public:
    /// Maps of `mapSize` texels a side; `light` must outlive the picture. `range`: mm between the light's planes, which alpha counts in
    /// where the setting stores depths.
    SkinPicture(const SkinScene& light, int mapSize, double range);

    /// M of docs/design/skin.md: six maps weighted, and what passes through the body.
    [[nodiscard]] glm::dvec3 diffused(const SurfacePoint& point) const;
    /// Linear radiance towards the eye.
    [[nodiscard]] glm::dvec3 radiance(const SurfacePoint& point, const glm::dvec3& eye) const;

private:
    [[nodiscard]] double encode(const SurfacePoint& point) const;
    [[nodiscard]] double decode(double alpha) const;
    [[nodiscard]] glm::dvec3 through(const SurfacePoint& point, const std::array<glm::dvec4, 6>& here) const;

    const SkinScene& light_;
    double range_;
    std::array<Map, 6> maps_;
};

struct GosselinSettings {
    Discs discs;
    bool shadowedReflection = true; // the printed technique gives its last pass no shadow map
};
/// "seed", "deon2007" or "corrected".
[[nodiscard]] GosselinSettings gosselinSettings(const std::string& name);

class GosselinPicture {
public:
    /// Maps of `mapSize` texels a side; `light` must outlive the picture.
    GosselinPicture(const SkinScene& light, int mapSize, const GosselinSettings& settings);

    /// E of docs/design/skin.md after the last blur; where the map has nothing, the light without diffusion.
    [[nodiscard]] glm::dvec3 diffused(const SurfacePoint& point) const;
    /// Linear radiance towards the eye.
    [[nodiscard]] glm::dvec3 radiance(const SurfacePoint& point, const glm::dvec3& eye) const;

private:
    /// What arrives at the surface: all of it enters, whatever the colour.
    [[nodiscard]] glm::dvec3 arriving(const SurfacePoint& point) const;

    const SkinScene& light_;
    GosselinSettings settings_;
    Map map_;
};

} // namespace tegument::reference
