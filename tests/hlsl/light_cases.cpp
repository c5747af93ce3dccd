// hlsl/light against the formulas of docs/design/light.md.

#include "tests/hlsl/function_case.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

std::vector<FunctionCase> surroundings() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgSurroundingsLevel",
                     .body = "return float4(tgSurroundingsLevel(a0), 0, 0, 0);",
                     .arguments = {linear(0, 2)},
                     .expected = [](const Inputs& x) { return values(std::min(x.scalar(0) / 0.15, 3.0)); },
                     .tolerance = {.forward = 4, .why = "a quotient, and 0.15 rounded"}});
    cases.push_back({.function = "tgSurroundingsDirection",
                     .body = "return float4(tgSurroundingsDirection(a0, a1), 0);",
                     .arguments = {unit(), whole(0, 4)},
                     .expected =
                         [](const Inputs& x) {
                             // The face's own coordinate stays, the other two go to the centres of its outermost texels.
                             glm::dvec3 d = x.vec3(0);
                             const glm::dvec3 a = glm::abs(d);
                             const double most = std::max({a.x, a.y, a.z});
                             const double side = 256 / std::exp2(x.scalar(1));
                             for (int i = 0; i < 3; ++i)
                                 if (a[i] < most) d[i] *= (side - 1) / side;
                             return values(d);
                         },
                     .tolerance = {.forward = 8, .backward = 2, .absolute = 1e-6, .why = "exp2, a quotient and two products of about 1"},
                     // Where two are the largest within rounding, either may be shrunk: both are the same edge of the cube.
                     .domain =
                         [](const Inputs& x) {
                             std::array<double, 3> a = {std::abs(x.scalar(0, 0)), std::abs(x.scalar(0, 1)), std::abs(x.scalar(0, 2))};
                             std::ranges::sort(a);
                             return a[2] - a[1] > 1e-5;
                         }});
    cases.push_back({.function = "tgSurroundingsTurned",
                     .body = "return float4(tgSurroundingsTurned(a0, a1), 0);",
                     .arguments = {unit(), linear(-1, 1, 2)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec3 d = x.vec3(0);
                             const glm::dvec2 t = x.vec2(1);
                             return values(glm::dvec3(d.x * t.y - d.z * t.x, d.y, d.x * t.x + d.z * t.y));
                         },
                     .tolerance = {.absolute = 4e-7, .why = "two products of at most 1, and their sum"}});
    cases.push_back(
        {.function = "tgSurroundingsNormal",
         .body = "return float4(tgSurroundingsNormal(a0, a1, a2), 0);",
         .arguments = {unit(), unit(), unit()},
         .expected = [](const Inputs& x) { return values(glm::normalize(x.vec3(0) + x.vec3(2) - x.vec3(1))); },
         .tolerance = {.forward = 8, .absolute = 2e-5, .why = "sums of unit vectors, 6e-8 each, over a length of at least 0.02"},
         .domain = [](const Inputs& x) { return glm::length(x.vec3(0) + x.vec3(2) - x.vec3(1)) > 0.02; }});
    cases.push_back({.function = "tgSurroundingsReflectedShare",
                     .body = "return float4(tgSurroundingsReflectedShare(a0, a1, a2), 0, 0, 0);",
                     .arguments = {cosine(), linear(0, 1), linear(0, 1)},
                     .expected =
                         [](const Inputs& x) {
                             const double base = std::max(std::clamp(x.scalar(0), 0.0, 1.0) + x.scalar(1), 1e-4);
                             return values(std::clamp(std::pow(base, std::exp2(-16 * x.scalar(2) - 1)) - 1 + x.scalar(1), 0.0, 1.0));
                         },
                     .tolerance = {.forward = 8,
                                   .backward = 4,
                                   .absolute = 4e-6,
                                   .why = "exp2 of up to 17: 37 ULP; pow of an exponent of at most 0.5; sums of about 1"}});
    cases.push_back({.function = "tgEnergyAlbedo",
                     .body = "return float4(tgEnergyAlbedo(a0), 0, 0, 0);",
                     .arguments = {linear(0, 4)},
                     .expected = [](const Inputs& x) { return values(x.corrected() ? x.scalar(0) : x.scalar(0) / 3.14159265358979); },
                     .tolerance = {.forward = 4, .why = "one product, and pi rounded"},
                     .settings = {0, 1, 2}});
    return cases;
}

