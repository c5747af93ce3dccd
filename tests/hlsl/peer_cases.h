#pragma once
// What the cases of hlsl/peers share.

#include "tests/hlsl/maps.h"

#include <numbers>

namespace tegument::test {

inline constexpr double kPeerPi = std::numbers::pi;
inline constexpr double kGoldenAngle = std::numbers::pi * (3 - 2.2360679774997896964);

/// A coordinate near 1, rounded a few times.
[[nodiscard]] inline Argument peerUv(double low = 0.1, double high = 0.9) {
    return linear(low, high, 2, 3e-7);
}

/// The map's red is its depth, about 600: results are brought to where the other colours are, so that a tolerance means the same in all.
inline const dvec4 kScale(0.001, 1, 1, 1);
inline constexpr const char* kScaleCode = "float4(.001, 1, 1, 1) * ";

inline const dvec2 kFrustum(0.22, 0.11);
inline constexpr const char* kFrustumCode = "float2 f = float2(.22, .11); ";

/// The rows of d'Eon and Luebke's table as HLSL, and as numbers.
inline constexpr const char* kGaussianRows =
    "float4 g[6] = {float4(.233, .455, .649, .0064), float4(.1, .336, .344, .0484), float4(.118, .198, 0, .187), "
    "float4(.113, .007, .007, .567), float4(.358, .004, 0, 1.99), float4(.078, 0, 0, 7.41)}; ";

/// Place in view space of what is seen at uv.
[[nodiscard]] inline dvec3 viewPlace(const dvec2& uv, double depth, const dvec2& frustum) {
    return depth * dvec3((2 * uv.x - 1) * frustum.x, (1 - 2 * uv.y) * frustum.y, 1);
}

/// Where it is seen.
[[nodiscard]] inline dvec2 viewUv(const dvec3& place, const dvec2& frustum) {
    return {0.5 + 0.5 * place.x / place.z / frustum.x, 0.5 - 0.5 * place.y / place.z / frustum.y};
}

/// Of a pixel: a fraction of 53 fractions.
struct ScreenNoise {
    double inner = 0;
    double value = 0;

    explicit ScreenNoise(const dvec2& place) {
        const dvec2 pixel = floor(place);
        inner = fract(0.06711056 * pixel.x + 0.00583715 * pixel.y);
        value = fract(52.9829189 * inner);
    }
    [[nodiscard]] bool isClear() const { return inner > 1e-4 && inner < 1 - 1e-4 && value > 1e-3 && value < 1 - 1e-3; }
};

/// Along the surface by pixel: half of the way from the place before to the one behind, so that either direction has the same length.
[[nodiscard]] dvec3 pixelTangent(const TestMap& map, const dvec2& uv, const dvec2& axis, const dvec2& frustum);

} // namespace tegument::test
