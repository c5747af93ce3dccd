#pragma once
// Light in layered tissue by following photons: what a diffusion profile stands for, without diffusion theory. Layers are flat and endless,
// interfaces smooth, scattering isotropic with reduced coefficients, as diffusion models take it.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tegument::reference {

/// Lengths in mm. The last layer may be endless: infinity.
struct Layer {
    double absorption = 0; // per mm
    double scattering = 0; // reduced, per mm
    double thickness = 0;
    double index = 1.4; // of refraction; above and below all layers: 1
};
/// From the surface down, for one wavelength.
using Tissue = std::vector<Layer>;

/// Unpolarised light from index `from` into `to`; `cosine` > 0 on the side that it comes from.
struct FresnelShare {
    double mirrored = 1;
    double cosine = 0; // on the other side; 0 where all is mirrored
};
[[nodiscard]] FresnelShare fresnelShare(double from, double to, double cosine);

/// Donner and Jensen (2005): epidermis 0.25 mm, upper dermis 0.20 mm, bloody dermis; coefficients in 1/cm (their figures in 1/mm would
/// leave scattering radii of 0.06 mm), indices 1.4, 1.34, 1.4. `channel`: 0 red, 1 green, 2 blue.
[[nodiscard]] Tissue layeredSkin(int channel);
/// Epidermis, upper dermis, `bloody` mm of bloody dermis, upper dermis, epidermis: an ear.
[[nodiscard]] Tissue skinSlab(int channel, double bloody);

enum class Launch {
    Normal, // a beam from above, perpendicular: a part is reflected, the rest enters
    Diffuse // starts inside the surface, directions by the cosine law: light that has already crossed it
};

struct PhotonOptions {
    std::size_t photons = 1'000'000;
    Launch launch = Launch::Diffuse;
    std::uint64_t seed = 1;
};

/// What leaves the upper surface by its distance from the start, in rings that grow in proportion to their radius.
class RingHistogram {
public:
    static constexpr double kInnermost = 1e-3; // mm: radius of the first ring's outer edge
    static constexpr double kOutermost = 200;  // mm: all that is further counts there
    static constexpr std::size_t kRings = 600;

    void add(double radius, double energy) { energy_[ringOf(radius)] += energy; }
    void add(const RingHistogram& other);
    void scale(double factor);

    [[nodiscard]] double total() const;
    /// Energy within a radius: linear in the radius inside a ring.
    [[nodiscard]] double within(double radius) const;
    /// Radius within which this share of the total leaves.
    [[nodiscard]] double radiusOf(double share) const;
    /// Inner edge of a ring; of ring kRings the outer edge of the last.
    [[nodiscard]] static double edge(std::size_t ring);
    [[nodiscard]] static std::size_t ringOf(double radius);
    [[nodiscard]] double energy(std::size_t ring) const { return energy_[ring]; }

private:
    std::vector<double> energy_ = std::vector<double>(kRings, 0.0);
};

/// Shares of the light sent.
struct Photons {
    double mirrored = 0; // by the surface, before entering
    double reflected = 0;
    double transmitted = 0;
    double reflectedError = 0; // standard error of `reflected` and `transmitted`, from the spread between blocks of photons
    double transmittedError = 0;
    RingHistogram rings; // of `reflected`
};

/// All cores. Photons are drawn in blocks with a generator of their own each, so that the result does not depend on how many cores there
/// are.
[[nodiscard]] Photons followPhotons(const Tissue& tissue, const PhotonOptions& options);

} // namespace tegument::reference
