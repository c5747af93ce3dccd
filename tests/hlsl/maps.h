#pragma once
// Maps that the sampling functions are tested with.

#include "tests/hlsl/function_case.h"

namespace tegument::test {

/// A translucent shadow map: (depth about 600, u, v, 1), with steps in depth, a seam in u, and texels without surface (zeros).
[[nodiscard]] const TestMap& shadowMap();

/// The same depth three ways: x, and in two halves y + z; w as above.
[[nodiscard]] const TestMap& halvesMap();

/// An irradiance map: colours, alpha at most 0.99; single texels, rows and a block are invalid, (0, 0, 0, 1).
[[nodiscard]] const TestMap& irradianceMap();

/// (1 where needed, densities along U and V, 1), needed in a few places.
[[nodiscard]] const TestMap& needMap();

/// Whole numbers up to 8000 in every channel, a seventh of them 0: tables of addresses.
[[nodiscard]] const TestMap& addressMap();

} // namespace tegument::test
