// hlsl/scatter (without gaussian.fxh) against the definitions of docs/design/modules/Irradiance.md and docs/design/skin.md.

#include "tests/hlsl/maps.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::test {

namespace {

constexpr double kLargestAlpha = 0.99;
constexpr double kOpaque = 5000;

double saturate(double x) {
    return std::clamp(x, 0.0, 1.0);
}

/// Bilinear over the valid texels among four, renormalised.
glm::dvec4 overValid(glm::dvec2 uv) {
    const glm::dvec2 place = uv * double{kTestMapSize} - 0.5;
    const glm::dvec2 corner = glm::floor(place);
    const glm::dvec2 f = place - corner;
    glm::dvec4 sum(0);
    double total = 0;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const glm::dvec4 texel = irradianceMap().texel(static_cast<int>(corner.x) + i, static_cast<int>(corner.y) + j);
            if (texel.w >= 0.995) continue;
            const double weight = (i == 0 ? 1 - f.x : f.x) * (j == 0 ? 1 - f.y : f.y);
            sum += weight * texel;
            total += weight;
        }
    return total > 1e-4 ? sum / total : glm::dvec4(0, 0, 0, 1);
}

double share(const Inputs& x) {
    const double t = x.scalar(0);
    const double v = x.scalar(1);
    const double exponent = t * t / (x.seed() ? v : 2 * v);
    const double passed = exponent < 50 ? std::exp(-exponent) : 0; // 2e-22: nothing
    return x.seed() ? passed : passed * saturate(x.scalar(2) / (6 * std::sqrt(v)));
}

/// On a ball of radius a h is r^2 / (2 a), and its curvature 1 / a.
std::vector<FunctionCase> flesh() {
    const Tolerance sums{.forward = 16, .backward = 4, .absolute = 2e-4, .why = "differences of places and of normals"};
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgFleshUnder",
                     .body = "return float4(tgFleshUnder(a2 * a0, a0, a2 * a1, a1), tgFleshUnder(a2 * a0, -a0, a2 * a1, -a1), "
                             "tgFleshUnder(a0, float3(0, 0, 1), a1, float3(0, 0, 1)), tgFleshCurvature(a2 * a0, a0, a2 * a1, a1));",
                     .arguments = {unit(), unit(), linear(1, 20)},
                     .expected =
                         [](const Inputs& x) {
                             const double squared = glm::dot(x.vec3(0) - x.vec3(1), x.vec3(0) - x.vec3(1));
                             const double radius = x.scalar(2);
                             return values(radius * squared / 2, 0, 0, 1 / radius); // a hollow has none, nor has a plane
                         },
                     .tolerance = sums,
                     .domain =
                         [](const Inputs& x) {
                             return isUnit(x.vec3(0)) && isUnit(x.vec3(1)) && x.scalar(2) > 0.5 &&
                                    glm::length(x.vec3(0) - x.vec3(1)) > 0.05;
                         }});
    cases.push_back({.function = "tgFleshCurvature",
                     .body = "return tgFleshCurvature(a2 * a0, a0, a2 * a1, a1).xxxx;",
                     .arguments = {unit(), unit(), linear(1, 20)},
                     .expected = [](const Inputs& x) { return values(1 / x.scalar(2), 1 / x.scalar(2), 1 / x.scalar(2), 1 / x.scalar(2)); },
                     .tolerance = sums,
                     .domain =
                         [](const Inputs& x) {
                             return isUnit(x.vec3(0)) && isUnit(x.vec3(1)) && x.scalar(2) > 0.5 &&
                                    glm::length(x.vec3(0) - x.vec3(1)) > 0.05;
                         }});
    cases.push_back({.function = "tgFleshShare",
                     .body = "return float4(tgFleshShare(a0, a1, a2), 0);",
                     .arguments = {linear(0, 3, 3), linear(0, 1), linear(0, 12)},
                     .expected = [](const Inputs& x) { return values(1.0 + x.vec3(0) * (x.scalar(1) * x.scalar(2))); },
                     .tolerance = sums});
    return cases;
}

