#pragma once
// Light in skin of any shape by following photons in it: what a diffusion profile and brute force over the surface stand for. The epidermis
// is a shell of even thickness under the surface, the dermis what it encloses; the surface is smooth. Light that leaves is gone: none
// enters a second time.

#include "lab/reference/surface.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace tegument::reference {

/// At one wavelength, per mm.
struct LayerOptics {
    double scattering = 0; // reduced
    double absorption = 0;
};

/// Scattering is Henyey and Greenstein's within `deep` of the surface, below isotropic with the same reduced coefficient.
struct Flesh {
    LayerOptics epidermis;
    LayerOptics dermis;
    double thickness = 0.08; // of the epidermis, mm
    double index = 1.4;      // of refraction; outside: 1
    double anisotropy = 0.8; // g, the mean cosine
    double deep = 1.2;       // mm
};

/// A photon that leaves, or its share: it is split at the surface.
struct LeavingPhoton {
    glm::dvec3 place{0};
    std::uint32_t triangle = 0; // of a mesh; of a plate 0 the upper face, 1 the lower one
    double energy = 0;          // of 1 that was sent
    double inEpidermis = 0;     // mm of way
    double inDermis = 0;
};

/// The space that flesh fills.
class Body {
public:
    virtual ~Body() = default;

    struct Border {
        double distance = 0; // mm
        glm::dvec3 normal{0};
        std::uint32_t triangle = 0;
    };
    /// mm from a place inside to the surface, where that is less than `most`; else `most`.
    [[nodiscard]] virtual double depth(const glm::dvec3& place, double most) const = 0;
    /// Where the way leaves, if within `most` mm.
    [[nodiscard]] virtual std::optional<Border> border(const glm::dvec3& place, const glm::dvec3& direction, double most) const = 0;
};

/// 0 < z < thickness, which may be infinite.
class PlateBody : public Body {
public:
    explicit PlateBody(double thickness) : thickness_(thickness) {}
    [[nodiscard]] double depth(const glm::dvec3& place, double most) const override;
    [[nodiscard]] std::optional<Border> border(const glm::dvec3& place, const glm::dvec3& direction, double most) const override;

private:
    double thickness_;
};

/// Inside a closed mesh whose faces look outwards.
class MeshBody : public Body {
public:
    explicit MeshBody(const RayScene& surface) : surface_(surface) {}
    [[nodiscard]] double depth(const glm::dvec3& place, double most) const override;
    [[nodiscard]] std::optional<Border> border(const glm::dvec3& place, const glm::dvec3& direction, double most) const override;

private:
    const RayScene& surface_;
};

/// A random number of 0 <= u < 1.
using Uniform = std::function<double()>;

/// From a place just inside, until nothing is left of it. `leave` hears of every part that leaves. The energy that was lost: a photon that
/// finds itself outside, for places are rounded, or one that has gone 400 mm.
double followInBody(const Body& body, const Flesh& flesh, const glm::dvec3& place, const glm::dvec3& direction, double energy,
                    const Uniform& uniform, const std::function<void(const LeavingPhoton&)>& leave);

/// Of a direction towards a surface of index 1 outside: what is mirrored, and the direction inside. `normal` looks outwards.
struct Entering {
    double mirrored = 1;
    glm::dvec3 direction{0};
};
[[nodiscard]] Entering entering(const glm::dvec3& direction, const glm::dvec3& normal, double index);

struct BodyPhotonOptions {
    std::size_t photons = 1'000'000;
    std::uint64_t seed = 1;
    bool cached = true;                                                  // block by block: a run that was cut off goes on where it stood
    std::function<void(std::size_t done, std::size_t total)> progress{}; // of blocks
};

/// Power by triangle, of parallel light of 1 per mm^2 across its way.
struct BodyLight {
    static constexpr std::size_t kBlocks = 64;

    std::vector<double> entered;             // without shadows' photons and what is mirrored
    std::array<std::vector<double>, 2> left; // of two independent halves of the photons: each estimates the whole
    std::vector<double> variance;            // of the mean of both, from the spread between blocks
    double lost = 0;                         // share of what entered

    [[nodiscard]] double leaving(std::uint32_t triangle) const { return 0.5 * (left[0][triangle] + left[1][triangle]); }
};
/// All cores; the same whatever their number. `toLight`: unit.
[[nodiscard]] BodyLight photonsInBody(const RayScene& surface, const Flesh& flesh, const glm::dvec3& toLight,
                                      const BodyPhotonOptions& options);

} // namespace tegument::reference
