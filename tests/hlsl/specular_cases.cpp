// hlsl/specular against lab/reference and the formulas of docs/design/modules/Beckmann.md and EnergyAttenuation.md.

#include "lab/reference/specular.h"
#include "tests/hlsl/function_case.h"

#include <numbers>

namespace tegument::test {

namespace {

/// Vulkan allows exp(x) an error of 3 + 2|x| ULP; |x| reaches 87 before the result is denormal.
constexpr double kExpUlp = 180;

/// Of setting corrected; the printed ones have another.
constexpr double kF0 = 0.04;
constexpr double kPrintedF0 = 0.028;

/// N.L rho_s PH F / |L + V|^2 with the guards that beckmannPH and tgKelemenSpecular state: |L + V|^2 at least 1e-4, N.H at least 1e-3.
double specular(const dvec3& n, const dvec3& l, const dvec3& v, double m, double rhoS, double f0 = kF0) {
    const dvec3 h = l + v;
    const double square = dot(h, h);
    const dvec3 halfway = square > 0 ? h / sqrt(square) : dvec3(0);
    const double ph = reference::beckmannPH(max(dot(n, halfway), 1e-3), m);
    return saturate(dot(n, l)) * rhoS * ph * reference::fresnelSchlick(dot(v, halfway), f0) / max(square, 1e-4);
}

dvec3 eyeAt(double cosine) {
    return {sqrt(max(1 - cosine * cosine, 0.0)), 0, cosine};
}

constexpr int kNodes = 32;

double nodePrinted(double cosine, double m, double i, double j) {
    const double phi = 2 * std::numbers::pi * i / (kNodes - 1);
    const double theta = 0.5 * std::numbers::pi * j / (kNodes - 1);
    const dvec3 l{sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
    return pow(std::numbers::pi / kNodes, 2) * sin(theta) * specular({0, 0, 1}, l, eyeAt(cosine), m, 1, kPrintedF0);
}

/// pi F (2 - N.V / (V.H N.H)) / 32^2 at the half vector whose slope is m sqrt(-ln(1 - u)).
double nodeSampled(double cosine, double m, double i, double j) {
    const double phi = std::numbers::pi * (i + 0.5) / kNodes;
    const double slope = m * sqrt(-log(1 - (j + 0.5) / kNodes));
    const dvec3 h = normalize(dvec3(slope * cos(phi), slope * sin(phi), 1));
    const double vh = dot(eyeAt(cosine), h);
    const double share = vh > 0 ? max(2 - cosine / (vh * h.z), 0.0) : 0;
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
        const double weight = exp(-t) * kStep / 3 * (i == 0 || i == kPieces ? 1 : i % 2 == 0 ? 2 : 4);
        const double root = sqrt(1 + 2 * variance * t);
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
        variance = max(variance - (mean - length) / slope, 0.0);
    }
    return variance;
}

/// Below the map's rounding, 0.004, nothing is lost.
double lostVariance(double mean) {
    const double variance = varianceOf(max(mean, 0.5));
    return sqrt(max(variance * variance - 0.004 * 0.004, 0.0));
}

/// What the slopes' variance adds to m^2, twice.
double widened(double m, double mean) {
    return min(sqrt(m * m + 2 * lostVariance(mean)), max(m, 1.0));
}

void widenedLobes(Cases& cases) {
    cases.add("tgLostVariance(a0)", {linear(0.76, 1.02)}, {8, 2, 0.013, "2.5 % of 0.5, the greatest variance here"}, {.samples = 512},
              [](In x) { return lostVariance(x[0]); });
    FunctionCase widens = check("tgRoughnessWidened(a0, a1)", {kRoughness, linear(0, 1.02)},
                                {8, 2, 0.013, "the variance is within 2.5 %, half of that of m, which is 1 at most"}, {.samples = 512},
                                [](In x) { return widened(x[0], x[1]); });
    cases.push_back(widens);
    widens.arguments = {linear(0.01, 0.1), linear(0.98, 1.02)};
    widens.tolerance = {8, 2, 1e-3, "little relief: the variance is within 0.1 %, beside a root of m^2 and of its own square"};
    widens.domain = [](In x) { return abs(varianceOf(x[1]) - 0.004) > 1e-4; };
    cases.push_back(widens);
    cases.add("tgTwoLobes(tgSafeNormalize(a0), tgSafeNormalize(a1), tgSafeNormalize(a2), float2(a3, a4), a5, 0.18)",
              {linear(-1, 1, 3), linear(-1, 1, 3), linear(-1, 1, 3), linear(0.2, 1), linear(0.2, 1), linear(0, 1)},
              {2 * kExpUlp, 8, 1e-6, "two exponentials of up to 87, 2|x| ULP each"}, [](In x) {
                  const dvec3 n = normalize(x.vec3(0));
                  const dvec3 l = normalize(x.vec3(1));
                  const dvec3 v = normalize(x.vec3(2));
                  const double first = specular(n, l, v, x[3], 0.18);
                  const double second = specular(n, l, v, x[4], 0.18);
                  return (1 - x[5]) * first + x[5] * second;
              });
    cases.back().domain = [](In x) {
        const double longest = min({length(x.vec3(0)), length(x.vec3(1)), length(x.vec3(2))});
        if (longest < 0.05) return false;
        return length(normalize(x.vec3(1)) + normalize(x.vec3(2))) > 0.1;
    };
}

void lobes(Cases& cases) {
    cases.add("tgBeckmannPH(a0, a1)", {cosine(0, 1), kRoughness},
              {kExpUlp, 4, 1e-33,
               "one exponential: 3 + 2|x| ULP, |x| up to 87; below 1.2e-38 it is flushed to 0, before the quotient by m^2 c^4"},
              [](In x) { return reference::beckmannPH(x[0], x[1]); });
    cases.add("tgBeckmannEncode(a0)", {logarithmic(1e-29, 1e6)},
              {24, 2, 0, "pow is exp2(0.1 log2 x): 3 + 2|0.1 * 97| ULP and 3 of the logarithm"},
              [](In x) { return 0.5 * pow(max(x[0], 1e-30), 0.1); });
    cases.add("tgBeckmannDecode(a0)", {linear(0, 2)},
              {300, 2, 0, "pow is exp2(10 log2 x): 3 + 2|x| ULP with |x| up to 126, and ten times those of the logarithm"},
              [](In x) { return pow(2 * x[0], 10); });
    cases.add("tgFresnelSchlick(a0, a1)", {cosine(-1, 2), linear(0, 1)}, {8, 2, 0, "eight roundings"},
              [](In x) { return reference::fresnelSchlick(x[0], x[1]); });
    cases.add("tgKelemenSpecular(a0, a1, a2, a3, a4)", {unit(), unit(), unit(), kRoughness, linear(0, 1)},
              {kExpUlp, 4, 1e-7, "one exponential, and unit vectors whose sums round at 1e-7"},
              [](In x) { return specular(x.vec3(0), x.vec3(1), x.vec3(2), x[3], x[4]); });
}

void energies(Cases& cases) {
    // as two halves it is kept to 1e-6
    cases.add({"tgEnergyTexel", "float2 h = tgEnergyTexel(a0); return float4(abs(f16tof32(f32tof16(h.x)) - h.x), h.x + h.y, "
                                "abs(f16tof32(f32tof16(h.y)) - h.y) < 1e-6, 0);"},
              {linear(0, 2)}, {1, 0, 1e-9, "multiples of powers of two"}, [](In x) { return values(0, x[0], 1); });
    cases.push_back(cases.back());
    cases.back().arguments = {linear(0, 7)}; // the printed table reaches pi times an albedo
    cases.back().settings = {0, 1};
    cases.add("tgEnergyDiffuseShare(a0, a1)", {linear(0, 2), linear(0, 1)}, {2, 1, 0, "a product and a difference"},
              {.settings = {0, 1, 2}}, [](In x) { return max(1 - (x.seed() ? 1 : x[1]) * x[0], 0.0); });
    cases.add("tgEnergyNode(float3(sqrt(max(1.0 - a0 * a0, 0.0)), 0.0, a0), a1, (int)a2, (int)a3)",
              {cosine(0, 1), kRoughness, whole(0, kNodes - 1), whole(0, kNodes - 1)},
              {kExpUlp, 4, 2e-5, "N.H rounds at 1e-7, and PH changes by up to 2 / m^2 of its peak for it"}, {.settings = {0, 1}},
              [](In x) { return nodePrinted(x[0], x[1], x[2], x[3]); });
    cases.back().domain = [](In x) { return x[1] > 0.03; };
    cases.add("tgEnergyNode(float3(sqrt(max(1.0 - a0 * a0, 0.0)), 0.0, a0), a1, (int)a2, (int)a3)",
              {cosine(0, 1), kRoughness, whole(0, kNodes - 1), whole(0, kNodes - 1)},
              {16, 16, 2e-8, "the half vector's sine is the root of 1 - cosine^2; the weight is pi / 1024"},
              [](In x) { return nodeSampled(x[0], x[1], x[2], x[3]); });
    cases.add("tgEnergyDirectionalAlbedo(a0, a1)", {cosine(0.05, 1), linear(0.1, 1)},
              {4, 0, 2e-3, "1024 midpoints; the horizon cuts some of their cells"}, {.samples = 512},
              [](In x) { return reference::directionalAlbedo(x[0], x[1], kF0) / std::numbers::pi; });
    cases.add("tgEnergyDirectionalAlbedo(a0, a1)", {cosine(1e-7, 1), linear(0.1, 1)},
              {4, 0, 2e-5, "1024 terms; where m is 0.1 N.H rounds at 1e-7 and PH changes by 200 times that"},
              {.settings = {0}, .samples = 512}, [](In x) { return reference::directionalAlbedoPrinted(x[0], x[1], kPrintedF0, kNodes); });
}

} // namespace

Cases specularCases() {
    return together(lobes, energies, widenedLobes);
}

} // namespace tegument::test