/// A smooth step, as HLSL's.
double smooth(double share) {
    const double s = std::clamp(share, 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

std::vector<FunctionCase> lamps() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgLampVector",
                     .body = "return float4(tgLampVector(float4(a0, a2), a1), 0);",
                     .arguments = {linear(-1000, 1000, 3), linear(-1000, 1000, 3), whole(0, 1)},
                     .expected = [](const Inputs& x) { return values(x.scalar(2) > 0.5 ? x.vec3(0) - x.vec3(1) : x.vec3(0)); },
                     .tolerance = {.why = "one difference"}});
    cases.push_back(
        {.function = "tgLampFalloff",
         .body = "return float4(tgLampFalloff(a0, a1), 0, 0, 0);",
         .arguments = {logarithmic(1e-2, 1e4), linear(0, 1000)},
         .expected = [](const Inputs& x) { return values(x.scalar(1) > 0 ? std::pow(x.scalar(1) / std::max(x.scalar(0), 1e-6), 2) : 1); },
         .tolerance = {.forward = 8, .why = "a quotient of 2.5 ULP, squared"}});
    cases.push_back(
        {.function = "tgLampSpot",
         .body = "return float4(tgLampSpot(a0, a1, a2, a3), 0, 0, 0);",
         .arguments = {unit(), unit(), linear(0.5, 1), linear(-2, 0.4)},
         .expected =
             [](const Inputs& x) {
                 const double cosine = -glm::dot(x.vec3(0), x.vec3(1));
                 return values(smooth((cosine - x.scalar(3)) / std::max(x.scalar(2) - x.scalar(3), 1e-4)));
             },
         .tolerance = {.forward = 8, .absolute = 8e-6, .why = "a cosine of 3e-7 over a range of at least 0.1, and a slope of 1.5"}});
    cases.push_back({.function = "tgLampSine",
                     .body = "return float4(tgLampSine(a0, a1, a2), 0, 0, 0);",
                     .arguments = {linear(0, 2), logarithmic(1e-2, 1e3), whole(0, 1)},
                     .expected =
                         [](const Inputs& x) {
                             const double sine = x.scalar(2) > 0.5 ? x.scalar(0) / std::max(x.scalar(1), 1e-6) : x.scalar(0);
                             return values(std::clamp(sine, 0.01, 0.7071));
                         },
                     .tolerance = {.forward = 4, .why = "a quotient"}});
    // By the angles themselves: the cap of the open sky, and one that is wider by the lamp's own width.
    cases.push_back({.function = "tgLampOpenShare",
                     .body = "return float4(tgLampOpenShare(a0, a1, a2), 0, 0, 0);",
                     .arguments = {linear(-1, 1), linear(0, 1), linear(0.05, 0.7)},
                     .expected =
                         [](const Inputs& x) {
                             const double cap = std::asin(std::sqrt(x.scalar(1)));
                             const double inner = std::cos(cap);
                             const double outer = std::cos(cap + 2 * std::asin(x.scalar(2)));
                             return values(smooth((x.scalar(0) - outer) / std::max(inner - outer, 1e-4)));
                         },
                     .tolerance = {.forward = 8, .absolute = 2e-4, .why = "cosines of 3e-7 over a range of at least 2 * 0.05^2"}});
    return cases;
}

} // namespace

std::vector<FunctionCase> lightCases() {
    std::vector<FunctionCase> cases = surroundings();
    for (FunctionCase& lamp : lamps())
        cases.push_back(std::move(lamp));
    return cases;
}

} // namespace tegument::test
