#pragma once
// Maps that the sampling functions are tested with.

#include "tests/hlsl/function_case.h"

namespace tegument::test {

[[nodiscard]] std::array<float, 4> texelOf(double x, double y = 0, double z = 0, double w = 0);
[[nodiscard]] std::array<float, 4> texelOf(const glm::dvec4& v);

/// A texture of one texel.
[[nodiscard]] TestMap oneTexel(double x, double y = 0, double z = 0, double w = 0);

/// Texels by their column and row.
template <class Texel>
[[nodiscard]] TestMap mapOf(int width, int height, Texel texel) {
    TestMap map{.size = width, .height = height};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            map.texels.push_back(texel(x, y));
    return map;
}

/// 256 texels a side, and nine levels that tell which one was read; of a cube with six faces.
template <class Texel>
[[nodiscard]] TestMap leveledMap(bool cube, Texel texel) {
    TestMap map{.size = 256, .mips = 9, .cube = cube};
    for (int face = 0; face < (cube ? 6 : 1); ++face)
        for (int mip = 0; mip < map.mips; ++mip)
            map.texels.insert(map.texels.end(), std::size_t{1} << (16 - 2 * mip), texel(mip));
    return map;
}

/// A translucent shadow map: (depth about 600, u, v, 1), with steps in depth, a seam in u, and texels without surface (zeros).
[[nodiscard]] const TestMap& shadowMap();

/// The same depth three ways: x, and in two halves y + z; w as above.
[[nodiscard]] const TestMap& halvesMap();

/// An irradiance map: colours, alpha at most 0.99; single texels, rows and a block are invalid, (0, 0, 0, 1).
[[nodiscard]] const TestMap& irradianceMap();

/// Whole numbers up to 8000 in every channel, a seventh of them 0: tables of addresses.
[[nodiscard]] const TestMap& addressMap();

} // namespace tegument::test
