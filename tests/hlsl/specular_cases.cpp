// hlsl/specular against lab/reference and the formulas of docs/design/modules/Beckmann.md and EnergyAttenuation.md.

#include "lab/reference/specular.h"
#include "tests/hlsl/function_case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::test {

namespace {

/// Vulkan allows exp(x) an error of 3 + 2|x| ULP; |x| reaches 87 before the result is denormal.
constexpr double kExpUlp = 180;

/// Of setting corrected; the printed ones have another.
constexpr double kF0 = 0.04;
constexpr double kPrintedF0 = 0.028;

/// N.L rho_s PH F / |L + V|^2 with the guards that beckmannPH and tgKelemenSpecular state: |L + V|^2 at least 1e-4, N.H at least 1e-3.
double specular(const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v, double m, double rhoS, double f0 = kF0) {
    const glm::dvec3 h = l + v;
    const double square = glm::dot(h, h);
    const glm::dvec3 halfway = square > 0 ? h / std::sqrt(square) : glm::dvec3(0);
    const double ph = reference::beckmannPH(std::max(glm::dot(n, halfway), 1e-3), m);
    return std::clamp(glm::dot(n, l), 0.0, 1.0) * rhoS * ph * reference::fresnelSchlick(glm::dot(v, halfway), f0) / std::max(square, 1e-4);
}

glm::dvec3 eyeAt(double cosine) {
    return {std::sqrt(std::max(1 - cosine * cosine, 0.0)), 0, cosine};
}

constexpr int kNodes = 32;

double nodePrinted(double cosine, double m, double i, double j) {
    const double phi = 2 * std::numbers::pi * i / (kNodes - 1);
    const double theta = 0.5 * std::numbers::pi * j / (kNodes - 1);
    const glm::dvec3 l{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    return std::pow(std::numbers::pi / kNodes, 2) * std::sin(theta) * specular({0, 0, 1}, l, eyeAt(cosine), m, 1, kPrintedF0);
}

/// pi F (2 - N.V / (V.H N.H)) / 32^2 at the half vector whose slope is m sqrt(-ln(1 - u)).
double nodeSampled(double cosine, double m, double i, double j) {
    const double phi = std::numbers::pi * (i + 0.5) / kNodes;
    const double slope = m * std::sqrt(-std::log(1 - (j + 0.5) / kNodes));
    const glm::dvec3 h = glm::normalize(glm::dvec3(slope * std::cos(phi), slope * std::sin(phi), 1));
    const double vh = glm::dot(eyeAt(cosine), h);
    const double share = vh > 0 ? std::max(2 - cosine / (vh * h.z), 0.0) : 0;
    return reference::fresnelSchlick(vh, kF0) * share * std::numbers::pi / (kNodes * kNodes);
}

const Argument kRoughness = linear(0.01, 1);

/// Mean length of the unit normals of Gaussian slopes of this variance along each axis, and how it changes with the variance: over
/// t = r^2 / 2 v, which is exponential, by Simpson's rule.
std::pair<double, double> meanLength(double variance) {
    constexpr int kPieces = 200;
    constexpr double kStep = 40.0 / kPieces;
    double mean = 0;
    double slope = 0;
    for (int i = 0; i <= kPieces; ++i) {
        const double t = i * kStep;
        const double weight = std::exp(-t) * kStep / 3 * (i == 0 || i == kPieces ? 1 : i % 2 == 0 ? 2 : 4);
        const double root = std::sqrt(1 + 2 * variance * t);
        mean += weight / root;
        slope -= weight * t / (root * root * root);
    }
    return {mean, slope};
}

/// By Newton's method from below, where it never passes the solution: the mean length falls less and less.
double varianceOf(double length) {
    double variance = 0;
    for (int i = 0; i < 12; ++i) {
        const auto [mean, slope] = meanLength(variance);
        variance = std::max(variance - (mean - length) / slope, 0.0);
    }
    return variance;
}

/// Below the map's rounding, 0.004, nothing is lost.
double lostVariance(double mean) {
    const double variance = varianceOf(std::max(mean, 0.5));
    return std::sqrt(std::max(variance * variance - 0.004 * 0.004, 0.0));
}

/// What the slopes' variance adds to m^2, twice.
double widened(double m, double mean) {
    return std::min(std::sqrt(m * m + 2 * lostVariance(mean)), std::max(m, 1.0));
}

std::vector<FunctionCase> widenedLobes() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgLostVariance",
                     .body = "return float4(tgLostVariance(a0), 0, 0, 0);",
                     .arguments = {linear(0.76, 1.02)},
                     .expected = [](const Inputs& x) { return values(lostVariance(x.scalar(0))); },
                     .tolerance = {.forward = 8, .absolute = 0.013, .why = "2.5 % of 0.5, the greatest variance here"},
                     .samples = 512});
    FunctionCase widens = {
        .function = "tgRoughnessWidened",
        .body = "return float4(tgRoughnessWidened(a0, a1), 0, 0, 0);",
        .arguments = {kRoughness, linear(0, 1.02)},
        .expected = [](const Inputs& x) { return values(widened(x.scalar(0), x.scalar(1))); },
        .tolerance = {.forward = 8, .absolute = 0.013, .why = "the variance is within 2.5 %, half of that of m, which is 1 at most"},
        .samples = 512};
    cases.push_back(widens);
    widens.arguments = {linear(0.01, 0.1), linear(0.98, 1.02)};
    widens.tolerance = {
        .forward = 8, .absolute = 1e-3, .why = "little relief: the variance is within 0.1 %, beside a root of m^2 and of its own square"};
    widens.domain = [](const Inputs& x) { return std::abs(varianceOf(x.scalar(1)) - 0.004) > 1e-4; };
    cases.push_back(widens);
    cases.push_back(
        {.function = "tgTwoLobes",
         .body =
             "return float4(tgTwoLobes(tgSafeNormalize(a0), tgSafeNormalize(a1), tgSafeNormalize(a2), float2(a3, a4), a5, 0.18), 0, 0, 0);",
         .arguments = {linear(-1, 1, 3), linear(-1, 1, 3), linear(-1, 1, 3), linear(0.2, 1), linear(0.2, 1), linear(0, 1)},
         .expected =
             [](const Inputs& x) {
                 const glm::dvec3 n = glm::normalize(x.vec3(0));
                 const glm::dvec3 l = glm::normalize(x.vec3(1));
                 const glm::dvec3 v = glm::normalize(x.vec3(2));
                 const double first = specular(n, l, v, x.scalar(3), 0.18);
                 const double second = specular(n, l, v, x.scalar(4), 0.18);
                 return values((1 - x.scalar(5)) * first + x.scalar(5) * second);
             },
         .tolerance = {.forward = 2 * kExpUlp, .backward = 8, .absolute = 1e-6, .why = "two exponentials of up to 87, 2|x| ULP each"},
         .domain =
             [](const Inputs& x) {
                 const double longest = std::min({glm::length(x.vec3(0)), glm::length(x.vec3(1)), glm::length(x.vec3(2))});
                 if (longest < 0.05) return false;
                 return glm::length(glm::normalize(x.vec3(1)) + glm::normalize(x.vec3(2))) > 0.1;
             }});
    return cases;
}

