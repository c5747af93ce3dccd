// hlsl/peers/preintegrated.fxh and penumbra.fxh. References: docs/design/peers.md, lab/reference/peers.h.

#include "lab/reference/peers.h"
#include "tests/hlsl/peer_cases.h"

#include <algorithm>

namespace tegument::test {

namespace {

double normal(double x, double variance) {
    return std::exp(-x * x / (2 * variance)) / std::sqrt(2 * kPeerPi * variance);
}

glm::dvec3 safeUnit(const glm::dvec3& v) {
    return v / std::max(glm::length(v), 1e-10);
}

/// The table's content: light around a ring, less the light itself. A flat surface, to which rings of 10 m come close, is its limit.
glm::dvec3 texel(const Inputs& x) {
    const double cosine = std::clamp(x.scalar(0), -1.0, 1.0);
    const double radius = 1 / std::max(x.scalar(1), 1e-4);
    const glm::dvec3 light = x.corrected() ? reference::ring(reference::skinProfile(), radius, cosine)
                                           : reference::ringPrinted(reference::skinProfile(), radius, cosine);
    return light - std::max(cosine, 0.0);
}

const Tolerance kIntegral{.forward = 64,
                          .backward = 8,
                          .absolute = 1e-3,
                          .why = "steps of 0.05 mm beside a light whose slope has an edge; acos keeps 3e-4 near its ends"};

std::vector<FunctionCase> integrals() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgPreintegratedGaussian",
                     .body = "return float4(tgPreintegratedGaussian(a0, a1, a2), 0);",
                     .arguments = {linear(0.005, 1, 4), linear(0, 0.5), linear(1, 1.5)},
                     .expected =
                         [](const Inputs& x) {
                             const double variance = std::max(x.scalar(0, 3) * x.scalar(2), 1e-6);
                             return values(glm::dvec3(x.vec4(0)) * normal(x.scalar(1), variance));
                         },
                     .tolerance = {.forward = 64, .backward = 8, .absolute = 1e-12, .why = "exp: 3 + 2|x| ULP with |x| up to 25"},
                     .domain = [](const Inputs& x) { return x.scalar(0, 3) > 0.004; }});
    cases.push_back({.function = "tgPreintegratedProfile",
                     .body = std::string(kGaussianRows) + "return float4(tgPreintegratedProfile(g, a0, a1), 0);",
                     .arguments = {linear(-10, 10), linear(1, 1.5)},
                     .expected =
                         [](const Inputs& x) {
                             glm::dvec3 sum(0);
                             for (const reference::Gaussian& one : reference::skinProfile())
                                 sum += one.weight * normal(x.scalar(0), one.variance * x.scalar(1));
                             return values(sum);
                         },
                     .tolerance = {.forward = 64, .backward = 8, .absolute = 1e-12, .why = "six exponentials"}});
    cases.push_back(
        {.function = "tgPreintegratedPair",
         .body = "return float4(tgPreintegratedPair(a0, a1), 0, 0, 0);",
         .arguments = {linear(0, kPeerPi), linear(0, 5)},
         .expected =
             [](const Inputs& x) {
                 return values(std::max(std::cos(x.scalar(0) + x.scalar(1)), 0.0) + std::max(std::cos(x.scalar(0) - x.scalar(1)), 0.0));
             },
         .tolerance = {.forward = 4, .backward = 2, .absolute = 5e-6, .why = "a cosine: 2^-11 in Vulkan, measured far better"}});
    const auto cosineArgument = linear(-1, 1);
    cases.push_back({.function = "tgPreintegratedScattered",
                     .body = std::string(kGaussianRows) + "return float4(tgPreintegratedScattered(g, a0, a1), 0);",
                     .arguments = {linear(0, kPeerPi), linear(1e-3, 0.5)},
                     .expected =
                         [](const Inputs& x) {
                             return values(
                                 reference::ring(reference::skinProfile(), 1 / std::max(x.scalar(1), 1e-4), std::cos(x.scalar(0))));
                         },
                     .tolerance = kIntegral,
                     .samples = 512,
                     .domain = [](const Inputs& x) { return x.scalar(0) >= 0 && x.scalar(0) <= kPeerPi && x.scalar(1) >= 1e-4; }});
    cases.push_back({.function = "tgPreintegratedScattered",
                     .body = std::string(kGaussianRows) + "return float4(tgPreintegratedScattered(g, a0, a1), 0);",
                     .arguments = {linear(0, kPeerPi), linear(0.02, 0.5)},
                     .expected =
                         [](const Inputs& x) {
                             return values(
                                 reference::ringPrinted(reference::skinProfile(), 1 / std::max(x.scalar(1), 1e-4), std::cos(x.scalar(0))));
                         },
                     .tolerance = kIntegral,
                     .settings = {0},
                     .samples = 512,
                     .domain = [](const Inputs& x) { return x.scalar(0) >= 0 && x.scalar(0) <= kPeerPi && x.scalar(1) >= 0.02; }});
    cases.push_back({.function = "tgPreintegratedTexel",
                     .body = std::string(kGaussianRows) + "return float4(tgPreintegratedTexel(g, a0, a1), 0);",
                     .arguments = {cosineArgument, linear(0.02, 0.5)},
                     .expected = [](const Inputs& x) { return values(texel(x)); },
                     .tolerance = kIntegral,
                     .settings = {0, 2},
                     .samples = 512,
                     .domain = [](const Inputs& x) { return std::abs(x.scalar(0)) <= 1 && x.scalar(1) >= 0.02; }});
    return cases;
}

