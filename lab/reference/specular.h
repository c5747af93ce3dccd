#pragma once
// Specular reflection of Kelemen and Szirmay-Kalos (2001) with Beckmann's distribution and Schlick's Fresnel term, as d'Eon and Luebke
// (2007) print it: without 1/pi. Unit vectors from the surface; m is the rms slope; rho_s scales the whole.

#include <glm/glm.hpp>

namespace tegument::reference {

/// Reflectance at normal incidence of an interface of index 1.4, as the paper rounds 0.02778.
inline constexpr double kSkinF0 = 0.028;

/// exp(-tan^2 / m^2) / (m^2 c^4), c = N.H; 0 for c <= 0. Its integral times c over the hemisphere is pi.
[[nodiscard]] double beckmannPH(double cosine, double m);

/// F0 + (1 - F0)(1 - c)^5.
[[nodiscard]] double fresnelSchlick(double cosine, double f0 = kSkinF0);

/// rho_s PH(N.H, m) F(V.H) / |L + V|^2, without N.L; 0 where light or eye is below the surface.
[[nodiscard]] double kelemenBrdf(const glm::dvec3& normal, const glm::dvec3& toLight, const glm::dvec3& toEye, double m, double rhoS);

/// Integral of kelemenBrdf with rho_s = 1 times N.L over the hemisphere of light directions. `cosine` = N.V > 0. Relative error below 1e-6
/// for m in [0.05, 1], cosine >= 0.01.
[[nodiscard]] double directionalAlbedo(double cosine, double m);

/// The same integral by the rule that the paper prints: `nodes` x `nodes` directions, both ends of [0, 2 pi] and [0, pi / 2] among them,
/// equal weights. Printed with 80.
[[nodiscard]] double directionalAlbedoPrinted(double cosine, double m, int nodes);

} // namespace tegument::reference
