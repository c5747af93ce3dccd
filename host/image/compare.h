#pragma once
// Two pictures of the same size, held against each other in linear radiance.

#include "host/image/image.h"

namespace tegument {

/// Differences of the first three channels (or as many as there are). Relative figures are to the reference's mean.
struct Difference {
    double relativeL2 = 0; // |a - b| / |b|, Euclidean norms over all values
    double p99 = 0;        // percentiles of |a - b| / mean(b)
    double p999 = 0;
    double largest = 0; // |a - b| / mean(b)
    int largestX = 0;   // where that is
    int largestY = 0;
    double bias = 0;   // mean(a - b) / mean(b)
    double beyond = 0; // share of pixels with a channel that differs by more than `limit` * mean(b)
    std::size_t pixelsBeyond = 0;
};

/// TG5260 when the sizes differ, TG5261 when the reference is black or a value is not finite.
[[nodiscard]] Result<Difference> compareImages(const Image& image, const Image& reference, double limit = 1e-3);

/// |a - b| / mean(b) of every value, as a picture of `image`'s size with three channels. The sizes must agree.
[[nodiscard]] Image differenceImage(const Image& image, const Image& reference);

} // namespace tegument