std::vector<FunctionCase> entering() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgIrradianceColour",
                     .body = "return float4(tgIrradianceColour(a0, a1), 0);",
                     .arguments = {linear(0, 1, 3), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(glm::pow(glm::max(x.vec3(0), 1e-5), glm::dvec3(x.scalar(1)))); },
                     .tolerance = {.forward = 40, .backward = 2, .why = "pow is exp2(y log2 x): 3 + 2|x| ULP with |x| up to 17"}});
    cases.push_back({.function = "tgIrradianceBounded",
                     .body = "return float4(tgIrradianceBounded(a0, kTgLargestHalf), 0);",
                     .arguments = {linear(-1e5, 2e5, 3)},
                     .expected = [](const Inputs& x) { return values(glm::clamp(x.vec3(0), 0.0, 64512.0)); },
                     .tolerance = {.forward = 0, .backward = 0, .why = "one of the given numbers"}});
    for (const auto& [bits, most] : {std::pair("16", 64512.0), std::pair("32", 1e30)}) // of maps of halves, of floats
        cases.push_back({.function = "kTgLargestLight",
                         .body = "return float4(tgIrradianceBounded(a0, kTgLargestLight), 0);",
                         .arguments = {linear(-1e5, 2e5, 3)},
                         .expected = [most = most](const Inputs& x) { return values(glm::clamp(x.vec3(0), 0.0, most)); },
                         .tolerance = {.forward = 0, .backward = 0, .why = "one of the given numbers"},
                         .defines = {{"TEGUMENT_MAP_BITS", bits}}});
    cases.push_back({.function = "tgIrradianceBounded", // what is no number, and what is infinite
                     .body = "float zero = a0 - a0; float none = zero / zero; return float4(tgIrradianceBounded(float3(none, 1.0 / zero, "
                             "-1.0 / zero), 3.0), 0);",
                     .arguments = {linear(1, 2)},
                     .expected = [](const Inputs&) { return values(0, 3, 0); },
                     .tolerance = {.forward = 0, .backward = 0, .why = "given numbers"}});
    cases.push_back(
        {.function = "tgIrradianceEntering",
         .body = "return float4(tgIrradianceEntering(a0, a1, a2, a3, a4, a5), 0);",
         .arguments = {linear(0, 1, 3), linear(0, 1), linear(0, 10, 3), cosine(), linear(0, 1), linear(0, 1)},
         .expected =
             [](const Inputs& x) {
                 const glm::dvec3 colour = glm::pow(glm::max(x.vec3(0), 1e-5), glm::dvec3(x.scalar(1)));
                 return values(colour * x.vec3(2) * (saturate(x.scalar(3)) * x.scalar(4) * x.scalar(5)));
             },
         .tolerance = {
             .forward = 48, .backward = 2, .absolute = 1e-36, .why = "one power, four products, of which a denormal one is flushed to 0"}});
    cases.push_back({.function = "tgSeamValidity",
                     .body = "return float4(tgSeamValidity(a0), 0, 0, 0);",
                     .arguments = {linear(0, 1.01, 4)},
                     .expected = [](const Inputs& x) { return values(x.scalar(0, 3) < 0.995 ? 1 : 0); },
                     .tolerance = {.forward = 0, .backward = 2, .why = "a comparison with 0.995, rounded"}});
    cases.push_back(
        {.function = "tgSeamBilinear",
         .body = "return tgSeamBilinear(TG_SAMPLER2D_ARG(gTest), a0);",
         .arguments = {linear(0.01, 0.99, 2, 2e-7)},
         .expected = [](const Inputs& x) { return values(overValid(x.vec2(0))); },
         .tolerance = {.forward = 8, .backward = 2, .absolute = 1e-5, .why = "the fraction of a texel rounds at 3e-5, the weights with it"},
         .map = &irradianceMap()});
    return cases;
}

