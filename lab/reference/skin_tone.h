#pragma once
// The colours of skin from what is in it: melanin in the epidermis, blood in the dermis, by wavelength. Photons are followed once without
// being absorbed; any melanin and blood is then a weight by the ways that they went in both layers.

#include "lab/reference/body_photons.h"
#include "lab/reference/profile.h"
#include "lab/reference/tissue.h"

#include <array>
#include <vector>

namespace tegument::reference {

struct SkinTone {
    double melanin = 0.014;    // share of the epidermis' volume
    double blood = 0.006;      // share of the dermis' volume
    double eumelanin = 0.6;    // of the melanin; the rest is pheomelanin
    double oxygenation = 0.75; // of the blood
};

/// nm. Scattering: epidermis after Donner and Jensen 2006, dermis the mean of skin in Jacques 2013, table 1. Absorption: melanins after
/// Donner and Jensen 2006, skin without either after Jacques 1998, haemoglobin at 150 g/l after Prahl 1999.
[[nodiscard]] Flesh fleshOf(const SkinTone& tone, double wavelength);
/// Of diffusion theory in the dermis, per mm: sqrt(3 mu_a (mu_a + mu_s')).
[[nodiscard]] double effectiveAttenuation(const SkinTone& tone, double wavelength);
/// nm: what stands for red, green and blue where one wavelength must.
inline constexpr std::array<double, 3> kToneColors = {620, 540, 460};
/// c of 1 + c h, per mm: 1.1 times that attenuation, fitted to balls and slabs.
[[nodiscard]] glm::dvec3 fleshFactor(const SkinTone& tone);

/// Wavelengths that a spectrum is known at: 380 to 720 nm in steps of 10.
inline constexpr std::size_t kWavelengths = 35;
using Spectrum = std::array<double, kWavelengths>;
[[nodiscard]] double wavelengthOf(std::size_t i);
/// Linear sRGB of a reflectance under D65, white 1 1 1: CIE 1931 after Wyman, Sloan and Shirley 2013.
[[nodiscard]] glm::dvec3 linearSrgb(const Spectrum& reflectance);

struct SkinColor {
    double lightness = 0; // L*, a*, b*
    double a = 0;
    double b = 0;
    [[nodiscard]] double typologyAngle() const; // degrees: atan((L* - 50) / b*)
};
[[nodiscard]] SkinColor colorOf(const Spectrum& reflectance);
/// Del Bino and Bernerd 2013: "very light" above 55 degrees, "light" 41, "intermediate" 28, "tan" 10, "brown" -30, "dark".
[[nodiscard]] const char* typologyOf(double angle);

/// What a half-space of skin gives back of light that has entered it.
struct ToneResponse {
    std::array<RingHistogram, 3> rings; // by distance; linear sRGB
    glm::dvec3 albedo{0};
    Spectrum spectrum{};
};

class WhitePhotons {
public:
    /// So many photons at each of nine wavelengths, by light from everywhere, all cores.
    WhitePhotons(std::size_t photons, std::uint64_t seed);
    [[nodiscard]] ToneResponse response(const SkinTone& tone) const;

private:
    struct Leaving {
        std::uint32_t ring;
        float inEpidermis, inDermis, energy;
    };
    std::vector<std::vector<Leaving>> nodes_; // by ring
    std::size_t photons_;
};

/// Six Gaussians with these variances (mm^2), shared by all skins and channels, and weights that sum to 1 and are not below 0: least
/// squares of the edge of light and of the share within a radius. The widest is that of the links (meshprep/skin/skin_links.h).
inline constexpr std::array<double, 6> kToneVariances = {0.0004, 0.0081, 0.067081, 0.222784, 1.127844, 7.41};
[[nodiscard]] Profile fittedProfile(const ToneResponse& response);

/// Skins of two numbers, the rest after them: the more melanin, the more of it is eumelanin (Donner and Jensen 2006).
[[nodiscard]] SkinTone toneOf(double melanin, double blood);

/// All these skins in one table: each weight of each Gaussian is a sum of products of Bernstein polynomials over the logarithms of melanin
/// and blood, whose coefficients are not below 0. Weights of a channel sum to the albedo.
inline constexpr std::array<double, 2> kToneMelanin = {0.004, 0.32};
inline constexpr std::array<double, 2> kToneBlood = {0.002, 0.05};
inline constexpr int kToneMelaninDegree = 5;
inline constexpr int kToneBloodDegree = 3;
inline constexpr std::size_t kToneTerms = (kToneMelaninDegree + 1) * (kToneBloodDegree + 1);
using ToneTable = std::array<std::array<glm::dvec3, kToneTerms>, 6>;
/// From 16 x 16 of them, by least squares as above; takes minutes.
[[nodiscard]] ToneTable fittedTable(const WhitePhotons& photons);
/// Outside of the ranges the nearest skin within them.
[[nodiscard]] std::array<double, kToneTerms> toneTerms(double melanin, double blood);
[[nodiscard]] Profile profileOf(const ToneTable& table, double melanin, double blood);

} // namespace tegument::reference