/// Of four texels; the table is small in the test, and POINT: the nearest.
glm::dvec3 lookedUp(const Inputs& x) {
    glm::dvec3 light;
    for (int c = 0; c < 3; ++c) {
        const double cosine = x.vec3(0)[c];
        const glm::dvec2 place = glm::clamp(glm::dvec2(cosine / 2 + 0.5, x.scalar(1) / 0.5), 0.0, 1.0);
        const glm::dvec2 uv = (place * glm::dvec2(256, 64) + 0.5) / glm::dvec2(257, 65);
        light[c] = std::max(std::clamp(cosine, 0.0, 1.0) + irradianceMap().at(uv)[c], 0.0);
    }
    return light;
}

std::vector<FunctionCase> lookups() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgPreintegratedArguments",
                     .body = "return float4(tgPreintegratedArguments(a0), 0, 0);",
                     .arguments = {linear(0, 1, 2)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec2 place = (x.vec2(0) * glm::dvec2(257, 65) - 0.5) / glm::dvec2(256, 64);
                             return values(std::clamp(2 * place.x - 1, -1.0, 1.0), std::clamp(place.y / 2, 0.0, 0.5));
                         },
                     .tolerance = {.forward = 4, .backward = 2, .absolute = 3e-7, .why = "sums of numbers near 1"}});
    cases.push_back({.function = "tgPreintegratedCoordinate",
                     .body = "return float4(tgPreintegratedCoordinate(a0, a1), 0, 0);",
                     .arguments = {linear(-1.5, 1.5), linear(0, 1)},
                     .expected =
                         [](const Inputs& x) { // texel (0, 0) is cosine -1 on a flat surface, the last cosine 1 at 2 mm
                             return values((std::clamp((x.scalar(0) + 1) / 2, 0.0, 1.0) * 256 + 0.5) / 257,
                                           (std::clamp(x.scalar(1) * 2, 0.0, 1.0) * 64 + 0.5) / 65);
                         },
                     .tolerance = {.forward = 4, .backward = 2, .absolute = 2e-7, .why = "sums of numbers near 1"}});
    cases.push_back(
        {.function = "tgPreintegratedCurvature",
         .body = "float2 p = pixel - floor(pixel / 2) * 2; return float4(tgPreintegratedCurvature(a0 * p.x + a1 * p.y, a2 * p.x + a3 * "
                 "p.y), 0, "
                 "0, 0);",
         .arguments = {linear(-0.1, 0.1, 3), linear(-0.1, 0.1, 3), linear(-2, 2, 3), linear(-2, 2, 3)},
         .expected =
             [](const Inputs& x) {
                 const glm::dvec3 nx = x.vec3(0), ny = x.vec3(1), px = x.vec3(2), py = x.vec3(3);
                 const double along = glm::dot(nx, px) + glm::dot(ny, py);
                 const double squares = glm::dot(px, px) + glm::dot(py, py);
                 const double printed = glm::length(glm::abs(nx) + glm::abs(ny)) / glm::length(glm::abs(px) + glm::abs(py));
                 return values(x.corrected() ? std::max(along / squares, 0.0) : printed);
             },
         .tolerance = {.forward = 16, .backward = 4, .absolute = 1e-6, .why = "a sum of products that may cancel, over a square"},
         .settings = {0, 2},
         .perQuad = true,
         .domain = [](const Inputs& x) { return glm::length(x.vec3(2)) + glm::length(x.vec3(3)) > 0.2; }});
    cases.push_back({.function = "tgPreintegratedCosines",
                     .body = "return float4(tgPreintegratedCosines(a0, a1, a2, a3), 0);",
                     .arguments = {unit(), unit(), unit(), linear(0, 1, 3)},
                     .expected =
                         [](const Inputs& x) {
                             glm::dvec3 result;
                             for (int c = 0; c < 3; ++c)
                                 result[c] = glm::dot(safeUnit(glm::mix(x.vec3(0), x.vec3(1), x.vec3(3)[c])), x.vec3(2));
                             return values(result);
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 2e-6, .why = "normalised sums"},
                     .domain = [](const Inputs& x) { return glm::length(x.vec3(0) + x.vec3(1)) > 0.2; }}); // opposite normals cancel
    cases.push_back({.function = "tgPreintegratedLight",
                     .body = "return float4(tgPreintegratedLight(TG_SAMPLER2D_ARG(gTest), a0, a1), 0);",
                     .arguments = {linear(-1, 1, 3, 2e-7), linear(0, 0.5, 1, 1e-7)},
                     .expected = [](const Inputs& x) { return values(lookedUp(x)); },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-6, .why = "on the border of two texels it may be either"},
                     .map = &irradianceMap()});
    cases.push_back({.function = "tgPreintegratedTolerance",
                     .body = "return float4(tgPreintegratedTolerance(a0, a1), 0, 0, 0);",
                     .arguments = {cosine(), linear(1e-3, 0.5)},
                     .expected =
                         [](const Inputs& x) { // 1.25 chords of the ring from N.L = 0.1 on, at most 10 mm
                             return values(std::min(1.25 * 2 * std::max(0.1 - x.scalar(0), 0.0) / std::max(x.scalar(1), 1e-4), 10.0));
                         },
                     .tolerance = {.forward = 6, .backward = 1, .absolute = 2e-5, .why = "0.1 less the cosine may cancel, over 1e-3"}});
    return cases;
}

