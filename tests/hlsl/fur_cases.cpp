// hlsl/fur against docs/fur.md.

#include "tests/hlsl/function_case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::test {

namespace {

using std::numbers::pi;

double sine(double cosine) {
    return std::sqrt(std::clamp(1 - cosine * cosine, 0.0, 1.0));
}

glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

glm::dvec3 combined(const glm::dvec3& position, const glm::dvec3& normal) {
    return unitOrZero(unitOrZero(position) + unitOrZero(normal));
}

bool isUnit(const glm::dvec3& v) {
    return std::abs(glm::length(v) - 1) < 1e-3;
}

/// |L| |E| of angles: Kajiya and Kay's cos(difference of the angles to the strand's normal plane).
double mirrored(const glm::dvec3& strand, const glm::dvec3& light, const glm::dvec3& eye, double exponent) {
    const double l = std::asin(std::clamp(glm::dot(strand, light), -1.0, 1.0));
    const double e = std::asin(std::clamp(glm::dot(strand, eye), -1.0, 1.0));
    // Inclinations to the normal plane: the mirror cone lies at -l.
    const double cosine = std::clamp(std::cos(l + e), 0.0, 1.0);
    return std::cos(l) * std::pow(std::max(cosine, 1e-6), exponent) * 0.5 * std::sqrt((exponent + 2.0 / 3) / (2 * pi));
}

std::vector<FunctionCase> shells() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "furLayerHeight",
                     .body = "return float4(furLayerHeight(a0, a1, a2), 0, 0, 0);",
                     .arguments = {whole(0, 511), whole(1, 512), whole(0, 1)},
                     .expected =
                         [](const Inputs& x) {
                             const double index = x.scalar(0);
                             const double count = std::max(x.scalar(1), 1.0);
                             return values(std::clamp((x.scalar(2) > 0.5 ? count - index : index + 1) / count, 0.0, 1.0));
                         },
                     .tolerance = {.forward = 3, .backward = 0, .why = "a quotient of whole numbers: 2.5 ULP"},
                     .domain = [](const Inputs& x) { return x.scalar(2) == 0 || x.scalar(2) == 1; }});
    cases.push_back({.function = "furDistance",
                     .body = "return float4(furDistance(a0, a1, a2), 0, 0, 0);",
                     .arguments = {linear(0, 0.5), logarithmic(1e-3, 1e6), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(x.scalar(0) * x.scalar(1) * x.scalar(2)); },
                     .tolerance = {.forward = 3, .backward = 0, .absolute = 1e-37, .why = "two products; denormals may be flushed"}});
    cases.push_back({.function = "furStrand",
                     .body = "return float4(furStrand(a0, a1, a2), 0);",
                     .arguments = {unit(), linear(0, 1), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(x.vec3(0) - glm::dvec3(0, x.scalar(1) * x.scalar(2), 0)); },
                     .tolerance = {.forward = 4, .backward = 1, .absolute = 1e-7, .why = "a sum that may cancel"}});
    cases.push_back(
        {.function = "furTangent",
         .body = "return float4(furTangent(a0, a1, a2), 0);",
         .arguments = {unit(), linear(0, 1), linear(0, 1)},
         .expected =
             [](const Inputs& x) {
                 // The derivative of h (N + lean h down) by h, here by a central difference, exact for a parabola.
                 const auto at = [&](double h) { return h * (x.vec3(0) + glm::dvec3(0, -x.scalar(1) * h, 0)); };
                 return values(unitOrZero(at(x.scalar(2) + 0.5) - at(x.scalar(2) - 0.5)));
             },
         .tolerance = {.forward = 8, .backward = 1, .absolute = 2e-6, .why = "a sum that may cancel to a hundredth, normalised"},
         .domain =
             [](const Inputs& x) {
                 const glm::dvec3 sum = x.vec3(0) + glm::dvec3(0, -2 * x.scalar(1) * x.scalar(2), 0);
                 return isUnit(x.vec3(0)) && glm::length(sum) > 0.05;
             }});
    cases.push_back(
        {.function = "furCoverage",
         .body = "return float4(furCoverage(a0, a1, a2, a3), 0, 0, 0);",
         .arguments = {linear(0, 1), linear(0, 1), whole(0, 1), linear(0.05, 1)},
         .expected =
             [](const Inputs& x) {
                 const double alpha = x.scalar(0);
                 if (x.scalar(2) == 0) return values(alpha);
                 const double standing = std::clamp((alpha - x.scalar(1)) / x.scalar(3) + 0.5, 0.0, 1.0);
                 return values(std::min(standing, std::clamp(alpha * 1e4, 0.0, 1.0)));
             },
         .tolerance = {.forward = 8, .backward = 1, .absolute = 1e-6, .why = "a difference that may cancel, over 0.05"},
         .domain = [](const Inputs& x) { return (x.scalar(2) == 0 || x.scalar(2) == 1) && x.scalar(3) >= 0.05 && x.scalar(0) >= 0; }});
    return cases;
}

