// hlsl/surface against the formulas of docs/conventions.md and docs/design/modules/Stretch.md.

#include "tests/hlsl/function_case.h"

namespace tegument::test {

namespace {

constexpr double kLengthOfZero = 1e-10; // vectors shorter than this shrink towards zero instead of becoming unit vectors

dvec3 normalised(const dvec3& v) {
    return v / max(length(v), kLengthOfZero);
}

} // namespace

Cases surfaceCases() {
    Cases cases;
    cases.add("tgSafeNormalize(a0)", {vector(3, 1e-8, 1e6)}, {6, 2, 0, "a dot product, rsqrt (2 ULP in Vulkan), a product"},
              [](In x) { return normalised(x.vec3(0)); });
    cases.add("tgSurfaceNormal(a0, float4(a1, a2 < 0.5 ? 1.0 : -1.0), a3)", {unit(), unit(), linear(0, 1), linear(0, 1, 3)},
              {8, 4, 1e-6, "sums of three terms that may cancel; then normalised"}, [](In x) {
                  const dvec3 normal = x.vec3(0);
                  const dvec3 tangent = x.vec3(1);
                  const double sign = x[2] < 0.5 ? 1 : -1;
                  const dvec3 t = 2.0 * x.vec3(3) - 1.0;
                  return normalised(t.x * tangent + t.y * sign * cross(normal, tangent) + t.z * normal);
              });
    cases.back().domain = [](In x) {
        const dvec3 t = 2.0 * x.vec3(3) - 1.0;
        const dvec3 sum = t.x * x.vec3(1) + t.y * cross(x.vec3(0), x.vec3(1)) + t.z * x.vec3(0);
        return length(sum) > 0.1; // shorter ones come from maps that hold no normal
    };
    cases.add("tgStretchEncode(a0, a1, a2)", {vector(3, 1e-5, 100), vector(3, 1e-5, 100), linear(1, 16384)},
              {8, 1, 0, "length (an inverse square root) and a quotient, 2.5 ULP each"}, [](In x) {
                  const dvec2 mm{length(x.vec3(0)), length(x.vec3(1))};
                  return 102.4 / (max(mm, 1e-3) * x[2]);
              });
    cases.add("tgStretchUvPerMillimetre(a0)", {vector(4, 1e-6, 10)}, {4, 0, 0, "a quotient by a constant that rounds itself"},
              [](In x) { return x.vec2(0) / 102.4; });
    cases.add("tgUnwrapPosition(a0, a1)", {linear(-1, 2, 2), linear(0, 1)}, {1, 0, 0, "doubling is exact, one difference"},
              [](In x) { return values(2 * x[0] - 1, 1 - 2 * x.scalar(0, 1), x[1], 1); });
    cases.add("tgNormalZ(a0)", {linear(-1, 1, 2)}, {6, 4, 4e-4, "the root of a difference that keeps 1.2e-7, where it is 0"},
              [](In x) { return sqrt(max(1 - dot(x.vec2(0), x.vec2(0)), 0.0)); });
    cases.add("tgSurfaceNormal(float3(0, 0, 1), float4(1, 0, 0, 1), a0)", {linear(0, 1, 3)}, {8, 4, 4e-4, "as tgNormalZ"},
              {.defines = {{"TEGUMENT_NORMAL_XY", "1"}}}, [](In x) {
                  const dvec2 xy = 2.0 * x.vec2(0) - 1.0;
                  return normalised({xy, sqrt(max(1 - dot(xy, xy), 0.0))});
              });
    cases.add({"tgHalvesOf", "float2 h = tgHalvesOf(a0, 1.0); return float4(h, h.x + h.y, abs(h.y) <= 0.5);"}, {linear(0, 2000)},
              {1, 0, 1e-7, "powers of two: nothing rounds but the sum with a half"}, [](In x) {
                  const double high = floor(x[0] + 0.5);
                  return values(high, x[0] - high, x[0], 1);
              });
    cases.back().domain = [](In x) { return abs(x[0] + 0.5 - round(x[0] + 0.5)) > 1e-3; };
    cases.add("tgHalvesSum(a0)", {linear(-10, 10, 2)}, {1, 0, 1e-6, "one sum"}, [](In x) { return x[0] + x.scalar(0, 1); });
    return cases;
}

} // namespace tegument::test
