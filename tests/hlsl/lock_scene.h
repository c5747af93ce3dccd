#pragma once
// What the cases of locks have in common: parameters of effects/FurCoat.fx, each with a number of its own, and numbers of roots.

#include "tests/hlsl/fur_numbers.h"
#include "tests/hlsl/fur_view.h"

#include <algorithm>

namespace tegument::test {

inline constexpr double kLockMesh = 80;      // the mesh's radius
inline constexpr double kLockLength = 0.06;  // of the coat, radii
inline constexpr double kLockRadius = 0.002; // of a strand, radii
inline constexpr double kLockAfar = 1.3;
inline const dvec3 kLockCentre = {3, -5, 7};

inline const dvec3 kLockRoot = {0.1, 0.07, 0.05};
inline const dvec3 kLockMid = {0.36, 0.22, 0.13};
inline const dvec3 kLockTip = {0.66, 0.47, 0.3};
inline const dvec3 kLockUnder = {0.27, 0.19, 0.14};
inline const dvec3 kLockPale = {0.8, 0.7, 0.58};
inline const dvec3 kLockGuards = {0.16, 0.105, 0.08};
inline const dvec3 kLockShort = {0.95, 0.88, 0.82};
inline const dvec3 kLockSky = {0.24, 0.28, 0.34};
inline const dvec3 kLockGround = {0.19, 0.15, 0.12};
inline const dvec3 kLockRim = {0.22, 0.23, 0.26};

inline const Globals kLockScene = {
    {"gWorld", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
    {"gUnitMm", {1}},
    {"gMeshRadius", {kLockMesh}},
    {"gBoundingCenter", numbersOf(kLockCentre)},
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
    {"gCoatRootColor", numbersOf(kLockRoot)},
    {"gCoatMidColor", numbersOf(kLockMid)},
    {"gCoatTipColor", numbersOf(kLockTip)},
    {"gCoatUnderColor", numbersOf(kLockUnder)},
    {"gCoatBellyColor", numbersOf(kLockPale)},
    {"gCoatGuardColor", numbersOf(kLockGuards)},
    {"gCoatShortColor", numbersOf(kLockShort)},
    {"gCoatSky", numbersOf(kLockSky)},
    {"gCoatGround", numbersOf(kLockGround)},
    {"gCoatRim", numbersOf(kLockRim)},
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

[[nodiscard]] inline FunctionCase lock(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    FunctionCase made =
        passCase("FurCoat.fx", kLockScene, std::move(call), std::move(arguments), std::move(tolerance), std::move(expected));
    made.samples = 2048;
    return made;
}

/// In [0, 1), evenly: golden numbers of a root's column and row in the texture of roots, which is 4,096 wide.
inline double rootRank(double address) {
    const double row = floor(address / 4096);
    const double sum = 0.6180340 * (address - 4096 * row) + 0.7548777 * row;
    return sum - floor(sum);
}

/// Numbers in (0, 1) of a strand of a lock.
inline dvec3 lockNumbers(double address, double child) {
    const std::int64_t whole = std::llround(address);
    const Residues mixed = mixedWhole({whole % 4096, whole / 4096, 37 * std::llround(child) + 11});
    return (dvec3(static_cast<double>(mixed[0]), static_cast<double>(mixed[1]), static_cast<double>(mixed[2])) + 0.5) / 1019.0;
}

/// Others, made of those.
inline dvec3 lockMore(const dvec3& random) {
    return fract(13.37 * dvec3(random.z, random.x, random.y) + 7.91 * dvec3(random.y, random.z, random.x));
}

/// Of half of a strand, half of them guard hairs: even to two thirds of its length, then a point.
inline double lockRadius(double address, double child, bool under, double along) {
    const dvec3 random = lockNumbers(address, under ? child + 64 : child);
    const double guard = !under && random.z <= 0.5 ? 1 : 0;
    const double own = (0.75 + 0.5 * lockMore(random).y) * (1 + 0.3 * guard - (under ? 0.25 : 0));
    return kLockRadius * kLockMesh * own * (1 - along * along * along);
}

/// How many of a lock's strands are drawn where pixels are so wide, and how much wider: docs/design/fur.md.
struct LockShare {
    double share, begin, width, rank;

    LockShare(double pixel, double thinnest, double strands, double number) {
        const double thin = 2 * kLockRadius * kLockMesh / (thinnest * pixel);
        share = 0.9 * std::clamp(thin, 0.33, 1.0);
        begin = min({-1.75 * (thin - kLockAfar / thinnest), 1.05 * thin - 0.175, 0.35});
        rank = number / strands;
        width = saturate(8 - 8 * rank / share) * 8 / 7.5 / share;
    }
};

/// Strands stand upright, each on a root so dense that nothing stands beside its own. Header and root are one texel.
inline void straighten(FunctionCase& made) {
    static const TestMap kRoots{.size = 1, .texels = {{1, 0, 0, 1e6F}}};
    made.map = &kRoots;
    setAll(made, {"gCoatLean", "gCoatStray", "gCoatCurl", "gCoatWaves", "gCoatLocks"}, {0});
}

/// White everywhere but where the strand brings a colour, no light: what a case sets comes back alone.
inline void whiten(FunctionCase& made) {
    setAll(made,
           {"gCoatRootColor", "gCoatMidColor", "gCoatTipColor", "gCoatUnderColor", "gCoatBellyColor", "gCoatGuardColor", "gCoatShortColor"},
           {1, 1, 1});
    setAll(made, {"gCoatSky", "gCoatGround", "gCoatRim", "gLightColor"}, {0, 0, 0});
    made.globals["gCoatBelly"] = {0};
    made.globals["gCoatPainted"] = {0.5};
    made.globals["gCoatVariation"] = {0.4};
}

} // namespace tegument::test
