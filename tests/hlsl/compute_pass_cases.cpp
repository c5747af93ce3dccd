// What compute shaders of effects work out for themselves (effects/passes/pyramid_compute.fxh, fur_compute.fxh) in double precision.

#include "tests/hlsl/pass_case.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

FunctionCase computed(const char* effect, const char* function, std::string body, std::vector<Argument> arguments,
                      std::function<Values(const Inputs&)> expected, Tolerance tolerance) {
    return passCase(effect,
                    {{"gViewportSize", {640, 480}},
                     {"gViewProjectionInverse", {2, 0, 0.5, 0, 0, 3, 0, 0.1, 0.2, 0, 4, -0.5, 5, 6, 7, 2}},
                     {"gCoatSegments", {6}}},
                    function, std::move(body), std::move(arguments), std::move(expected), std::move(tolerance));
}

/// Where the ray along a direction meets |x| + |y| + |z| = 1; what is below goes over the nearest edge of the square and comes to lie
/// outside.
glm::dvec2 onOctahedron(const glm::dvec3& n) {
    const glm::dvec3 p = n / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    if (p.z >= 0) return {p.x, p.y};
    return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

bool isDirection(const glm::dvec3& n) {
    return std::abs(glm::length(n) - 1) < 1e-3 && std::min({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) > 1e-4;
}

double stepSquared(const glm::dvec2& after, const glm::dvec2& before) {
    const double least = std::min(glm::dot(after, after), glm::dot(before, before));
    const double most = std::max(glm::dot(after, after), glm::dot(before, before));
    if (most < 2 * least) return glm::dot(after - before, after - before) / 4;
    return least < 1 ? least : 0;
}

std::vector<FunctionCase> places() {
    const Tolerance plain{.forward = 8, .backward = 4, .absolute = 1e-6, .why = "quotients of sums of up to 3"};
    std::vector<FunctionCase> cases;
    cases.push_back(computed(
        "Pyramid.fx", "octahedral", "return float4(octahedral(a0), 0, 0);", {unit()},
        [](const Inputs& x) { return values(onOctahedron(x.vec3(0))); }, plain));
    cases.back().domain = [](const Inputs& x) { return isDirection(x.vec3(0)); };
    cases.push_back(computed(
        "Pyramid.fx", "fromOctahedral", "return float4(fromOctahedral(octahedral(a0)), 0);", {unit()},
        [](const Inputs& x) { return values(glm::normalize(x.vec3(0))); }, plain));
    cases.back().domain = [](const Inputs& x) { return isDirection(x.vec3(0)); };
    cases.push_back(computed(
        "Pyramid.fx", "stepBetween", "return float4(stepBetween(a0, a1), 0, 0, 0);", {linear(-1.2, 1.2, 2), linear(-1.2, 1.2, 2)},
        [](const Inputs& x) { return values(stepSquared(x.vec2(0), x.vec2(1))); }, plain));
    cases.back().domain = [](const Inputs& x) {
        const double a = glm::dot(x.vec2(0), x.vec2(0));
        const double b = glm::dot(x.vec2(1), x.vec2(1));
        return std::abs(std::max(a, b) - 2 * std::min(a, b)) > 1e-4 && std::abs(std::min(a, b) - 1) > 1e-4;
    };
    cases.push_back(computed("Pyramid.fx", "placeWorld", "return float4(placeWorld(uint2(a0, a1), a2), 0);",
                             {whole(0, 639), whole(0, 479), linear(0, 1)},
                             [](const Inputs& x) {
                                 const double u = (2 * std::round(x.scalar(0)) + 1) / 640 - 1;
                                 const double v = 1 - (2 * std::round(x.scalar(1)) + 1) / 480;
                                 const double d = x.scalar(2);
                                 const double w = 0.1 * v - 0.5 * d + 2;
                                 return values(glm::dvec3(2 * u + 0.2 * d + 5, 3 * v + 6, 0.5 * u + 4 * d + 7) / w);
                             },
                             {.forward = 8, .backward = 4, .absolute = 1e-5, .why = "sums of up to 12, a quotient"}));
    return cases;
}

/// Rows of a strand's vertices stand closer at its tip: a parabola, in whole parts of 31.
double alongRow(double row, double segments) {
    const double t = row / segments;
    return std::floor(31 * (1.25 * t - 0.25 * t * t) + 0.5) / 31;
}

std::vector<FunctionCase> rows() {
    std::vector<FunctionCase> cases;
    for (const int segments : {6, 15}) { // of 15 a row lies just below the middle between two parts
        cases.push_back(computed("FurCoat.fx", "ribbonAlong", "return float4(ribbonAlong(a0), ribbonSegments(), 0, 0);",
                                 {whole(0, segments)},
                                 [segments](const Inputs& x) { return values(alongRow(std::round(x.scalar(0)), segments), segments); },
                                 {.forward = 4, .backward = 0, .why = "whole parts of 31"}));
        cases.back().globals["gCoatSegments"] = {static_cast<double>(segments)};
    }
    cases.push_back(computed("FurCoat.fx", "ribbonRow", "return float4(ribbonRow(a0 / 31.0), 0, 0, 0);", {whole(0, 31)},
                             [](const Inputs& x) { // the row that is nearest there
                                 const double along = std::round(x.scalar(0)) / 31;
                                 return values(std::round((2.5 - std::sqrt(6.25 - 4 * along)) * 6));
                             },
                             {.forward = 0, .backward = 0, .why = "whole numbers"}));
    cases.push_back(computed("FurCoat.fx", "ribbonRow", "return float4(ribbonRow(ribbonAlong(a0)), 0, 0, 0);", {whole(0, 6)},
                             [](const Inputs& x) { return values(std::round(x.scalar(0))); },
                             {.forward = 0, .backward = 0, .why = "the reverse of each other"}));
    return cases;
}

} // namespace

std::vector<FunctionCase> computePassCases() {
    return together(places(), rows());
}

} // namespace tegument::test