// Penumbras.
// --------------------------------------------------------------------------------------------------------------------------------

glm::dvec2 discTap(int i, double turn) {
    const double height = 1 - (i + 0.5) / 32;
    const double angle = kGoldenAngle * i + 2 * kPeerPi * turn;
    return std::sqrt(1 - height * height) * glm::dvec2(std::cos(angle), std::sin(angle));
}

double discShare(const Inputs& x) {
    double lit = 0;
    for (int i = 0; i < 32; ++i) {
        const glm::dvec2 tap = discTap(i, x.scalar(5));
        const glm::dvec3 offset = tap.x * x.vec3(2) + tap.y * x.vec3(3);
        const double stored = shadowMap().at(x.vec2(0) + glm::dvec2(offset)).x;
        const double plane = x.scalar(1) + offset.z - x.scalar(4) * glm::length(tap);
        lit += plane <= (stored > 0 ? stored : 1e9);
    }
    return lit / 32;
}

double edgeOf(double x, double variance) {
    return 0.5 * (1 + std::erf(x / std::sqrt(2 * variance)));
}

glm::dvec3 penumbra(const Inputs& x) {
    const double reach = x.scalar(2);
    const double at = (2 * x.scalar(1) - 1) * reach;
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 6; ++i) {
        const reference::Gaussian& one = reference::skinProfile()[i];
        const double dark = edgeOf(-reach, one.variance);
        const double lit = edgeOf(reach, one.variance);
        sum += one.weight * (i < 3 ? x.scalar(0) : std::clamp((edgeOf(at, one.variance) - dark) / (lit - dark), 0.0, 1.0));
    }
    return sum;
}

