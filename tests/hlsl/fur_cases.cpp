// hlsl/fur against Kajiya and Kay (1989) and the formulas in the heads of its files.

#include "tests/hlsl/function_case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::test {

namespace {

constexpr double kPi = std::numbers::pi;

double saturate(double x) {
    return std::clamp(x, 0.0, 1.0);
}

double sineFrom(double cosine) {
    return std::sqrt(saturate(1 - cosine * cosine));
}

glm::dvec3 normalised(const glm::dvec3& v) {
    return v / std::max(glm::length(v), 1e-10);
}

/// Normalised Kajiya-Kay lobe: sin(l) cos^p(mirror angle) / 2 sqrt((p + 2/3) / (2 pi)).
double specular(const glm::dvec3& strand, const glm::dvec3& toLight, const glm::dvec3& toEye, double exponent) {
    const double l = glm::dot(strand, toLight);
    const double e = glm::dot(strand, toEye);
    const double cosine = saturate(sineFrom(l) * sineFrom(e) - l * e);
    return sineFrom(l) * std::pow(std::max(cosine, 1e-6), exponent) * 0.5 * std::sqrt((exponent + 2.0 / 3) / (2 * kPi));
}

/// Along a ray from a point in the coat of a ball of radius 1, by the ray's two crossings with the coat's outside.
double wayOut(double height, double cosine, double thickness) {
    const double coat = std::max(thickness, 1e-3);
    const glm::dvec2 from(0, 1 + height * coat);
    const glm::dvec2 direction(sineFrom(cosine), cosine);
    const double middle = -glm::dot(from, direction); // of the two crossings
    const double half = std::sqrt(middle * middle + (1 + coat) * (1 + coat) - glm::dot(from, from));
    return (middle + half) / coat;
}

double transmittance(double height, double cosine, double density, double thickness) {
    return std::exp(-density * wayOut(height, cosine, thickness) * sineFrom(cosine));
}

/// Piece by piece: still in the nearest coat, well behind it, or on the quarter of a thickness between.
double foreignCoat(double place, double front, double back, double own, double coat) {
    const double inside = (place - front) / coat - 1.25 * own - 0.25;
    const double through = (back - front) / coat;
    if (place <= back) return std::max(inside, 0.0);
    if (place >= back + coat / 4) return std::max(through, 0.0);
    return std::max(std::lerp(inside, through, 4 * (place - back) / coat), 0.0);
}

glm::dvec3 combined(const glm::dvec3& position, const glm::dvec3& normal) {
    const glm::dvec3 n = normalised(normal);
    const glm::dvec3 sum = normalised(position) + n;
    return glm::dot(sum, sum) > 1e-8 ? glm::normalize(sum) : n;
}

glm::dvec3 curled(const glm::dvec3& v, double height, double radius) {
    const glm::dvec3 axis = std::abs(v.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 side = normalised(glm::cross(v, axis));
    const double angle = 2 * kPi * height;
    return normalised(v + radius * height * (std::cos(angle) * side + std::sin(angle) * glm::cross(v, side)));
}

/// Of unit vectors whose direction has not been lost to a special value.
std::vector<FunctionCase> shells() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgFurLayerHeight",
                     .body = "return float4(tgFurLayerHeight(a0, a1, a2), 0, 0, 0);",
                     .arguments = {whole(0, 255), whole(0, 256), whole(0, 1)},
                     .expected =
                         [](const Inputs& x) {
                             const double n = std::max(x.scalar(1), 1.0);
                             return values(saturate((x.scalar(2) > 0.5 ? n - x.scalar(0) : x.scalar(0) + 1) / n));
                         },
                     .tolerance = {.forward = 4, .backward = 0, .why = "a quotient of whole numbers"}});
    cases.push_back({.function = "tgFurSpread",
                     .body = "return float4(tgFurSpread(a0, a1), 0, 0, 0);",
                     .arguments = {linear(0.001, 1), linear(0.25, 4)},
                     .expected = [](const Inputs& x) { return values(std::pow(x.scalar(0), x.scalar(1))); },
                     .tolerance = {.forward = 120, .backward = 4, .absolute = 1e-6, .why = "exp2 of a product up to 40: 3 + 2|x| ULP"}});
    cases.push_back(
        {.function = "tgFurDistance",
         .body = "return float4(tgFurDistance(a0, a1, a2), 0, 0, 0);",
         .arguments = {linear(0, 0.5), logarithmic(1, 1e3), linear(0, 1)},
         .expected = [](const Inputs& x) { return values(x.scalar(0) * x.scalar(1) * x.scalar(2)); },
         .tolerance = {.forward = 2, .backward = 0, .absolute = 1e-35, .why = "two products, of which a denormal one is flushed to 0"}});
    cases.push_back({.function = "tgFurNearDepth",
                     .body = "return float4(tgFurNearDepth(a0, a1), 0, 0, 0);",
                     .arguments = {linear(-50, 100), linear(1, 1000)},
                     .expected =
                         [](const Inputs& x) {
                             const double margin = 0.01 * x.scalar(1);
                             return values(x.scalar(0) < margin ? margin * std::exp(std::max(x.scalar(0) / margin - 1, -80.0))
                                                                : x.scalar(0));
                         },
                     .tolerance = {.forward = 180, .backward = 4, .absolute = 1e-6, .why = "exp: 3 + 2|x| ULP with |x| up to 80"},
                     .domain = [](const Inputs& x) { return x.scalar(1) >= 1; }});
    cases.push_back({.function = "tgFurStrand",
                     .body = "return float4(tgFurStrand(a0, a1, a2), 0);",
                     .arguments = {unit(), vector(3, 0.01, 2), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(x.vec3(0) + x.scalar(2) * x.vec3(1)); },
                     .tolerance = {.forward = 2, .backward = 1, .why = "a product and a sum"}});
    cases.push_back(
        {.function = "tgFurTangent",
         .body = "return float4(tgFurTangent(a0, a1, a2), 0);",
         .arguments = {unit(), vector(3, 0.01, 2), linear(0, 1)},
         .expected = [](const Inputs& x) { return values(normalised(x.vec3(0) + 2 * x.scalar(2) * x.vec3(1))); },
         .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-6, .why = "normalised: an inverse square root; the sum may cancel"},
         .domain = [](const Inputs& x) { return glm::length(x.vec3(0) + 2 * x.scalar(2) * x.vec3(1)) > 0.1; }});
    cases.push_back({.function = "tgFurCoverage",
                     .body = "return float4(tgFurCoverage(a0, a1, a2, a3), 0, 0, 0);",
                     .arguments = {linear(0, 1), linear(0, 1), linear(0, 1), linear(0, 0.5)},
                     .expected =
                         [](const Inputs& x) {
                             const double alpha = x.scalar(0);
                             const double standing = saturate((alpha - x.scalar(1)) / std::max(x.scalar(3), 1e-4) + 0.5);
                             return values(std::lerp(alpha, std::min(standing, saturate(alpha * 1e4)), x.scalar(2)));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-6, .why = "a quotient by as little as 1e-4, interpolated"}});
    cases.push_back(
        {.function = "tgFurLayerCoverage",
         .body = "return float4(tgFurLayerCoverage(a0, a1), 0, 0, 0);",
         .arguments = {linear(0, 1), whole(1, 512)},
         .expected = [](const Inputs& x) { return values(1 - std::pow(1 - x.scalar(0), 32 / x.scalar(1))); },
         .tolerance =
             {.forward = 8, .backward = 4, .absolute = 2e-6, .why = "1 less a power: 3 + 2|x| ULP, which cancels where little is covered"},
         .domain = [](const Inputs& x) { return x.scalar(1) >= 1 && x.scalar(0) <= 1 && (x.scalar(0) == 1 || x.scalar(0) < 0.999); }});
    return cases;
}