std::vector<FunctionCase> passing() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgTransmissionThickness",
                     .body = "return float4(tgTransmissionThickness(a0, a1, a2, a3), 0, 0, 0);",
                     .arguments = {logarithmic(1e-3, 500), cosine(), unit(), unit()},
                     .expected =
                         [](const Inputs& x) {
                             const double path = x.scalar(0);
                             const double parallel = saturate(-glm::dot(x.vec3(3), x.vec3(2)));
                             if (x.scalar(1) > 0) return values(kOpaque);
                             return values(path + parallel * (saturate(-x.scalar(1)) * path - path));
                         },
                     .tolerance = {.forward = 4, .backward = 2, .why = "a dot product and an interpolation"}});
    cases.push_back(
        {.function = "tgTransmissionEncode",
         .body = "return float4(tgTransmissionEncode(a0), 0, 0, 0);",
         .arguments = {logarithmic(1e-4, 5000)},
         .expected = [](const Inputs& x) { return values(std::min(x.seed() ? x.scalar(0) : std::exp(-0.2 * x.scalar(0)), kLargestAlpha)); },
         .tolerance = {.forward = 180, .backward = 1, .why = "exp: 3 + 2|x| ULP with |x| up to 87"},
         .settings = {0, 2}});
    cases.push_back({.function = "tgTransmissionEncode", // what is no number is opaque
                     .body = "float zero = a0 - a0; return float4(tgTransmissionEncode(zero / zero), 0, 0, 0);",
                     .arguments = {linear(1, 2)},
                     .expected = [](const Inputs& x) { return values(x.seed() ? kLargestAlpha : 0); },
                     .tolerance = {.forward = 1, .backward = 0, .why = "a constant"},
                     .settings = {0, 2}});
    cases.push_back(
        {.function = "tgTransmissionDecode",
         .body = "return float4(tgTransmissionDecode(a0, a1), 0, 0, 0);",
         .arguments = {logarithmic(1e-6, 0.99), linear(1, 1000)},
         .expected =
             [](const Inputs& x) { return values(x.seed() ? x.scalar(0) * x.scalar(1) : -5 * std::log(std::max(x.scalar(0), 1e-6))); },
         .tolerance = {.forward = 4, .backward = 2, .absolute = 2e-6, .why = "log: 3 ULP, 2^-21 absolute near 1"},
         .settings = {0, 2}});
    cases.push_back({.function = "tgTransmissionShare",
                     .body = "return float4(tgTransmissionShare(a0, a1, a2), 0, 0, 0);",
                     .arguments = {logarithmic(1e-3, 60), logarithmic(0.0064, 7.41), logarithmic(1e-3, 60)},
                     .expected = [](const Inputs& x) { return values(share(x)); },
                     .tolerance = {.forward = 110,
                                   .backward = 3,
                                   .absolute = 2e-22,
                                   .why = "exp: 3 + 2|x| ULP with |x| up to 50, beyond which it is 0"},
                     .settings = {0, 2},
                     .domain = [](const Inputs& x) { return x.scalar(1) >= 0.006; }}); // the profile has no narrower Gaussian
    cases.push_back(
        {.function = "tgTransmissionScale",
         .body = "float2 p = pixel - floor(pixel / 2) * 2; return float4(tgTransmissionScale(a0 * p.x + a1 * p.y, float2(0.25, 0.5) + a2 * "
                 "p.x + a3 * p.y), 0, 0, 0);",
         .arguments = {linear(-3, 3, 3), linear(-3, 3, 3), linear(-0.03, 0.03, 2, 6e-8), linear(-0.03, 0.03, 2, 6e-8)},
         .expected =
             [](const Inputs& x) {
                 const double area = glm::length(glm::cross(x.vec3(0), x.vec3(1)));
                 const glm::dvec2 dx = x.vec2(2);
                 const glm::dvec2 dy = x.vec2(3);
                 return values(std::sqrt(area / std::max(std::abs(dx.x * dy.y - dx.y * dy.x), 1e-12)));
             },
         .tolerance = {.forward = 16, .backward = 4, .absolute = 1e-4, .why = "differences of coordinates near 0.5 keep 6e-8 of 0.03"},
         .perQuad = true,
         .domain =
             [](const Inputs& x) {
                 const double det = x.scalar(2) * x.scalar(3, 1) - x.scalar(2, 1) * x.scalar(3);
                 return std::abs(det) > 1e-6; // thinner ones are lost in the rounding of uv
             }});
    return cases;
}

/// Of photons through three layers and back (docs/design/skin-error.md, "Through an ear"), over the layers' albedo; between the rows each
/// channel falls exponentially.
glm::dvec3 throughSlab(double thickness) {
    static const std::array kRows = {std::pair(1.5, glm::dvec3(0.1947, 0.1306, 0.0069)), std::pair(2.5, glm::dvec3(0.1738, 0.0837, 0.0002)),
                                     std::pair(4.5, glm::dvec3(0.1392, 0.0373, 1e-7)), std::pair(6.5, glm::dvec3(0.1117, 0.0172, 1e-10))};
    std::size_t i = 0;
    while (i + 2 < kRows.size() && thickness > kRows[i + 1].first)
        ++i;
    const double share = (thickness - kRows[i].first) / (kRows[i + 1].first - kRows[i].first);
    return glm::exp(glm::mix(glm::log(kRows[i].second), glm::log(kRows[i + 1].second), share)) / glm::dvec3(0.4894, 0.4059, 0.3118);
}

std::vector<FunctionCase> slab() {
    return {
        {.function = "tgSlabPassed",
         .body = "return float4(tgSlabPassed(a0), 0);",
         .arguments = {linear(1.5, 6.5)},
         .expected = [](const Inputs& x) { return values(throughSlab(x.scalar(0))); },
         .tolerance = {.absolute = 4e-3, .why = "a fit of the simulation, 1 % off in red and green; its rows are joined by exponentials"}}};
}

} // namespace

std::vector<FunctionCase> scatterCases() {
    return together(flesh(), entering(), passing(), slab());
}

} // namespace tegument::test
