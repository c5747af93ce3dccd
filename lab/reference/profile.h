#pragma once
// The diffusion profile as a sum of Gaussians, and its responses that have a closed form.
//   R(r) = sum of w_i G(v_i, r),  G(v, r) = exp(-r^2 / (2 v)) / (2 pi v);  mm, mm^2
// Diffusion profiles that stand for skin in the literature and in this project, and how far each is from simulated skin.

#include "lab/reference/tissue.h"

#include <glm/glm.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace tegument::reference {

struct Gaussian {
    double variance = 0;
    glm::dvec3 weight{0}; // red, green, blue
};
using Profile = std::vector<Gaussian>;

/// d'Eon and Luebke 2007, figure 14-13.
[[nodiscard]] const Profile& skinProfile();

/// Light on x > 0 of a plane, seen at x.
[[nodiscard]] glm::dvec3 halfPlane(const Profile& profile, double x);
/// Light on a disc of this radius, seen at its centre.
[[nodiscard]] glm::dvec3 discCentre(const Profile& profile, double radius);
/// Amplitude left of light that varies as a sine, `wavenumber` radians per mm.
[[nodiscard]] glm::dvec3 sinusoid(const Profile& profile, double wavenumber);
/// Sum of w_i exp(-d^2 / (2 v_i)): what the profile at distance d behind a slab holds, as the translucent shadow map uses it.
[[nodiscard]] glm::dvec3 slab(const Profile& profile, double thickness);

/// Sphere of this radius under directional light, irradiance max(0, cosine); distances are chords. On a sphere a Gaussian of the chord is
/// a von Mises-Fisher kernel of concentration radius^2 / v, whose Legendre coefficients are ratios of Bessel functions:
///   D = sum_i w_i (1 - exp(-2 k_i)) sum_l E_l I_{l+1/2}(k_i) / I_{1/2}(k_i) P_l(cosine)
/// flesh: c of bssrdf.h. There h = r^2 / (2 radius), and r^2 G / (2 v) = G + v dG/dv.
[[nodiscard]] glm::dvec3 sphere(const Profile& profile, double radius, double cosine, const glm::dvec3& flesh = glm::dvec3(0));

/// exp(-x) I_{l+1/2}(x) / (exp(-x) I_{1/2}(x)) for l = 0 .. count - 1, by Miller's backward recurrence.
[[nodiscard]] std::vector<double> besselRatios(double x, std::size_t count);

/// Light by its distance, one function for the three channels.
struct NamedProfile {
    std::string name;
    std::string source;
    std::function<glm::dvec3(double radius)> within; // share that leaves within this radius
    std::function<glm::dvec3(double x)> halfPlane;   // light on x > 0, seen at x
};
[[nodiscard]] NamedProfile named(const std::string& name, const std::string& source, const Profile& gaussians);
[[nodiscard]] NamedProfile namedBurley(const std::string& name, const std::string& source, const glm::dvec3& d);

/// The six Gaussians refitted with `count` of them, 2 to 5: edge response, least squares.
[[nodiscard]] const Profile& refittedProfile(int count);
/// d'Eon's table of the Game Developers Conference 2007, "Advanced Skin Rendering", slide 98.
[[nodiscard]] const Profile& conferenceProfile();
/// Six Gaussians fitted to three-layer skin as followPhotons draws it (diffuse launch).
[[nodiscard]] const Profile& physicalProfile();

/// Simulated skin, one result for each channel.
using SimulatedSkin = std::array<Photons, 3>;
[[nodiscard]] SimulatedSkin simulateSkin(std::size_t photons, std::uint64_t seed);

/// Light on x > 0 of a plane, seen at x: each ring's share on that side. Of 1.
[[nodiscard]] double halfPlane(const RingHistogram& rings, double x);

/// d in mm for each channel that comes closest to the simulation: the largest difference of the share within any radius is least.
[[nodiscard]] glm::dvec3 fittedBurley(const SimulatedSkin& skin);

struct ModelError {
    glm::dvec3 within{0};    // largest |difference| of the share within any radius: energy in the wrong place
    glm::dvec3 halfPlane{0}; // largest |difference| across an edge of light
};
[[nodiscard]] ModelError modelError(const NamedProfile& profile, const SimulatedSkin& skin);

} // namespace tegument::reference
