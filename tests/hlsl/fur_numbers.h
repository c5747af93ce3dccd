#pragma once
// What several references of fur have in common: mixed whole numbers, and waves of period 1.

#include "tests/hlsl/function_case.h"

#include <cstdint>

namespace tegument::test {

using Residues = std::array<std::int64_t, 3>;

inline std::int64_t residue(std::int64_t v) {
    constexpr std::int64_t kPrime = 1019;
    return (v % kPrime + kPrime) % kPrime;
}

/// One round, in whole numbers.
inline Residues mixedWhole(const Residues& v) {
    const std::int64_t x = residue(431 * v[0] + 577 * v[1] + 101);
    const std::int64_t y = residue(797 * v[1] + 281 * v[2] + 389);
    const std::int64_t z = residue(163 * v[2] + 907 * v[0] + 733);
    return {residue(y * z + 613 * x), residue(z * x + 613 * y), residue(x * y + 613 * z)};
}

inline double wave(double x) {
    const double t = abs(2 * (x - floor(x)) - 1);
    return 2 * (3 * t * t - 2 * t * t * t) - 1;
}

inline dvec3 waves(const dvec3& x) {
    return {wave(x.x), wave(x.y), wave(x.z)};
}

} // namespace tegument::test
