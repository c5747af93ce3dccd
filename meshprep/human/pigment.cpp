// Two layers. The epidermis absorbs only: light crosses it twice. The dermis scatters and absorbs without end in depth: diffuse reflectance
// of H. W. Jensen, S. Marschner, M. Levoy, P. Hanrahan, A Practical Model for Subsurface Light Transport, 2001, section 2.4.
//
//   melanosomes      mu_a = 1.70e11 l^-3.48 /mm                      S. L. Jacques, Skin Optics, Oregon Medical Laser Center News, 1998
//   bloodless tissue mu_a = 0.0244 + 8.53 exp(-(l - 154) / 66.2) /mm  the same
//   whole blood      mu_a = 2.303 e 150 g/l / 64500 g/mol            S. Prahl, Tabulated Molar Extinction Coefficient for Hemoglobin in
//                                                                    Water, 1998 (e in 1/(cm mol/l))
//   dermis           mu_s' = 6.87 (l / 500 nm)^-1.161 /mm            S. L. Jacques, Optical properties of biological tissues: a review,
//   2013,
//                                                                    table 1, skin after Simpson et al. 1998
// l is the wavelength in nm.

#include "meshprep/human/pigment.h"

#include <cmath>

namespace tegument {

namespace {

constexpr glm::vec3 kWavelength(610, 550, 460);      // nm
constexpr glm::vec3 kOxygenated(1506, 43016, 44480); // Prahl, 1/(cm mol/l)
constexpr glm::vec3 kDeoxygenated(9443.6f, 53412, 23388.8f);
constexpr float kBloodPerExtinction = 2.303f * 150 / 64500 / 10; // 1/mm for 1/(cm mol/l)
constexpr float kEpidermis = 0.06f;                              // mm
constexpr float kPath = 4; // diffuse light crosses a thin layer on paths twice its thickness on the mean, once in and once out

/// Internal reflection of diffuse light at a boundary of index 1.4 (Jensen et al. 2001, section 2.1): (1 + F) / (1 - F).
float boundaryTerm() {
    constexpr float kIndex = 1.4f;
    constexpr float kReflected = -1.440f / (kIndex * kIndex) + 0.710f / kIndex + 0.668f + 0.0636f * kIndex;
    return (1 + kReflected) / (1 - kReflected);
}

glm::vec3 dermisReflectance(const glm::vec3& absorption) {
    const glm::vec3 scattering = 6.87f * glm::pow(kWavelength / 500.0f, glm::vec3(-1.161f));
    const glm::vec3 albedo = scattering / (scattering + absorption);
    const glm::vec3 root = glm::sqrt(3.0f * (1.0f - albedo));
    return albedo / 2.0f * (1.0f + glm::exp(-4.0f / 3 * boundaryTerm() * root)) * glm::exp(-root);
}

} // namespace

glm::vec3 skinReflectance(const Pigments& pigments) {
    const glm::vec3 melanosomes = 1.70e11f * glm::pow(kWavelength, glm::vec3(-3.48f));
    const glm::vec3 tissue = 0.0244f + 8.53f * glm::exp((154.0f - kWavelength) / 66.2f);
    const glm::vec3 blood = kBloodPerExtinction * glm::mix(kDeoxygenated, kOxygenated, pigments.oxygenation);
    const glm::vec3 epidermis = glm::mix(tissue, melanosomes, pigments.melanin);
    const glm::vec3 dermis = glm::mix(tissue, blood, pigments.blood);
    return glm::exp(-kPath * kEpidermis * epidermis) * dermisReflectance(dermis);
}

} // namespace tegument
