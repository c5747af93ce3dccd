#pragma once
// What the cases of passes of skin have in common: a scene whose every number differs from the others', and what is known of it.

#include "tests/hlsl/maps.h"
#include "tests/hlsl/pass_case.h"

namespace tegument::test {

inline constexpr double kSkinUnit = 0.5; // mm in a unit of the world
inline constexpr double kSkinScale = 2;  // world units in one of the mesh
inline const dvec3 kSkinOrigin = {1, 2, 3};
/// Parallel light along -z from 400 units, over a square of 128 units: 64 mm on the map's 256 texels.
inline constexpr double kSkinLightAt = 400;
inline constexpr double kSkinLightHalf = 64;
inline constexpr double kSkinFootprint = 0.25; // of a texel of the shadow map, mm
inline constexpr double kSkinTolerance = 0.3;  // of shadows, mm
inline const dvec2 kSkinLightShift = {0.125, -0.25};
inline const dvec3 kSkinLight = {0.9, 0.8, 0.7};
inline const dvec3 kSkinCamera = {30, 40, 500};
inline constexpr double kSkinMix = 0.3;
inline constexpr double kSkinRoughness = 0.3;
inline constexpr double kSkinIntensity = 0.4;
inline constexpr double kSkinFresnel0 = 0.04; // of setting corrected
inline constexpr double kPlainRoughness = 0.5;
inline constexpr double kPlainIntensity = 0.6;
inline constexpr double kSkinTransmission = 0.8;
inline constexpr double kTableAlbedo = 0.35; // of the energy table, wherever it is read
/// What the specular layer leaves of light that crosses the surface.
inline constexpr double kSkinLeft = 1 - kSkinIntensity * kTableAlbedo;

inline const std::array<dvec4, 6> kSkinGaussians = {{{0.2, 0.3, 0.4, 0.0064},
                                                     {0.15, 0.25, 0.1, 0.0484},
                                                     {0.1, 0.2, 0.05, 0.187},
                                                     {0.25, 0.12, 0.22, 0.567},
                                                     {0.17, 0.07, 0.13, 1.99},
                                                     {0.13, 0.06, 0.1, 7.41}}};

/// A row of texels; the n-th one of `count` is read at (n + 1/2) / count.
[[nodiscard]] TestMap rowOfTexels(const std::vector<dvec4>& texels);
[[nodiscard]] dvec4 texelOfRow(const TestMap& row, double place);

/// Of a pass of `effect` in this scene.
[[nodiscard]] FunctionCase skinCase(const char* effect, Call call, Arguments arguments, Tolerance tolerance, Reference expected);

/// Light by light, which shader model 3 alone has need of: samplers that look into a map of another name have its name there.
void addLightByLight(FunctionCase& made);

/// colour^exponent.
[[nodiscard]] dvec3 skinColour(const dvec3& albedo, double exponent);
/// Light of the scene's own that enters skin: colour^mix, light, cosine, shadow, and what the specular layer leaves.
[[nodiscard]] dvec3 enteringSkin(const dvec3& albedo, double cosine, double shadow);
/// N.L rho_s PH F / |L + V|^2.
[[nodiscard]] double mirrored(const dvec3& normal, const dvec3& toLight, const dvec3& toEye, double roughness, double intensity);

} // namespace tegument::test