/// docs/design/fur.md, "Seen from afar", as its formulas stand there.
double meanCoverage(double mean, double height, double above, double variance, double softness, double slope) {
    const double scale = std::sqrt(3 * variance) / kPi;
    const double tip = mean + softness * (0.5 - std::min(0.2 / std::sqrt(softness), 1.0));
    const auto taller = [&](double h) { return 1 / (1 + std::exp((h - tip) / scale)); };
    const double rate = 0.5 + std::hypot(0.5, slope / kPi);
    const double share = taller(height);
    const double entered = 1 - std::pow((1 - share) / (1 - taller(above)), rate);
    return std::pow(std::pow(entered, -3) + std::pow(share, -3), -1.0 / 3);
}

std::vector<FunctionCase> afar() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgFurHeightVariance",
                     .body = "return float4(tgFurHeightVariance(a0, a1, a2, a3), 0, 0, 0);",
                     .arguments = {linear(0, 0.5), logarithmic(1e-4, 0.2), logarithmic(1e-4, 1), linear(0, 1)},
                     .expected =
                         [](const Inputs& x) {
                             const double share = 1 / (1 + std::pow(x.scalar(1) / x.scalar(2), 2));
                             return values(std::min(std::pow(x.scalar(0), 2) * share, std::pow(x.scalar(3), 2)));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-35, .why = "products and a quotient"},
                     .domain = [](const Inputs& x) { return x.scalar(1) >= 1e-4 && x.scalar(2) >= 1e-4; }});
    cases.push_back({.function = "tgFurHeightSlope",
                     .body = "return float4(tgFurHeightSlope(a0, a1), 0, 0, 0);",
                     .arguments = {linear(0, 0.5), logarithmic(1e-4, 0.2)},
                     .expected = [](const Inputs& x) { return values(2.8 * x.scalar(0) / x.scalar(1)); },
                     .tolerance = {.forward = 4, .backward = 0, .absolute = 1e-35, .why = "a product and a quotient"},
                     .domain = [](const Inputs& x) { return x.scalar(1) >= 1e-4; }});
    cases.push_back({.function = "tgFurWayOver",
                     .body = "return float4(tgFurWayOver(a0, a1, a2), 0, 0, 0);",
                     .arguments = {unit(), unit(), vector(3, 0.1, 2)},
                     .expected =
                         [](const Inputs& x) {
                             // From a point of the layer to where the ray meets the one that is 1 lower, seen from the strand's point
                             // there.
                             const glm::dvec3 normal = x.vec3(1);
                             const double far = glm::dot(x.vec3(2), normal) / -glm::dot(x.vec3(0), normal);
                             return values(glm::length(far * x.vec3(0) + x.vec3(2)));
                         },
                     .tolerance = {.forward = 64, .backward = 4, .absolute = 1e-4, .why = "a quotient by a cosine of 0.1 and more"},
                     .domain =
                         [](const Inputs& x) {
                             return isUnit(x.vec3(0)) && isUnit(x.vec3(1)) && glm::dot(x.vec3(0), x.vec3(1)) < -0.1 &&
                                    glm::length(x.vec3(2)) < 10;
                         }});
    cases.push_back({.function = "tgFurAfar",
                     .body = "return float4(tgFurAfar(a0, a1), 0, 0, 0);",
                     .arguments = {linear(0, 0.25), linear(0.01, 1)},
                     .expected = [](const Inputs& x) { return values(1 / (1 + 0.03 * std::pow(x.scalar(1), 2) / x.scalar(0))); },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 5e-3, .why = "1e-8 beside the square of a softness of 0.01"},
                     .domain = [](const Inputs& x) { return x.scalar(0) > 1e-6 && x.scalar(1) >= 0.01; }});
    cases.push_back({.function = "tgFurMeanCoverage",
                     .body = "return float4(tgFurMeanCoverage(a0, float2(a1, a1 + a2), a3, a4, a5), 0, 0, 0);",
                     .arguments = {linear(0, 1), linear(0, 1), linear(0.01, 0.5), linear(0.01, 0.2), linear(0.01, 1), linear(0, 50)},
                     .expected =
                         [](const Inputs& x) {
                             return values(
                                 meanCoverage(x.scalar(0), x.scalar(1), x.scalar(1) + x.scalar(2), x.scalar(3), x.scalar(4), x.scalar(5)));
                         },
                     .tolerance = {.forward = 200,
                                   .backward = 4,
                                   .absolute = 3e-3,
                                   .why = "1e-4 is added to a scale of 0.055 and more; 1 less powers of what is near 1"},
                     .domain = [](const Inputs& x) { return x.scalar(2) >= 0.01 && x.scalar(3) >= 0.01 && x.scalar(4) >= 0.01; }});
    return cases;
}

