// hlsl/surface against the formulas of docs/conventions.md and docs/design/modules/Stretch.md.

#include "tests/hlsl/function_case.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

constexpr double kLengthOfZero = 1e-10; // vectors shorter than this shrink towards zero instead of becoming unit vectors

glm::dvec3 normalised(const glm::dvec3& v) {
    return v / std::max(glm::length(v), kLengthOfZero);
}

} // namespace

std::vector<FunctionCase> surfaceCases() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgSafeNormalize",
                     .body = "return float4(tgSafeNormalize(a0), 0);",
                     .arguments = {vector(3, 1e-8, 1e6)},
                     .expected = [](const Inputs& x) { return values(normalised(x.vec3(0))); },
                     .tolerance = {.forward = 6, .backward = 2, .why = "a dot product, rsqrt (2 ULP in Vulkan), a product"}});
    cases.push_back(
        {.function = "tgSurfaceNormal",
         .body = "return float4(tgSurfaceNormal(a0, float4(a1, a2 < 0.5 ? 1.0 : -1.0), a3), 0);",
         .arguments = {unit(), unit(), linear(0, 1), linear(0, 1, 3)},
         .expected =
             [](const Inputs& x) {
                 const glm::dvec3 normal = x.vec3(0);
                 const glm::dvec3 tangent = x.vec3(1);
                 const double sign = x.scalar(2) < 0.5 ? 1 : -1;
                 const glm::dvec3 t = 2.0 * x.vec3(3) - 1.0;
                 return values(normalised(t.x * tangent + t.y * sign * glm::cross(normal, tangent) + t.z * normal));
             },
         .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-6, .why = "sums of three terms that may cancel; then normalised"},
         .domain =
             [](const Inputs& x) {
                 const glm::dvec3 t = 2.0 * x.vec3(3) - 1.0;
                 const glm::dvec3 sum = t.x * x.vec3(1) + t.y * glm::cross(x.vec3(0), x.vec3(1)) + t.z * x.vec3(0);
                 return glm::length(sum) > 0.1; // shorter ones come from maps that hold no normal
             }});
    cases.push_back({.function = "tgStretchEncode",
                     .body = "return float4(tgStretchEncode(a0, a1, a2), 0, 0);",
                     .arguments = {vector(3, 1e-5, 100), vector(3, 1e-5, 100), linear(1, 16384)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec2 mm{glm::length(x.vec3(0)), glm::length(x.vec3(1))};
                             return values(102.4 / (glm::max(mm, 1e-3) * x.scalar(2)));
                         },
                     .tolerance = {.forward = 8, .backward = 1, .why = "length (an inverse square root) and a quotient, 2.5 ULP each"}});
    cases.push_back({.function = "tgStretchUvPerMillimetre",
                     .body = "return float4(tgStretchUvPerMillimetre(a0), 0, 0);",
                     .arguments = {vector(4, 1e-6, 10)},
                     .expected = [](const Inputs& x) { return values(x.vec2(0) / 102.4); },
                     .tolerance = {.forward = 4, .backward = 0, .why = "a quotient by a constant that rounds itself"}});
    cases.push_back({.function = "tgUnwrapPosition",
                     .body = "return tgUnwrapPosition(a0, a1);",
                     .arguments = {linear(-1, 2, 2), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(2 * x.scalar(0) - 1, 1 - 2 * x.scalar(0, 1), x.scalar(1), 1); },
                     .tolerance = {.forward = 1, .backward = 0, .why = "doubling is exact, one difference"}});
    cases.push_back(
        {.function = "tgNormalZ",
         .body = "return float4(tgNormalZ(a0), 0, 0, 0);",
         .arguments = {linear(-1, 1, 2)},
         .expected = [](const Inputs& x) { return values(std::sqrt(std::max(1 - glm::dot(x.vec2(0), x.vec2(0)), 0.0))); },
         .tolerance = {.forward = 6, .backward = 4, .absolute = 4e-4, .why = "the root of a difference that keeps 1.2e-7, where it is 0"}});
    cases.push_back({.function = "tgSurfaceNormal",
                     .body = "return float4(tgSurfaceNormal(float3(0, 0, 1), float4(1, 0, 0, 1), a0), 0);",
                     .arguments = {linear(0, 1, 3)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec2 xy = 2.0 * x.vec2(0) - 1.0;
                             return values(normalised({xy, std::sqrt(std::max(1 - glm::dot(xy, xy), 0.0))}));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 4e-4, .why = "as tgNormalZ"},
                     .defines = {{"TEGUMENT_NORMAL_XY", "1"}}});
    cases.push_back(
        {.function = "tgHalvesOf",
         .body = "float2 h = tgHalvesOf(a0, 1.0); return float4(h, h.x + h.y, abs(h.y) <= 0.5);",
         .arguments = {linear(0, 2000)},
         .expected =
             [](const Inputs& x) {
                 const double high = std::floor(x.scalar(0) + 0.5);
                 return values(high, x.scalar(0) - high, x.scalar(0), 1);
             },
         .tolerance = {.forward = 1, .backward = 0, .absolute = 1e-7, .why = "powers of two: nothing rounds but the sum with a half"},
         .domain = [](const Inputs& x) { return std::abs(x.scalar(0) + 0.5 - std::round(x.scalar(0) + 0.5)) > 1e-3; }});
    cases.push_back({.function = "tgHalvesSum",
                     .body = "return float4(tgHalvesSum(a0), 0, 0, 0);",
                     .arguments = {linear(-10, 10, 2)},
                     .expected = [](const Inputs& x) { return values(x.scalar(0) + x.scalar(0, 1)); },
                     .tolerance = {.forward = 1, .backward = 0, .absolute = 1e-6, .why = "one sum"}});
    return cases;
}

} // namespace tegument::test