std::vector<FunctionCase> lobes() {
    std::vector<FunctionCase> cases;
    cases.push_back(
        {.function = "tgBeckmannPH",
         .body = "return float4(tgBeckmannPH(a0, a1), 0, 0, 0);",
         .arguments = {cosine(0, 1), kRoughness},
         .expected = [](const Inputs& x) { return values(reference::beckmannPH(x.scalar(0), x.scalar(1))); },
         .tolerance = {
             .forward = kExpUlp,
             .backward = 4,
             .absolute = 1e-33,
             .why = "one exponential: 3 + 2|x| ULP, |x| up to 87; below 1.2e-38 it is flushed to 0, before the quotient by m^2 c^4"}});
    cases.push_back({.function = "tgBeckmannEncode",
                     .body = "return float4(tgBeckmannEncode(a0), 0, 0, 0);",
                     .arguments = {logarithmic(1e-29, 1e6)},
                     .expected = [](const Inputs& x) { return values(0.5 * std::pow(std::max(x.scalar(0), 1e-30), 0.1)); },
                     .tolerance = {.forward = 24, .why = "pow is exp2(0.1 log2 x): 3 + 2|0.1 * 97| ULP and 3 of the logarithm"}});
    cases.push_back(
        {.function = "tgBeckmannDecode",
         .body = "return float4(tgBeckmannDecode(a0), 0, 0, 0);",
         .arguments = {linear(0, 2)},
         .expected = [](const Inputs& x) { return values(std::pow(2 * x.scalar(0), 10)); },
         .tolerance = {.forward = 300,
                       .why = "pow is exp2(10 log2 x): 3 + 2|x| ULP with |x| up to 126, and ten times those of the logarithm"}});
    cases.push_back({.function = "tgFresnelSchlick",
                     .body = "return float4(tgFresnelSchlick(a0, a1), 0, 0, 0);",
                     .arguments = {cosine(-1, 2), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(reference::fresnelSchlick(x.scalar(0), x.scalar(1))); },
                     .tolerance = {.forward = 8, .backward = 2, .why = "eight roundings"}});
    cases.push_back(
        {.function = "tgKelemenSpecular",
         .body = "return float4(tgKelemenSpecular(a0, a1, a2, a3, a4), 0, 0, 0);",
         .arguments = {unit(), unit(), unit(), kRoughness, linear(0, 1)},
         .expected = [](const Inputs& x) { return values(specular(x.vec3(0), x.vec3(1), x.vec3(2), x.scalar(3), x.scalar(4))); },
         .tolerance = {
             .forward = kExpUlp, .backward = 4, .absolute = 1e-7, .why = "one exponential, and unit vectors whose sums round at 1e-7"}});
    return cases;
}