std::vector<FunctionCase> vectors() {
    std::vector<FunctionCase> cases;
    cases.push_back(
        {.function = "tgFurCombinedVector",
         .body = "return float4(tgFurCombinedVector(a0, a1), 0);",
         .arguments = {vector(3, 0.1, 1000), unit()},
         .expected = [](const Inputs& x) { return values(combined(x.vec3(0), x.vec3(1))); },
         .tolerance = {.forward = 8, .backward = 4, .absolute = 2e-6, .why = "three times normalised; nearly opposite vectors cancel"},
         .domain = [](const Inputs& x) { // near cancellation the sum's direction is the rounding's
             return glm::length(normalised(x.vec3(0)) + normalised(x.vec3(1))) > 0.05;
         }});
    cases.push_back({.function = "tgFurDirection",
                     .body = "return float4(tgFurDirection(a0), 0);",
                     .arguments = {vector(3, 0.1, 1000)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec3 v = x.vec3(0);
                             return values(v == glm::dvec3(0) ? glm::dvec3(0, 0, 1) : normalised(v));
                         },
                     .tolerance = {.forward = 4, .backward = 2, .absolute = 1e-6, .why = "one normalisation"},
                     .domain = [](const Inputs& x) { return x.vec3(0) == glm::dvec3(0) || glm::length(x.vec3(0)) > 1e-3; }});
    cases.push_back({.function = "tgFurCurled",
                     .body = "return float4(tgFurCurled(a0, a1, a2), 0);",
                     .arguments = {unit(), linear(0, 1), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(curled(x.vec3(0), x.scalar(1), x.scalar(2))); },
                     .tolerance = {.forward = 8,
                                   .backward = 4,
                                   .absolute = 2e-6,
                                   .why = "sine and cosine: 2^-11 absolute in Vulkan, measured far better"},
                     .domain = [](const Inputs& x) { return isUnit(x.vec3(0)) && std::abs(std::abs(x.scalar(0, 1)) - 0.9) > 1e-6; }});
    cases.push_back({.function = "tgFurSphereCoordinate",
                     .body = "return float4(tgFurSphereCoordinate(a0), 0, 0);",
                     .arguments = {unit()},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec3 n = normalised(normalised(x.vec3(0)) + glm::dvec3(0, 0, 1));
                             return values(0.5 + 0.5 * n.x, 0.5 - 0.5 * n.y);
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 2e-6, .why = "twice normalised"},
                     .domain = [](const Inputs& x) { return isUnit(x.vec3(0)) && x.scalar(0, 2) > -0.99; }}); // v = -z is the whole rim
    return cases;
}

