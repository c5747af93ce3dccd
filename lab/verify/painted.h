#pragma once
// Pictures that generated bodies wear.

#include "host/image/image.h"

#include <glm/glm.hpp>

#include <cmath>

namespace tegument::verify {

/// A function of u and v with values in 0..1, rounded to this many bits; size x size texels.
template <class Function>
[[nodiscard]] Image painted(int size, int bits, Function function) {
    const double largest = std::ldexp(1.0, bits) - 1;
    Image image{.width = size, .height = size, .channels = 4, .bitsPerChannel = bits};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::dvec4 value = function((x + 0.5) / size, (y + 0.5) / size);
            for (int c = 0; c < 4; ++c)
                image.pixels.push_back(static_cast<float>(std::round(largest * value[c]) / largest));
        }
    return image;
}

} // namespace tegument::verify
