#pragma once
// Light on strands and in their coat by angles and lengths, and the scene that cases of fur's passes share: a mesh that is turned and
// scaled, so that no axis and no unit stands for another.

#include "tests/hlsl/fur_view.h"

#include <algorithm>
#include <numbers>

namespace tegument::test {

inline constexpr double kFurMesh = 80;     // the mesh's radius
inline constexpr double kFurLength = 0.06; // of the coat, radii
inline constexpr double kFurUnit = 1.5;    // mm
inline constexpr double kFurLean = 0.25;   // how far tips hang
inline constexpr double kFurStrands = 0.8; // how much light knows of strands (gFurKajiyaKay)
inline constexpr double kFurMultiple = 0.7;
inline constexpr double kFurMirrored = 0.08;
inline constexpr double kFurSharpness = 40;
inline constexpr double kFurDense = 1.2;
inline constexpr double kFurRootRadius = 0.3; // of a root, spacings
inline const dvec3 kFurCentre = {3, -5, 7};
inline const dvec3 kFurDown = {0.6, -0.8, 0};
inline const dvec3 kFurEye = {100, -200, 250};
inline const dvec3 kFurDark = {0.16, 0.085, 0.04};
inline const dvec3 kFurPale = {0.72, 0.52, 0.33};
inline const dvec3 kFurAround = {0.1, 0.2, 0.3};

/// A quarter turn about z, twice as large, and moved.
inline dvec3 furTurned(const dvec3& v) {
    return {-v.y, v.x, v.z};
}
inline dvec3 furTurnedBack(const dvec3& v) {
    return {v.y, -v.x, v.z};
}
inline dvec3 furWorld(const dvec3& v) {
    return 2.0 * furTurned(v) + dvec3(7, 8, 9);
}

inline Globals furScene() {
    return with(kFurView, {{"gWorld", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1}},
                           {"gWorldInverseTranspose", {0, 0.5, 0, 0, -0.5, 0, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1}},
                           {"gUnitMm", {kFurUnit}},
                           {"gMeshRadius", {kFurMesh}},
                           {"gBoundingCenter", numbersOf(kFurCentre)},
                           {"gCameraPosition", numbersOf(kFurEye)},
                           {"gFurLength", {kFurLength}},
                           {"gFurLean", {kFurLean}},
                           {"gFurDown", numbersOf(kFurDown)},
                           {"gFurRootColor", numbersOf(kFurDark)},
                           {"gFurTipColor", numbersOf(kFurPale)},
                           {"gFurFill", numbersOf(kFurAround)},
                           {"gFurKajiyaKay", {kFurStrands}},
                           {"gFurMultiple", {kFurMultiple}},
                           {"gFurSpecular", {kFurMirrored}},
                           {"gFurExponent", {kFurSharpness}},
                           {"gFurDensity", {kFurDense}}});
}

inline double share(double x) {
    return saturate(x);
}

/// Three lamps of parallel light: where they come from, and their colours.
inline const std::array<dvec3, 3> kFurLampWays = {dvec3(0.6, 0, 0.8), dvec3(-0.36, 0.48, 0.8), dvec3(0, -0.8, 0.6)};
inline const std::array<dvec3, 3> kFurLampColours = {dvec3(0.5, 0.6, 0.7), dvec3(0.3, 0.2, 0.1), dvec3(0.2, 0.4, 0.9)};

inline void addLamps(FunctionCase& made) {
    made.defines.emplace_back("TEGUMENT_LAMPS", "3");
    made.defines.emplace_back("TEGUMENT_LAMP_SHADOWS", "0");
    for (const dvec3& way : kFurLampWays)
        made.globals["gLampPlace"].insert(made.globals["gLampPlace"].end(), {way.x, way.y, way.z, 0});
    for (const dvec3& colour : kFurLampColours)
        made.globals["gLampColor"].insert(made.globals["gLampColor"].end(), {colour.x, colour.y, colour.z, 0});
    made.globals["gLampAxis"] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    made.globals["gLampSpot"] = {-1, -2, 1, 1, -1, -2, 1, 1, -1, -2, 1, 1};
}

/// Of strands of this albedo in light of colour 1: what they scatter, and what the cone of mirrors around them sends to the eye.
inline dvec3 strandsLit(const dvec3& albedo, const dvec3& strand, const dvec3& toLight, const dvec3& toEye) {
    const double light = asin(std::clamp(dot(strand, toLight), -1.0, 1.0));
    const double eye = asin(std::clamp(dot(strand, toEye), -1.0, 1.0));
    const dvec3 diffuse = albedo * cos(light) * (kFurMultiple + (1 - kFurMultiple) / std::numbers::pi);
    const double cone = pow(max(cos(light + eye), 0.0), kFurSharpness);
    const double mirrored = cos(light) * cone * 0.5 * sqrt((kFurSharpness + 2.0 / 3) / (2 * std::numbers::pi));
    return (1 - kFurMirrored) * diffuse + kFurMirrored * mirrored;
}

/// Way out of the coat of a ball of radius 1, in its thicknesses.
inline double wayThroughCoat(double height, double cosine) {
    const double radius = 1 + height * kFurLength;
    const double across = (1 - cosine * cosine) * radius * radius;
    return (sqrt(max(pow(1 + kFurLength, 2) - across, 0.0)) - radius * cosine) / kFurLength;
}

/// Share of the light that the coat above leaves.
inline double coatLeaves(double height, double cosine) {
    return exp(-kFurDense * wayThroughCoat(height, cosine) * sqrt(max(1 - cosine * cosine, 0.0)));
}

/// What light from all sides leaves of white.
inline double coatFilled(double height) {
    return exp(-kFurDense * (1 - height)) * (0.5 + 0.5 * kFurMultiple);
}

/// Of strands in the coat, under the light of the workspace and light from all sides. No surface throws a shadow.
inline dvec3 strandsInCoat(const dvec3& albedo, const dvec3& strand, const dvec3& normal, const dvec3& toLight, const dvec3& toEye,
                           double height) {
    const double open = coatLeaves(height, dot(normal, toLight));
    return strandsLit(albedo, strand, toLight, toEye) * kFurColour * open + albedo * kFurAround * coatFilled(height);
}

/// Mean of max(1 - h / L, 0) over lengths that lie evenly between the shortest and 1, times a root's radius: a sum over them.
inline double meanStrandRadius(double height, double shortest) {
    constexpr int kLengths = 400;
    double sum = 0;
    for (int i = 0; i < kLengths; ++i)
        sum += max(1 - height / (shortest + (1 - shortest) * (i + 0.5) / kLengths), 0.0);
    return kFurRootRadius * sum / kLengths;
}

/// What is met, and what a ray meets on average of such strands between two heights. x: coverage; y to w: its shares as in MetPiece.
inline dvec4 strandsExpected(const dvec4& met, double density, double shortest, const dvec2& heights, double beyond) {
    const dvec2 r(meanStrandRadius(heights.x, shortest), meanStrandRadius(heights.y, shortest));
    const double swept = (r.x + r.y) * beyond + std::numbers::pi * (r.y * r.y - r.x * r.x);
    // Weights of the ends where the width changes evenly: twice the own radius and once the other.
    const double height = ((2 * r.x + r.y) * heights.x + (2 * r.y + r.x) * heights.y) / (3 * (r.x + r.y) + 1e-4);
    return met + (1 - met.x) * (1 - exp(-density * swept)) * dvec4(1, height, share(2 * height / (1 + shortest)), 1);
}

inline double furFromLamp(const dvec3& world) {
    return kFurUnit * length(kFurLamp - world);
}

} // namespace tegument::test
