#pragma once
// Fur by path tracing: round curves whose surfaces scatter as fibres, over skin that is dull. Nothing here knows ribbons, maps of
// light or the shaders' model: it is the truth that fur is judged by. Lengths in mm.
// Light scattered by one fibre: the near-field BCSDF of M. Chiang et al., A Practical and Controllable Hair and Fur Model for Production
// Path Tracing, 2016, with the longitudinal part of E. d'Eon et al. 2011. Directions are unit vectors away from the fibre, in a frame whose
// x runs along it. It keeps energy: without absorption all that comes in goes out.

#include "host/image/image.h"
#include "lab/reference/pinhole.h"
#include "lab/reference/surface.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

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

/// A strand from root to tip: places and radii of its axis, joined by straight pieces.
using FibreAxis = std::vector<glm::vec4>;

struct FibreLight {
    enum class Kind { Parallel, Point, Sphere };
    Kind kind = Kind::Parallel;
    glm::dvec3 place{0, 0, 1}; // towards parallel light, unit; else its centre
    glm::dvec3 colour{1};      // irradiance / pi across its rays, at every distance, as the workspace's light has it
    double radius = 0;         // of a sphere
};

struct FibreScene {
    std::vector<FibreAxis> strands;
    Fibre fibre;
    glm::dvec3 colour{0.5}; // of the coat: fibreAbsorption()
    const Mesh* skin = nullptr;
    glm::dvec3 skinColour{0.5};
    std::vector<FibreLight> lights;
    std::function<glm::dvec3(const glm::dvec3& direction)> environment; // radiance; none: black
};

/// Sums over samples, from which a picture and its noise follow.
struct FibreSums {
    int width = 0;
    int height = 0;
    std::uint64_t samples = 0;   // of each pixel
    std::vector<glm::dvec3> sum; // of radiance
    std::vector<glm::dvec3> square;
    std::vector<double> covered; // of camera rays that meet something

    [[nodiscard]] Image picture() const;
    /// Expected relative L2 of the means of blocks of so many pixels a side to the truth: what noise alone adds to a comparison.
    [[nodiscard]] double noise(int block) const;
};

class FibrePaths {
public:
    explicit FibrePaths(FibreScene scene);
    ~FibrePaths();
    FibrePaths(const FibrePaths&) = delete;
    FibrePaths& operator=(const FibrePaths&) = delete;

    /// Radiance towards the origin of a ray. `path`: which of its random numbers.
    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& origin, const glm::dvec3& direction, std::uint64_t path) const;

    /// Adds samples to `sums` until each pixel has so many, on all processors. The same, however often it was interrupted.
    void trace(const Pinhole& camera, std::uint64_t samples, FibreSums& sums) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// As numbers to be kept, so that an interrupted trace can go on; and back.
[[nodiscard]] std::vector<double> numbersOf(const FibreSums& sums);
[[nodiscard]] FibreSums sumsOf(const std::vector<double>& numbers);

} // namespace tegument::reference