std::vector<FunctionCase> energies() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgEnergyTexel", // as two halves it is kept to 1e-6
                     .body = "float2 h = tgEnergyTexel(a0); return float4(abs(f16tof32(f32tof16(h.x)) - h.x), h.x + h.y, "
                             "abs(f16tof32(f32tof16(h.y)) - h.y) < 1e-6, 0);",
                     .arguments = {linear(0, 2)},
                     .expected = [](const Inputs& x) { return values(0, x.scalar(0), 1); },
                     .tolerance = {.forward = 1, .backward = 0, .absolute = 1e-9, .why = "multiples of powers of two"}});
    cases.push_back(cases.back());
    cases.back().arguments = {linear(0, 7)}; // the printed table reaches pi times an albedo
    cases.back().settings = {0, 1};
    cases.push_back({.function = "tgEnergyDiffuseShare",
                     .body = "return float4(tgEnergyDiffuseShare(a0, a1), 0, 0, 0);",
                     .arguments = {linear(0, 2), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(std::max(1 - (x.seed() ? 1 : x.scalar(1)) * x.scalar(0), 0.0)); },
                     .tolerance = {.forward = 2, .backward = 1, .why = "a product and a difference"},
                     .settings = {0, 1, 2}});
    cases.push_back({.function = "tgEnergyNode",
                     .body = "return float4(tgEnergyNode(float3(sqrt(max(1.0 - a0 * a0, 0.0)), 0.0, a0), a1, (int)a2, (int)a3), 0, 0, 0);",
                     .arguments = {cosine(0, 1), kRoughness, whole(0, kNodes - 1), whole(0, kNodes - 1)},
                     .expected = [](const Inputs& x) { return values(nodePrinted(x.scalar(0), x.scalar(1), x.scalar(2), x.scalar(3))); },
                     .tolerance = {.forward = kExpUlp,
                                   .backward = 4,
                                   .absolute = 2e-5,
                                   .why = "N.H rounds at 1e-7, and PH changes by up to 2 / m^2 of its peak for it"},
                     .settings = {0, 1},
                     .domain = [](const Inputs& x) { return x.scalar(1) > 0.03; }});
    cases.push_back({.function = "tgEnergyNode",
                     .body = "return float4(tgEnergyNode(float3(sqrt(max(1.0 - a0 * a0, 0.0)), 0.0, a0), a1, (int)a2, (int)a3), 0, 0, 0);",
                     .arguments = {cosine(0, 1), kRoughness, whole(0, kNodes - 1), whole(0, kNodes - 1)},
                     .expected = [](const Inputs& x) { return values(nodeSampled(x.scalar(0), x.scalar(1), x.scalar(2), x.scalar(3))); },
                     .tolerance = {.forward = 16,
                                   .backward = 16,
                                   .absolute = 2e-8,
                                   .why = "the half vector's sine is the root of 1 - cosine^2; the weight is pi / 1024"}});
    cases.push_back(
        {.function = "tgEnergyDirectionalAlbedo",
         .body = "return float4(tgEnergyDirectionalAlbedo(a0, a1), 0, 0, 0);",
         .arguments = {cosine(0.05, 1), linear(0.1, 1)},
         .expected = [](const Inputs& x) { return values(reference::directionalAlbedo(x.scalar(0), x.scalar(1), kF0) / std::numbers::pi); },
         .tolerance = {.forward = 4, .backward = 0, .absolute = 2e-3, .why = "1024 midpoints; the horizon cuts some of their cells"},
         .samples = 512});
    cases.push_back(
        {.function = "tgEnergyDirectionalAlbedo",
         .body = "return float4(tgEnergyDirectionalAlbedo(a0, a1), 0, 0, 0);",
         .arguments = {cosine(1e-7, 1), linear(0.1, 1)},
         .expected =
             [](const Inputs& x) { return values(reference::directionalAlbedoPrinted(x.scalar(0), x.scalar(1), kPrintedF0, kNodes)); },
         .tolerance = {.forward = 4,
                       .backward = 0,
                       .absolute = 2e-5,
                       .why = "1024 terms; where m is 0.1 N.H rounds at 1e-7 and PH changes by 200 times that"},
         .settings = {0},
         .samples = 512});
    return cases;
}

} // namespace

std::vector<FunctionCase> specularCases() {
    return together(lobes(), energies(), widenedLobes());
}

} // namespace tegument::test
