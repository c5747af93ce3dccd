// Transfer curves between stored values, linear light and the display.

#include "host/image/image.h"

#include <cmath>

namespace tegument {

float srgbToLinear(float encoded) {
    if (encoded <= 0.04045f) return encoded / 12.92f;
    return std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float linearToSrgb(float linear) {
    if (linear <= 0.0031308f) return linear * 12.92f;
    return 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// The identity up to kKnee, so that skin, whose radiance stays below it, keeps its chromaticity; above it the hyperbola t / (1 + t), which
/// leaves the line with slope 1 and tends to white. docs/images.md derives it.
float toneMap(float radiance) {
    constexpr float kKnee = 0.8f;
    if (!(radiance > 0)) return 0; // negative and NaN
    if (radiance <= kKnee) return radiance;
    const float t = (radiance - kKnee) / (1 - kKnee);
    // 1 - 1 / (1 + t) is t / (1 + t) without inf / inf
    return kKnee + (1 - kKnee) * (1 - 1 / (1 + t));
}

} // namespace tegument
