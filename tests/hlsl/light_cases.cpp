// hlsl/light against the formulas of docs/design/light.md.

#include "lab/reference/specular.h"
#include "tests/hlsl/function_case.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

/// Where the surface mirrors its mean over a hemisphere, weighed by the cosine.
double evenCosine(double m) {
    constexpr double kF0 = 0.04;
    constexpr int kSteps = 64;
    double mean = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double cosine = (i + 0.5) / kSteps;
        mean += 2 * cosine / kSteps * reference::directionalAlbedo(cosine, m, kF0);
    }
    double low = 0.2;
    double high = 0.9;
    for (int i = 0; i < 16; ++i) {
        const double middle = (low + high) / 2;
        (reference::directionalAlbedo(middle, m, kF0) > mean ? low : high) = middle;
    }
    return (low + high) / 2;
}

std::vector<FunctionCase> surroundings() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "kTgEvenCosine",
                     .body = "return float4(kTgEvenCosine, 0, 0, 0);",
                     .arguments = {linear(0.1, 0.5)},
                     .expected = [](const Inputs& x) { return values(evenCosine(x.scalar(0))); },
                     .tolerance = {.absolute = 0.016, .why = "one number for all m from .1 to .5"},
                     .samples = 16});
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

/// Where the lamp (place, w) of arguments 0 and 2 looks at a sphere of 100 about argument 1 from, and its way there.
struct Eye {
    glm::dvec3 eye{0};
    glm::dvec3 axis{0};
};
Eye lampEye(const Inputs& x) {
    if (x.scalar(2) > 0.5) return {x.vec3(0), glm::normalize(x.vec3(1) - x.vec3(0))};
    return {x.vec3(1) + 200.0 * glm::normalize(x.vec3(0)), -glm::normalize(x.vec3(0))};
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
    cases.push_back({.function = "tgLampAxis",
                     .body = "return float4(tgLampAxis(float4(a0, a2), a1), 0);",
                     .arguments = {linear(-1000, 1000, 3), linear(-100, 100, 3), whole(0, 1)},
                     .expected = [](const Inputs& x) { return values(lampEye(x).axis); },
                     .tolerance = {.forward = 8, .absolute = 1e-5, .why = "a difference of 1000, 6e-5 off, of at least 50 in length"},
                     .domain = [](const Inputs& x) { return glm::length(x.vec3(0) - x.scalar(2) * x.vec3(1)) > 50; }});
    cases.push_back(
        {.function = "tgLampDepth",
         .body = "return float4(tgLampDepth(tgLampView(float4(a0, a2), a1, 100, float3(0, 1, 0), float3(1, 0, 0)), a3), 0, 0, 0);",
         .arguments = {linear(-1000, 1000, 3), linear(-100, 100, 3), whole(0, 1), linear(-200, 200, 3)},
         .expected = [](const Inputs& x) { return values(glm::dot(x.vec3(3) - lampEye(x).eye, lampEye(x).axis)); },
         .tolerance = {.forward = 8, .absolute = 0.02, .why = "an axis of 1e-5 times a way of up to 2000"},
         .domain = [](const Inputs& x) { return glm::length(x.vec3(0) - x.scalar(2) * x.vec3(1)) > 50; }});
    // A sphere fits into the view: places on its outline as seen from the lamp lie on the circle that touches the view's sides, and the
    // planes touch it.
    cases.push_back({.function = "tgLampView",
                     .body = "TgLampView v = tgLampView(float4(a0, a1), float3(10, 20, 30), 100, float3(0, 1, 0), float3(1, 0, 0)); "
                             "return float4(v.spread, v.near, v.far, dot(v.right, v.axis) + dot(v.up, v.right));",
                     .arguments = {linear(-1000, 1000, 3), whole(0, 1)},
                     .expected =
                         [](const Inputs& x) {
                             if (x.scalar(1) < 0.5) return values(glm::dvec4(100, 100, 300, 0));
                             const double away = glm::length(x.vec3(0) - glm::dvec3(10, 20, 30));
                             const double half = away > 100 ? std::asin(100 / away) : std::acos(0.0);
                             return values(
                                 glm::dvec4(std::min(std::tan(std::min(half, 1.57)), 2.0), std::max(away - 100, 2.0), away + 100, 0));
                         },
                     .tolerance = {.forward = 16, .absolute = 1e-3, .why = "differences of 1000 and their lengths: 1e-4"},
                     .domain = [](const Inputs& x) { return glm::length(x.vec3(0) - glm::dvec3(10, 20, 30)) > 20; }});
    cases.push_back({.function = "tgLampClip",
                     .body = "float4 c = tgLampClip(tgLampView(float4(a0, a2), a1, 100, float3(0, 1, 0), float3(1, 0, 0)), a3); "
                             "return float4(dot(c.xy, c.xy) / (c.w * c.w), c.z / c.w, c.w, 0);",
                     .arguments = {linear(-1000, 1000, 3), linear(-100, 100, 3), whole(0, 1), linear(-200, 200, 3)},
                     .expected =
                         [](const Inputs& x) {
                             const Eye eye = lampEye(x);
                             const glm::dvec3 from = x.vec3(3) - eye.eye;
                             const double depth = glm::dot(from, eye.axis);
                             const double away = x.scalar(2) > 0.5 ? glm::length(x.vec3(0) - x.vec3(1)) : 200;
                             const double w = x.scalar(2) > 0.5 ? depth : 1;
                             const double spread = x.scalar(2) > 0.5 ? 100 / std::sqrt(away * away - 1e4) : 100;
                             const double across = glm::length(from - depth * eye.axis) / (spread * w);
                             const double near = away - 100;
                             const double far = away + 100;
                             const double z = x.scalar(2) > 0.5 ? far / (far - near) * (1 - near / depth) : (depth - near) / (far - near);
                             return values(across * across, z, w);
                         },
                     .tolerance = {.forward = 64, .absolute = 4e-3, .why = "as above, over a depth of at least 100"},
                     .domain =
                         [](const Inputs& x) {
                             const Eye eye = lampEye(x);
                             const bool apart = x.scalar(2) < 0.5 || glm::length(x.vec3(0) - x.vec3(1)) > 150;
                             return glm::length(x.vec3(0)) > 50 && apart && glm::dot(x.vec3(3) - eye.eye, eye.axis) > 100;
                         }});
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
