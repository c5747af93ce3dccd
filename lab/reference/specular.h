#pragma once
// Specular reflection of Kelemen and Szirmay-Kalos (2001) with Beckmann's distribution and Schlick's Fresnel term, as d'Eon and Luebke
// (2007) print it: without 1/pi. Unit vectors from the surface; m is the rms slope, f0 the reflectance at normal incidence, rho_s scales
// the whole.

#include <glm/glm.hpp>

namespace tegument::reference {

struct Lobe {
    double m = 0;
    double f0 = 0;
    double rhoS = 1;
};

/// exp(-tan^2 / m^2) / (m^2 c^4), c = N.H; 0 for c <= 0. Its integral times c over the hemisphere is pi.
[[nodiscard]] double beckmannPH(double cosine, double m);

/// F0 + (1 - F0)(1 - c)^5.
[[nodiscard]] double fresnelSchlick(double cosine, double f0);

/// rho_s PH(N.H, m) F(V.H) / |L + V|^2, without N.L; 0 where light or eye is below the surface.
[[nodiscard]] double kelemenBrdf(const glm::dvec3& normal, const glm::dvec3& toLight, const glm::dvec3& toEye, const Lobe& lobe);

/// Integral of kelemenBrdf with rho_s = 1 times N.L over the hemisphere of light directions. `cosine` = N.V > 0. Relative error below 1e-6
/// for m in [0.05, 1], cosine >= 0.01.
[[nodiscard]] double directionalAlbedo(double cosine, double m, double f0);

/// The same integral by the rule that the paper prints: `nodes` x `nodes` directions, both ends of [0, 2 pi] and [0, pi / 2] among them,
/// equal weights. Printed with 80.
[[nodiscard]] double directionalAlbedoPrinted(double cosine, double m, double f0, int nodes);

} // namespace tegument::reference
