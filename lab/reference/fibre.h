#pragma once
// Light scattered by one fibre: the near-field BCSDF of M. Chiang et al., A Practical and Controllable Hair and Fur Model for Production
// Path Tracing, 2016, with the longitudinal part of E. d'Eon et al. 2011. Directions are unit vectors away from the fibre, in a frame whose
// x runs along it. It keeps energy: without absorption all that comes in goes out.

#include <glm/glm.hpp>

#include <array>

namespace tegument::reference {

struct Fibre {
    double eta = 1.55;
    double along = 0.3; // roughness
    double around = 0.3;
    double tilt = 2; // of the scales, degrees
};

/// Absorption for each radius by which a coat of such fibres has this colour (equation 9).
[[nodiscard]] glm::dvec3 fibreAbsorption(const glm::dvec3& colour, double around);

/// R, TT, TRT and all that is left, seen from one direction.
class FibreScattering {
public:
    /// offset: of the ray to the eye from the axis, radii, in [-1, 1]: sine of the angle from the normal to the eye around the axis.
    FibreScattering(const Fibre& fibre, const glm::dvec3& absorption, const glm::dvec3& toEye, double offset);

    /// Radiance for each unit of irradiance across the light's own direction.
    [[nodiscard]] glm::dvec3 evaluate(const glm::dvec3& toLight) const;

    struct Sampled {
        glm::dvec3 toLight{1, 0, 0};
        glm::dvec3 weight{0}; // evaluate over the density
    };
    [[nodiscard]] Sampled sample(const std::array<double, 4>& random) const;
    /// Of a sampled direction, over solid angle.
    [[nodiscard]] double density(const glm::dvec3& toLight) const;

private:
    static constexpr std::size_t kLobes = 4;
    struct Lobe {
        glm::dvec3 share{0};
        double chance = 0;
        double sine = 0; // of the eye's inclination, turned by the scales
        double cosine = 1;
        double variance = 1;
        double azimuth = 0; // from the eye to its middle
    };
    [[nodiscard]] double around(std::size_t lobe, double azimuth) const;

    std::array<Lobe, kLobes> lobes_;
    double spread_; // scale of the logistic
    double eye_;    // azimuth
};

} // namespace tegument::reference