std::vector<FunctionCase> vectors() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "furCombinedVector",
                     .body = "return float4(furCombinedVector(a0, a1), 0);",
                     .arguments = {vector(3, 1e-3, 1e4), unit()},
                     .expected = [](const Inputs& x) { return values(combined(x.vec3(0), x.vec3(1))); },
                     .tolerance = {.forward = 8, .backward = 2, .absolute = 1e-5, .why = "a sum that may cancel to a tenth, normalised"},
                     .domain =
                         [](const Inputs& x) {
                             return glm::length(x.vec3(0)) > 1e-4 && isUnit(x.vec3(1)) &&
                                    glm::length(unitOrZero(x.vec3(0)) + unitOrZero(x.vec3(1))) > 0.1;
                         }});
    cases.push_back({.function = "furCurled",
                     .body = "return float4(furCurled(a0, a1, a2), 0);",
                     .arguments = {unit(), linear(0, 1), linear(0, 0.05)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec3 v = x.vec3(0);
                             const glm::dvec3 side =
                                 unitOrZero(glm::cross(v, std::abs(v.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
                             const double angle = 2 * pi * x.scalar(1);
                             const glm::dvec3 turn = std::cos(angle) * side + std::sin(angle) * glm::cross(v, side);
                             return values(unitOrZero(v + x.scalar(2) * x.scalar(1) * turn));
                         },
                     // Vulkan gives sine and cosine 2^-11 absolute; times a radius of 0.05.
                     .tolerance = {.forward = 8, .backward = 1, .absolute = 2.5e-5, .why = "sine and cosine to 2^-11, times 0.05"},
                     .domain =
                         [](const Inputs& x) {
                             return isUnit(x.vec3(0)) && std::abs(std::abs(x.scalar(0, 1)) - 0.9) > 1e-6; // either side may be taken at 0.9
                         }});
    cases.push_back({.function = "furSphereCoordinate",
                     .body = "return float4(furSphereCoordinate(a0), 0, 0);",
                     .arguments = {unit()},
                     .expected =
                         [](const Inputs& x) {
                             // A mirror ball: the normal halfway between the direction and the eye at +z.
                             const glm::dvec3 n = unitOrZero(unitOrZero(x.vec3(0)) + glm::dvec3(0, 0, 1));
                             return values(0.5 + 0.5 * n.x, 0.5 - 0.5 * n.y);
                         },
                     .tolerance = {.forward = 8, .backward = 1, .absolute = 2e-5, .why = "near -z the sum cancels: 1e-7 over 0.01"},
                     .domain = [](const Inputs& x) { return isUnit(x.vec3(0)) && unitOrZero(x.vec3(0)).z > -0.9999; }});
    return cases;
}

std::vector<FunctionCase> light() {
    const auto allUnit = [](const Inputs& x, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            if (!isUnit(x.vec3(i))) return false;
        return true;
    };
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "furSine",
                     .body = "return float4(furSine(a0), 0, 0, 0);",
                     .arguments = {cosine()},
                     .expected = [](const Inputs& x) { return values(sine(x.scalar(0))); },
                     .tolerance = {.forward = 4, .backward = 2, .absolute = 3.5e-4, .why = "near 1 the root of a rounding error, 1.2e-7"}});
    cases.push_back(
        {.function = "furDiffuse",
         .body = "return float4(furDiffuse(a0, a1, a2), 0, 0, 0);",
         .arguments = {unit(), unit(), linear(0, 1)},
         .expected = [](const Inputs& x) { return values(sine(glm::dot(x.vec3(0), x.vec3(1))) * (1 / pi + x.scalar(2) * (1 - 1 / pi))); },
         .tolerance = {.forward = 8, .backward = 2, .absolute = 5e-4, .why = "as furSine, of a dot product with an error of its own"},
         .domain = [allUnit](const Inputs& x) { return allUnit(x, 2); }});
    cases.push_back({.function = "furSpecular",
                     .body = "return float4(furSpecular(a0, a1, a2, a3), 0, 0, 0);",
                     .arguments = {unit(), unit(), unit(), logarithmic(1, 200)},
                     .expected = [](const Inputs& x) { return values(mirrored(x.vec3(0), x.vec3(1), x.vec3(2), x.scalar(3))); },
                     // d(cos^p) <= p * error of the cosine, 2e-7 and more where sines are small; the factor in front reaches 2.8.
                     .tolerance = {.forward = 64, .backward = 2, .absolute = 1.5e-3, .why = "a power of up to 200 of a rounded cosine"},
                     .domain = [allUnit](const Inputs& x) { return allUnit(x, 3) && x.scalar(3) >= 1; }});
    cases.push_back(
        {.function = "furTransmittance",
         .body = "return float4(furTransmittance(a0, a1, a2), 0, 0, 0);",
         .arguments = {linear(0, 1), cosine(-1, 1), linear(0, 10)},
         .expected =
             [](const Inputs& x) {
                 if (x.scalar(1) <= 0) return values(0);
                 const double c = std::max(x.scalar(1), 1e-3);
                 return values(std::exp(-x.scalar(2) * (1 - x.scalar(0)) * sine(c) / c));
             },
         .tolerance = {.forward = 180, .backward = 2, .absolute = 2e-5, .why = "exp to 3 + 2|x| ULP; the sine near 1 as furSine's"},
         .domain = [](const Inputs& x) { return x.scalar(0) >= 0 && x.scalar(0) <= 1 && x.scalar(1) < 0.9999; }});
    return cases;
}

} // namespace

std::vector<FunctionCase> furCases() {
    std::vector<FunctionCase> cases = shells();
    for (auto more : {vectors(), light()})
        for (FunctionCase& function : more)
            cases.push_back(std::move(function));
    return cases;
}

} // namespace tegument::test
