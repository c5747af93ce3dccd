#pragma once
// How far an engine's target is from the one that Vulkan drew, and how far it may be.

#include "tests/d3d/cases.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tegument::test {

enum class Kind { Float, Half, Share, Depth, Picture };

/// Largest difference that passes, by kind, in units of the target's largest magnitude where that is above 1. Of kFew of the pixels any:
/// where an edge (of a triangle, a shadow, a strand) passes within the last bit of a pixel's middle, it falls to either side, on each
/// processor and by each compiler at other pixels.
[[nodiscard]] double tolerance(Kind kind);
inline constexpr double kFew = 1.0 / 2048;

/// A target that Vulkan has drawn.
struct DrawnTarget {
    std::string name; // "picture": the application's
    Kind kind = Kind::Float;
    bool stencil = false; // beside its depth
};
[[nodiscard]] std::vector<DrawnTarget> targetsOf(const Case& drawn);

/// Direct3D 9 hands out no depth, the client of Direct3D 12 none with a stencil beside it.
[[nodiscard]] bool readable(Engine engine, const DrawnTarget& target);

/// Over every channel of every pixel; a value that is not a number counts as infinitely far.
struct Distance {
    double scale = 1;   // what differences are measured in
    double largest = 0; // in these units, like the others
    double p999 = 0;    // 99.9 % of the pixels differ by no more
    int x = 0;          // of the largest
    int y = 0;
    std::size_t beyond = 0;  // pixels beyond the tolerance
    std::size_t farther = 0; // pixels beyond the known difference, where there is one
    std::size_t pixels = 0;
};

/// An Error: no drawing, or another size.
[[nodiscard]] Result<Distance> distance(const Case& drawn, Engine engine, const DrawnTarget& target);

/// A known difference in more than a few pixels: where, how many, how far, and why.
struct Exception {
    Engine engine = Engine::Direct3D9;
    std::string cases;   // beginning of their names
    std::string targets; // beginning of their names
    double largest = 0;  // in the units of Distance; of all pixels but a few
    double beyond = 0;   // share of the pixels beyond the tolerance
    std::string reason;
};
[[nodiscard]] const std::vector<Exception>& exceptions();
/// Null: the tolerance holds for every pixel.
[[nodiscard]] const Exception* exceptionFor(const Case& drawn, Engine engine, const DrawnTarget& target);

} // namespace tegument::test