std::vector<FunctionCase> lights() {
    std::vector<FunctionCase> cases;
    cases.push_back(
        {.function = "tgFurSine",
         .body = "return float4(tgFurSine(a0), 0, 0, 0);",
         .arguments = {cosine()},
         .expected = [](const Inputs& x) { return values(sineFrom(x.scalar(0))); },
         .tolerance = {.forward = 8, .backward = 2, .why = "the root of 1 - c^2, whose rounding the argument's ULP stands for"}});
    cases.push_back(
        {.function = "tgFurDiffuse",
         .body = "return float4(tgFurDiffuse(a0, a1, a2), 0, 0, 0);",
         .arguments = {unit(), unit(), linear(0, 1)},
         .expected =
             [](const Inputs& x) { return values(sineFrom(glm::dot(x.vec3(0), x.vec3(1))) * std::lerp(1 / kPi, 1.0, x.scalar(2))); },
         .tolerance = {.forward = 8,
                       .backward = 4,
                       .absolute = 4e-4,
                       .why = "along the strand the sine is the root of what rounding leaves of 1 - c^2"}});
    cases.push_back({.function = "tgFurSpecular",
                     .body = "return float4(tgFurSpecular(a0, a1, a2, a3), 0, 0, 0);",
                     .arguments = {unit(), unit(), unit(), linear(1, 200)},
                     .expected = [](const Inputs& x) { return values(specular(x.vec3(0), x.vec3(1), x.vec3(2), x.scalar(3))); },
                     .tolerance = {.forward = 400,
                                   .backward = 4,
                                   .absolute = 1e-4,
                                   .why = "a power of up to 200: 3 + 2|x| ULP with |x| up to 126, and 200 times those of its base"}});
    cases.push_back({.function = "tgFurWay",
                     .body = "return float4(tgFurWay(a0, a1, a2), 0, 0, 0);",
                     .arguments = {linear(0, 1), cosine(), linear(0, 0.5)},
                     .expected = [](const Inputs& x) { return values(wayOut(x.scalar(0), x.scalar(1), x.scalar(2))); },
                     .tolerance = {.forward = 64,
                                   .backward = 4,
                                   .absolute = 2e-3,
                                   .why = "a way of up to 2,000 coats; the root near the horizon, where its argument cancels"}});
    cases.push_back({.function = "tgFurForeignCoat",
                     .body = "return float4(tgFurForeignCoat(a0, a1, a1 + a2, a3, a4), 0, 0, 0);",
                     .arguments = {linear(0, 200), linear(0, 100), linear(0, 50), linear(0, 10), logarithmic(0.5, 20)},
                     .expected =
                         [](const Inputs& x) {
                             return values(foreignCoat(x.scalar(0), x.scalar(1), x.scalar(1) + x.scalar(2), x.scalar(3), x.scalar(4)));
                         },
                     .tolerance = {.forward = 32, .backward = 4, .absolute = 1e-3, .why = "differences of places up to 200, over 0.5"},
                     .domain = [](const Inputs& x) { return x.scalar(4) >= 0.5; }});
    cases.push_back(
        {.function = "tgFurTransmittance",
         .body = "return float4(tgFurTransmittance(a0, a1, a2, a3), 0, 0, 0);",
         .arguments = {linear(0, 1), cosine(), linear(0, 20), linear(0, 0.5)},
         .expected = [](const Inputs& x) { return values(transmittance(x.scalar(0), x.scalar(1), x.scalar(2), x.scalar(3))); },
         .tolerance = {.forward = 180,
                       .backward = 4,
                       .absolute = 2e-5,
                       .why = "exp: 3 + 2|x| ULP with |x| up to 87; a way of up to 2,000 coats, whose rounding is what is left of "
                              "light after more than ten of them"}});
    cases.push_back(
        {.function = "tgFurFill",
         .body = "return float4(tgFurFill(a0, a1, a2), 0, 0, 0);",
         .arguments = {linear(0, 1), linear(0, 20), linear(0, 1)},
         .expected = [](const Inputs& x) { return values(std::exp(-x.scalar(1) * (1 - x.scalar(0))) * (0.5 + 0.5 * x.scalar(2))); },
         .tolerance = {.forward = 48, .backward = 4, .absolute = 1e-7, .why = "exp: 3 + 2|x| ULP with |x| up to 20"}});
    return cases;
}

} // namespace

std::vector<FunctionCase> furCases() {
    return together(shells(), afar(), vectors(), lights());
}

} // namespace tegument::test
