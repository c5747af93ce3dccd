#pragma once
// What the cases of locks have in common: parameters of effects/FurCoat.fx, each with a number of its own, and numbers of roots.

#include "tests/hlsl/function_case.h"
#include "tests/hlsl/fur_numbers.h"

namespace tegument::test {

inline constexpr double kLockMesh = 80;      // the mesh's radius
inline constexpr double kLockLength = 0.06;  // of the coat, radii
inline constexpr double kLockRadius = 0.002; // of a strand, radii
inline constexpr double kLockAfar = 1.3;
inline const glm::dvec3 kLockCentre = {3, -5, 7};

inline const glm::dvec3 kLockRoot = {0.1, 0.07, 0.05};
inline const glm::dvec3 kLockMid = {0.36, 0.22, 0.13};
inline const glm::dvec3 kLockTip = {0.66, 0.47, 0.3};
inline const glm::dvec3 kLockUnder = {0.27, 0.19, 0.14};
inline const glm::dvec3 kLockPale = {0.8, 0.7, 0.58};
inline const glm::dvec3 kLockGuards = {0.16, 0.105, 0.08};
inline const glm::dvec3 kLockShort = {0.95, 0.88, 0.82};
inline const glm::dvec3 kLockSky = {0.24, 0.28, 0.34};
inline const glm::dvec3 kLockGround = {0.19, 0.15, 0.12};
inline const glm::dvec3 kLockRim = {0.22, 0.23, 0.26};

inline const std::map<std::string, std::vector<double>> kLockScene = {
    {"gWorld", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
    {"gUnitMm", {1}},
    {"gMeshRadius", {kLockMesh}},
    {"gBoundingCenter", {kLockCentre.x, kLockCentre.y, kLockCentre.z}},
    {"gFurLength", {kLockLength}},
    {"gFurShare", {0.9}},
    {"gRibbonFewest", {0.33}},
    {"gCoatRadius", {kLockRadius}},
    {"gCoatAfar", {kLockAfar}},
    {"gCoatThin", {0.7}},
    {"gCoatUnderThin", {1.05}},
    {"gCoatUnderfur", {3}},
    {"gCoatChildren", {4}},
    {"gCoatGusts", {0.5, 0.7, 0.8}},
    {"gCoatWind", {0.3, -0.2, 0.1}},
    {"gTime", {1.7}},
    {"gCoatRootColor", {kLockRoot.x, kLockRoot.y, kLockRoot.z}},
    {"gCoatMidColor", {kLockMid.x, kLockMid.y, kLockMid.z}},
    {"gCoatTipColor", {kLockTip.x, kLockTip.y, kLockTip.z}},
    {"gCoatUnderColor", {kLockUnder.x, kLockUnder.y, kLockUnder.z}},
    {"gCoatBellyColor", {kLockPale.x, kLockPale.y, kLockPale.z}},
    {"gCoatGuardColor", {kLockGuards.x, kLockGuards.y, kLockGuards.z}},
    {"gCoatShortColor", {kLockShort.x, kLockShort.y, kLockShort.z}},
    {"gCoatSky", {kLockSky.x, kLockSky.y, kLockSky.z}},
    {"gCoatGround", {kLockGround.x, kLockGround.y, kLockGround.z}},
    {"gCoatRim", {kLockRim.x, kLockRim.y, kLockRim.z}},
    {"gCoatUnderLength", {0.55}},
    {"gCoatBelly", {0.8}},
    {"gCoatGuard", {0.16}},
    {"gCoatShort", {0.55}},
    {"gCoatSpread", {0.9}},
    {"gCoatClump", {0.72}},
    {"gCoatLean", {1.1}},
    {"gCoatLocks", {0.5}},
    {"gCoatWaves", {0.45}},
    {"gCoatStray", {0.2}},
    {"gCoatCurl", {0.05}},
    {"gCoatTurns", {1.2}},
    {"gCoatShadow", {0.9}},
    {"gCoatThrough", {0.5}},
    {"gCoatShine", {0.07}},
    {"gCoatSheen", {0.25}},
    {"gCoatShineExponent", {60}},
    {"gCoatSheenExponent", {14}},
    {"gCoatPainted", {0.3}},
};

/// In [0, 1), evenly: golden numbers of a root's column and row in the texture of roots, which is 4,096 wide.
inline double rootRank(double address) {
    const double row = std::floor(address / 4096);
    const double sum = 0.6180340 * (address - 4096 * row) + 0.7548777 * row;
    return sum - std::floor(sum);
}

/// Numbers in (0, 1) of a strand of a lock.
inline glm::dvec3 lockNumbers(double address, double child) {
    const std::int64_t whole = std::llround(address);
    const Residues mixed = mixedWhole({whole % 4096, whole / 4096, 37 * std::llround(child) + 11});
    return (glm::dvec3(static_cast<double>(mixed[0]), static_cast<double>(mixed[1]), static_cast<double>(mixed[2])) + 0.5) / 1019.0;
}

} // namespace tegument::test
