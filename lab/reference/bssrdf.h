#pragma once
// Light that leaves a surface after scattering below it, by brute force: every point of the surface gives to every other.
//   D(x) = integral over the surface of R(|x - x'|) E(x') dA',   mm, Euclidean distance, area measure, not renormalised
// R is any function of the distance, E the light that enters (skin.h: shadows by rays, normal map, C^mix, 1 - rho_s rho_dt).
//
// R is known of a half-space. Where the surface bends, flesh lies under the straight way from x' to x, and more light passes than R says:
//   K(x, x') = R(|x - x'|) (1 + c h),  h = max(0, (x - x').(n - n') / 2),  mm
// h is 0 on a plane, r^2 / (2 a) on a ball of radius a, the thickness through a slab: flux through a surface that looks along the way is
// larger than through one that is grazed, as the dipole's own geometry has it. c belongs to the tissue (RadialProfile::flesh).

#include "lab/reference/profile.h"
#include "lab/reference/radial.h"
#include "lab/reference/skin.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tegument::reference {

/// How finely the surface is divided around a point: triangles are halved along their longest edge until that is shorter than
/// `fineness` times their distance from the point, or `fineness` times the profile's finest length near it; seven nodes on each (Radon
/// 1948: exact to degree 5). What has light on some nodes and none on others is halved further.
struct Quadrature {
    double fineness = 0.5;
    int halvings = 6;         // more at edges of light,
    double negligible = 1e-4; // where the piece holds more than this of the profile
};
/// Half the edges everywhere: what a converged result must not notice.
[[nodiscard]] Quadrature halved(const Quadrature& quadrature);

/// Light entering the surface at a point; exactly 0 where there is none.
using Irradiance = std::function<glm::dvec3(const SurfacePoint& point)>;

struct Diffused {
    glm::dvec3 light{0}; // D
    glm::dvec3 share{0}; // integral of R over the surface: 1 far inside a large plane. D / share is the renormalised variant.
};
/// `normal`: at that place, unit; asked for where the profile has flesh.
[[nodiscard]] Diffused diffuse(const RayScene& surface, const Irradiance& irradiance, const RadialProfile& profile, const glm::dvec3& at,
                               const Quadrature& quadrature, const glm::dvec3& normal = glm::dvec3(0));

/// What a pixel shows at its centre. One sample there is the estimator of a picture rasterised without multisampling: both evaluate the
/// centre and nothing else, so that no filter stands between the two.
struct ShadedPoint {
    int x = 0; // pixel, row 0 at the top
    int y = 0;
    SurfacePoint point;
};
/// `count` of these pixels, spread evenly: in the order of a Z curve one out of each of `count` equal runs, by a fixed hash of `seed`. 0,
/// or more than there are: every one.
[[nodiscard]] std::vector<ShadedPoint> spreadEvenly(std::vector<ShadedPoint> points, std::size_t count, std::uint64_t seed = 1);

/// Pixels that see the mesh, likewise.
[[nodiscard]] std::vector<ShadedPoint> visiblePoints(const SkinScene& scene, const Pinhole& camera, std::size_t count,
                                                     std::uint64_t seed = 1);

/// Linear radiance towards the eye, light colour as E/pi (docs/conventions.md).
struct Radiance {
    glm::dvec3 diffuse{0};  // C^(1-mix) (1 - rho_s rho_dt(N.V)) D; plain material (alpha 0 of the colour map): C colour shadow max(N.L, 0)
    glm::dvec3 specular{0}; // shadowed by rays
    glm::dvec3 share{0};    // Diffused::share

    [[nodiscard]] glm::dvec3 total() const { return diffuse + specular; }
};

struct BssrdfOptions {
    RadialProfile profile = radial(skinProfile());
    Quadrature quadrature;
    bool cached = true;                                                  // under cacheFolder()/reference, by content
    std::function<void(std::size_t done, std::size_t total)> progress{}; // now and then, from one thread at a time
};

/// Of each point, in their order; all cores. Light enters and leaves through skin only (alpha above 1/2). The same on every run, whatever
/// the number of cores.
[[nodiscard]] std::vector<Radiance> radiance(const SkinScene& scene, std::span<const ShadedPoint> points, const glm::dvec3& eye,
                                             const BssrdfOptions& options = {});

} // namespace tegument::reference
