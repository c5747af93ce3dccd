#pragma once
// The diffusion profile as a sum of Gaussians, and its responses that have a closed form.
//   R(r) = sum of w_i G(v_i, r),  G(v, r) = exp(-r^2 / (2 v)) / (2 pi v);  mm, mm^2

#include <glm/glm.hpp>

#include <array>
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

} // namespace tegument::reference