std::vector<FunctionCase> penumbras() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgPenumbraTap",
                     .body = "return float4(tgPenumbraTap(a0, a1), 0, 0);",
                     .arguments = {whole(0, 31), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(discTap(static_cast<int>(x.scalar(0)), x.scalar(1))); },
                     .tolerance = {.forward = 8, .backward = 0, .absolute = 2e-5, .why = "an angle of up to 80 radians keeps 1e-5"}});
    cases.push_back({.function = "tgPenumbraAxis",
                     .body = "return float4(tgPenumbraAxis(a0, a1, a2, a3, a4), 0);",
                     .arguments = {vector(3, 0.1, 20), unit(), unit(), unit(), linear(0.05, 2)},
                     .expected =
                         [](const Inputs& x) {
                             const double size = x.scalar(4) * kTestMapSize;
                             return values(glm::dvec3(glm::dot(x.vec3(0), x.vec3(1)) / size, -glm::dot(x.vec3(0), x.vec3(2)) / size,
                                                      -glm::dot(x.vec3(0), x.vec3(3))));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 1e-5, .why = "dot products of up to 20 that may cancel"},
                     .domain = [](const Inputs& x) { return x.scalar(4) > 0.01; }});
    cases.push_back(
        {.function = "tgPenumbraShare",
         .body = "return float4(tgPenumbraShare(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, a3, a4, a5), 0, 0, 0);",
         .arguments = {peerUv(0.2, 0.8), linear(595, 605), linear(-0.05, 0.05, 3), linear(-0.05, 0.05, 3), linear(0, 5), linear(0, 1)},
         .expected = [](const Inputs& x) { return values(discShare(x)); },
         .tolerance = {.forward = 4,
                       .backward = 2,
                       .absolute = 1.01 / 32,
                       .why = "one of 32 taps on the border of two texels, or a depth within rounding, may be either"},
         .map = &shadowMap()});
    cases.push_back(
        {.function = "tgPenumbraEdge",
         .body = "return float4(tgPenumbraEdge(a0), 0, 0, 0);",
         .arguments = {linear(-6, 6)},
         .expected = [](const Inputs& x) { return values(0.5 * (1 + std::erf(x.scalar(0) / std::numbers::sqrt2))); },
         .tolerance = {.forward = 0, .backward = 2, .absolute = 3e-7, .why = "the approximation's own 7.5e-8, and rounding near 1"}});
    cases.push_back(
        {.function = "tgPenumbraShadow",
         .body = std::string(kGaussianRows) + "return float4(tgPenumbraShadow(g, a0, a1, a2), 0);",
         .arguments = {linear(0, 1), linear(0, 1), linear(1, 20)},
         .expected = [](const Inputs& x) { return values(penumbra(x)); },
         .tolerance = {
             .forward = 4, .backward = 4, .absolute = 2e-6, .why = "the approximation of tgPenumbraEdge, divided by as little as 0.29"}});
    return cases;
}

} // namespace

std::vector<FunctionCase> peerTableCases() {
    return together(integrals(), lookups(), penumbras());
}

} // namespace tegument::test
