#pragma once
// Convolution of a given map in texture space, evaluated directly: each texel from all texels that its kernel reaches.

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace tegument::reference {

/// A square map in double precision. Texels that are not valid lie outside the charts and have no part in anything.
struct Map {
    int size = 0;
    std::vector<glm::dvec4> texels;
    std::vector<std::uint8_t> valid;

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] bool has(int x, int y) const { return x >= 0 && y >= 0 && x < size && y < size && valid[index(x, y)] != 0; }
    /// Bilinear over the valid ones of four texels; zero, and false, where there is none.
    [[nodiscard]] bool lookUp(const glm::dvec2& uv, glm::dvec4& value) const;
};

/// Weights T(n, t) = exp(-t) I_n(t), n = 0, 1, ...: the Gaussian of variance t on a grid (Lindeberg 1990). Like the continuous one it is
/// positive, sums to 1 over all n, has exactly this variance, and T(a) * T(b) = T(a + b); for t above 1 the two agree. Cut where the rest
/// is below 1e-7.
[[nodiscard]] std::vector<double> gridGaussian(double variance);

/// Variance in squared texels along u and v.
struct Spread {
    double u = 0;
    double v = 0;
};

/// Per valid texel, sum of weights times valid texels, divided by the sum of weights. It takes every
/// chart that it reaches in the map, as the effects do.
[[nodiscard]] Map gaussian(const Map& map, const std::function<Spread(int x, int y)>& spread);

/// One direction of the printed kernel: seven taps `spacing` texels apart, interpolated between texel centres. An invalid tap takes the
/// centre's value, an invalid centre the first valid tap (seed, Table 7). Alpha of what is valid: at most 0.99.
inline constexpr std::array<double, 7> kPrintedKernel = {.006, .061, .242, .383, .242, .061, .006};
[[nodiscard]] Map sevenTaps(const Map& map, bool alongU, const std::function<double(int x, int y)>& spacing);

/// The 12 points of the Poisson disc as printed.
inline constexpr std::array<std::array<double, 2>, 12> kPrintedDisc = {{{-.326212, -.40581},
                                                                        {-.840144, -.07358},
                                                                        {-.695914, .457137},
                                                                        {-.203345, .620716},
                                                                        {.96234, -.194983},
                                                                        {.473434, -.480026},
                                                                        {.519456, .767022},
                                                                        {.185461, -.893124},
                                                                        {.507431, .064425},
                                                                        {.89642, .412458},
                                                                        {-.32194, -.932615},
                                                                        {-.791559, -.59771}}};

struct Disc {
    glm::dvec2 radius{0}; // in texels
    double turn = 0;      // radians
    bool centred = false; // the points' own mean subtracted
    bool repair = false;  // Table 7; else the mean over the valid taps
};
/// Mean of the texel and of twelve, nearest to the points of the disc. Alpha stays.
[[nodiscard]] Map poisson(const Map& map, const std::function<Disc(int x, int y)>& disc);

} // namespace tegument::reference
