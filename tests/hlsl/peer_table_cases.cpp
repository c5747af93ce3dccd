// hlsl/peers/preintegrated.fxh and penumbra.fxh. References: docs/design/peers.md, lab/reference/peers.h.

#include "lab/reference/peers.h"
#include "tests/hlsl/peer_cases.h"

#include <algorithm>

namespace tegument::test {

namespace {

double normal(double x, double variance) {
    return exp(-x * x / (2 * variance)) / sqrt(2 * kPeerPi * variance);
}

dvec3 safeUnit(const dvec3& v) {
    return v / max(length(v), 1e-10);
}

/// The table's content: light around a ring, less the light itself. A flat surface, to which rings of 10 m come close, is its limit.
dvec3 texel(In x) {
    const double cosine = std::clamp(x[0], -1.0, 1.0);
    const double radius = 1 / max(x[1], 1e-4);
    const dvec3 light = x.corrected() ? reference::ring(reference::skinProfile(), radius, cosine)
                                      : reference::ringPrinted(reference::skinProfile(), radius, cosine);
    return light - max(cosine, 0.0);
}

const Tolerance kIntegral{64, 8, 1e-3, "steps of 0.05 mm beside a light whose slope has an edge; acos keeps 3e-4 near its ends"};

void integrals(Cases& cases) {
    cases.add("tgPreintegratedGaussian(a0, a1, a2)", {linear(0.005, 1, 4), linear(0, 0.5), linear(1, 1.5)},
              {64, 8, 1e-12, "exp: 3 + 2|x| ULP with |x| up to 25"}, [](In x) {
                  const double variance = max(x.scalar(0, 3) * x[2], 1e-6);
                  return dvec3(x.vec4(0)) * normal(x[1], variance);
              });
    cases.back().domain = [](In x) { return x.scalar(0, 3) > 0.004; };
    cases.add({"tgPreintegratedProfile", std::string(kGaussianRows) + "return float4(tgPreintegratedProfile(g, a0, a1), 0);"},
              {linear(-10, 10), linear(1, 1.5)}, {64, 8, 1e-12, "six exponentials"}, [](In x) {
                  dvec3 sum(0);
                  for (const reference::Gaussian& one : reference::skinProfile())
                      sum += one.weight * normal(x[0], one.variance * x[1]);
                  return sum;
              });
    cases.add("tgPreintegratedPair(a0, a1)", {linear(0, kPeerPi), linear(0, 5)},
              {4, 2, 5e-6, "a cosine: 2^-11 in Vulkan, measured far better"},
              [](In x) { return max(cos(x[0] + x[1]), 0.0) + max(cos(x[0] - x[1]), 0.0); });
    const auto cosineArgument = linear(-1, 1);
    cases.add({"tgPreintegratedScattered", std::string(kGaussianRows) + "return float4(tgPreintegratedScattered(g, a0, a1), 0);"},
              {linear(0, kPeerPi), linear(1e-3, 0.5)}, kIntegral, {.samples = 512},
              [](In x) { return reference::ring(reference::skinProfile(), 1 / max(x[1], 1e-4), cos(x[0])); });
    cases.back().domain = [](In x) { return x[0] >= 0 && x[0] <= kPeerPi && x[1] >= 1e-4; };
    cases.add({"tgPreintegratedScattered", std::string(kGaussianRows) + "return float4(tgPreintegratedScattered(g, a0, a1), 0);"},
              {linear(0, kPeerPi), linear(0.02, 0.5)}, kIntegral, {.settings = {0}, .samples = 512},
              [](In x) { return reference::ringPrinted(reference::skinProfile(), 1 / max(x[1], 1e-4), cos(x[0])); });
    cases.back().domain = [](In x) { return x[0] >= 0 && x[0] <= kPeerPi && x[1] >= 0.02; };
    cases.add({"tgPreintegratedTexel", std::string(kGaussianRows) + "return float4(tgPreintegratedTexel(g, a0, a1), 0);"},
              {cosineArgument, linear(0.02, 0.5)}, kIntegral, {.settings = {0, 2}, .samples = 512}, [](In x) { return texel(x); });
    cases.back().domain = [](In x) { return abs(x[0]) <= 1 && x[1] >= 0.02; };
}

/// Of four texels; the table is small in the test, and POINT: the nearest.
dvec3 lookedUp(In x) {
    dvec3 light;
    for (int c = 0; c < 3; ++c) {
        const double cosine = x.vec3(0)[c];
        const dvec2 place = clamp(dvec2(cosine / 2 + 0.5, x[1] / 0.5), 0.0, 1.0);
        const dvec2 uv = (place * dvec2(256, 64) + 0.5) / dvec2(257, 65);
        light[c] = max(saturate(cosine) + irradianceMap().at(uv)[c], 0.0);
    }
    return light;
}

void lookups(Cases& cases) {
    cases.add("tgPreintegratedArguments(a0)", {linear(0, 1, 2)}, {4, 2, 3e-7, "sums of numbers near 1"}, [](In x) {
        const dvec2 place = (x.vec2(0) * dvec2(257, 65) - 0.5) / dvec2(256, 64);
        return values(std::clamp(2 * place.x - 1, -1.0, 1.0), std::clamp(place.y / 2, 0.0, 0.5));
    });
    // texel (0, 0) is cosine -1 on a flat surface, the last cosine 1 at 2 mm
    cases.add("tgPreintegratedCoordinate(a0, a1)", {linear(-1.5, 1.5), linear(0, 1)}, {4, 2, 2e-7, "sums of numbers near 1"},
              [](In x) { return values((saturate((x[0] + 1) / 2) * 256 + 0.5) / 257, (saturate(x[1] * 2) * 64 + 0.5) / 65); });
    cases.add({"tgPreintegratedCurvature", "float2 p = pixel - floor(pixel / 2) * 2; return float4(tgPreintegratedCurvature(a0 * p.x + a1 "
                                           "* p.y, a2 * p.x + a3 * p.y), 0, 0, 0);"},
              {linear(-0.1, 0.1, 3), linear(-0.1, 0.1, 3), linear(-2, 2, 3), linear(-2, 2, 3)},
              {16, 4, 1e-6, "a sum of products that may cancel, over a square"}, {.settings = {0, 2}, .perQuad = true}, [](In x) {
                  const dvec3 nx = x.vec3(0), ny = x.vec3(1), px = x.vec3(2), py = x.vec3(3);
                  const double along = dot(nx, px) + dot(ny, py);
                  const double squares = dot(px, px) + dot(py, py);
                  const double printed = length(abs(nx) + abs(ny)) / length(abs(px) + abs(py));
                  return x.corrected() ? max(along / squares, 0.0) : printed;
              });
    cases.back().domain = [](In x) { return length(x.vec3(2)) + length(x.vec3(3)) > 0.2; };
    cases.add("tgPreintegratedCosines(a0, a1, a2, a3)", {unit(), unit(), unit(), linear(0, 1, 3)}, {8, 4, 2e-6, "normalised sums"},
              [](In x) {
                  dvec3 result;
                  for (int c = 0; c < 3; ++c)
                      result[c] = dot(safeUnit(mix(x.vec3(0), x.vec3(1), x.vec3(3)[c])), x.vec3(2));
                  return result;
              });
    cases.back().domain = [](In x) { return length(x.vec3(0) + x.vec3(1)) > 0.2; }; // opposite normals cancel
    cases.add("tgPreintegratedLight(TG_SAMPLER2D_ARG(gTest), a0, a1)", {linear(-1, 1, 3, 2e-7), linear(0, 0.5, 1, 1e-7)},
              {8, 4, 1e-6, "on the border of two texels it may be either"}, {.map = &irradianceMap()}, [](In x) { return lookedUp(x); });
    // 1.25 chords of the ring from N.L = 0.1 on, at most 10 mm
    cases.add("tgPreintegratedTolerance(a0, a1)", {cosine(), linear(1e-3, 0.5)}, {6, 1, 2e-5, "0.1 less the cosine may cancel, over 1e-3"},
              [](In x) { return min(1.25 * 2 * max(0.1 - x[0], 0.0) / max(x[1], 1e-4), 10.0); });
}

// Penumbras.
// --------------------------------------------------------------------------------------------------------------------------------

dvec2 discTap(int i, double turn) {
    const double height = 1 - (i + 0.5) / 32;
    const double angle = kGoldenAngle * i + 2 * kPeerPi * turn;
    return sqrt(1 - height * height) * dvec2(cos(angle), sin(angle));
}

double discShare(In x) {
    double lit = 0;
    for (int i = 0; i < 32; ++i) {
        const dvec2 tap = discTap(i, x[5]);
        const dvec3 offset = tap.x * x.vec3(2) + tap.y * x.vec3(3);
        const double stored = shadowMap().at(x.vec2(0) + dvec2(offset)).x;
        const double plane = x[1] + offset.z - x[4] * length(tap);
        lit += plane <= (stored > 0 ? stored : 1e9);
    }
    return lit / 32;
}

double edgeOf(double x, double variance) {
    return 0.5 * (1 + std::erf(x / sqrt(2 * variance)));
}

dvec3 penumbra(In x) {
    const double reach = x[2];
    const double at = (2 * x[1] - 1) * reach;
    dvec3 sum(0);
    for (std::size_t i = 0; i < 6; ++i) {
        const reference::Gaussian& one = reference::skinProfile()[i];
        const double dark = edgeOf(-reach, one.variance);
        const double lit = edgeOf(reach, one.variance);
        sum += one.weight * (i < 3 ? x[0] : saturate((edgeOf(at, one.variance) - dark) / (lit - dark)));
    }
    return sum;
}

void penumbras(Cases& cases) {
    cases.add("tgPenumbraTap(a0, a1)", {whole(0, 31), linear(0, 1)}, {8, 0, 2e-5, "an angle of up to 80 radians keeps 1e-5"},
              [](In x) { return discTap(static_cast<int>(x[0]), x[1]); });
    cases.add("tgPenumbraAxis(a0, a1, a2, a3, a4)", {vector(3, 0.1, 20), unit(), unit(), unit(), linear(0.05, 2)},
              {8, 4, 1e-5, "dot products of up to 20 that may cancel"}, [](In x) {
                  const double size = x[4] * kTestMapSize;
                  return dvec3(dot(x.vec3(0), x.vec3(1)) / size, -dot(x.vec3(0), x.vec3(2)) / size, -dot(x.vec3(0), x.vec3(3)));
              });
    cases.back().domain = [](In x) { return x[4] > 0.01; };
    cases.add("tgPenumbraShare(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, a3, a4, a5)",
              {peerUv(0.2, 0.8), linear(595, 605), linear(-0.05, 0.05, 3), linear(-0.05, 0.05, 3), linear(0, 5), linear(0, 1)},
              {4, 2, 1.01 / 32, "one of 32 taps on the border of two texels, or a depth within rounding, may be either"},
              {.map = &shadowMap()}, [](In x) { return discShare(x); });
    cases.add("tgPenumbraEdge(a0)", {linear(-6, 6)}, {0, 2, 3e-7, "the approximation's own 7.5e-8, and rounding near 1"},
              [](In x) { return 0.5 * (1 + std::erf(x[0] / std::numbers::sqrt2)); });
    cases.add({"tgPenumbraShadow", std::string(kGaussianRows) + "return float4(tgPenumbraShadow(g, a0, a1, a2), 0);"},
              {linear(0, 1), linear(0, 1), linear(1, 20)},
              {4, 4, 2e-6, "the approximation of tgPenumbraEdge, divided by as little as 0.29"}, [](In x) { return penumbra(x); });
}

} // namespace

Cases peerTableCases() {
    return together(integrals, lookups, penumbras);
}

} // namespace tegument::test
