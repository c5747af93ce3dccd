// hlsl/fur/fibre.fxh and the light of effects/passes/fur_fibre_light.fxh in double precision: a fibre by the near-field BCSDF of the path
// tracer (lab/reference/fibre_paths.h), averaged over its width; light scattered many times by the differential equations of two streams.

#include "lab/reference/fibre_paths.h"
#include "tests/hlsl/lock_scene.h"
#include "tests/hlsl/maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace tegument::test {

namespace {

constexpr double kPi = std::numbers::pi;

FunctionCase function(const char* name, std::string body, std::vector<Argument> arguments, std::function<Values(const Inputs&)> expected,
                      Tolerance tolerance) {
    return {.function = name,
            .body = std::move(body),
            .arguments = std::move(arguments),
            .expected = std::move(expected),
            .tolerance = std::move(tolerance),
            .samples = 1024};
}

/// Of unpolarised light, by the angles of incidence and refraction (Fresnel's own form).
double fresnelOf(double cosine) {
    const double in = std::acos(cosine);
    const double out = std::asin(std::sin(in) / 1.55);
    if (in < 1e-3) return std::pow(0.55 / 2.55, 2);
    const double s = std::sin(in - out) / std::sin(in + out);
    const double p = std::tan(in - out) / std::tan(in + out);
    return (s * s + p * p) / 2;
}

/// Mean of a wrapped logistic over `wide` around x, by the midpoint rule over its density.
double azimuthMean(double x, double wide) {
    constexpr int kSteps = 2000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int turn = -3; turn <= 3; ++turn) {
            const double at = (x + wide * ((i + 0.5) / kSteps - 0.5) + 2 * kPi * turn) / 0.1172;
            sum += 1 / (4 * 0.1172 * std::pow(std::cosh(at / 2), 2)) / kSteps;
        }
    return sum;
}

/// Averaged over the width of a fibre: what one sends to the eye of light from this azimuth, both across it.
glm::dvec3 acrossFibre(double azimuth, const glm::dvec3& absorption) {
    constexpr int kOffsets = 400;
    glm::dvec3 sum(0);
    for (int i = 0; i < kOffsets; ++i) {
        const reference::FibreScattering fibre({}, absorption, {0, 1, 0}, -1 + 2 * (i + 0.5) / kOffsets);
        sum += fibre.evaluate({0, std::cos(azimuth), std::sin(azimuth)}) / static_cast<double>(kOffsets);
    }
    return sum;
}

std::vector<FunctionCase> oneFibre() {
    std::vector<FunctionCase> cases;
    cases.push_back(
        function("tgFibreAbsorption", "return float4(tgFibreAbsorption(a0), 0);", {linear(0.002, 0.998, 3)},
                 [](const Inputs& x) { return values(reference::fibreAbsorption(x.vec3(0), 0.3)); },
                 {.forward = 128, .backward = 4, .absolute = 1e-7, .why = "a constant of five digits; a logarithm near 1, squared"}));
    cases.push_back(function("tgFibreFresnel", "return float4(tgFibreFresnel(a0), 0, 0, 0);", {linear(0.01, 1)},
                             [](const Inputs& x) { return values(fresnelOf(x.scalar(0))); },
                             {.forward = 16, .backward = 8, .absolute = 2e-6, .why = "differences of cosines"}));
    cases.push_back(function("tgFibreSigmoid", "return float4(tgFibreSigmoid(a0), 0);", {linear(-2, 2, 3)},
                             [](const Inputs& x) { return values(0.5 + 0.5 * glm::tanh(x.vec3(0) / (2 * 0.1172))); },
                             {.forward = 16, .backward = 4, .absolute = 1e-6, .why = "an exponential of up to 17"}));
    cases.push_back(
        function("tgFibreAzimuth", "return float4(tgFibreAzimuth(a0, a1), 0);", {linear(-9, 9, 3), linear(0.02, 3.14)},
                 [](const Inputs& x) {
                     const double wide = x.scalar(1);
                     return values(azimuthMean(x.scalar(0, 0), wide), azimuthMean(x.scalar(0, 1), wide), azimuthMean(x.scalar(0, 2), wide));
                 },
                 {.forward = 16, .backward = 4, .absolute = 2e-4, .why = "differences of 1e-7 by 0.02; the mean by 2000 steps"}));
    cases.back().samples = 128;
    // Of a fibre across which light and eye stand all of the table shows, times the three lobes along it.
    cases.push_back(function("tgFibreTable",
                             "TgFibreTable t = tgFibreTable(a0, 1.0, 0.02); float3 m = tgFibreAlong(0.0, 1.0, 0.0, 1.0, kTgFibreVariance); "
                             "return float4(tgFibreScattered(t.bright, t.path, m, a1), 0);",
                             {linear(0.02, 3.12), linear(0, 0.3, 3)},
                             [](const Inputs& x) { return values(acrossFibre(x.scalar(0), x.vec3(1))); },
                             {.forward = 64,
                              .backward = 4,
                              .absolute = 1.2e-2,
                              .why = "mean ways instead of a mean of exponentials; all beyond TRT with its lobe along"}));
    cases.back().samples = 64;
    cases.push_back(function("tgFibreScattered", "return float4(tgFibreScattered(a0, a1, a2, a3), 0);",
                             {linear(0, 1, 3), linear(0, 6, 2), linear(0, 3, 3), linear(0, 2, 3)},
                             [](const Inputs& x) {
                                 glm::dvec3 sum(x.scalar(0) * x.scalar(2));
                                 for (std::size_t p = 1; p < 3; ++p)
                                     sum += x.scalar(0, p) * x.scalar(2, p) * glm::exp(-x.vec3(3) * x.scalar(1, p - 1));
                                 return values(sum);
                             },
                             {.forward = 16, .backward = 4, .absolute = 1e-6, .why = "two exponentials"}));
    // Its lobes apart: a narrow one by its own formula in double precision, with the Bessel function of the standard library.
    cases.push_back(function("tgFibreAlong", "return float4(tgFibreAlong(sin(a0), cos(a0), sin(a1), cos(a1), kTgFibreVariance), 0);",
                             {linear(-1.5, 1.5), linear(-1.5, 1.5)},
                             [](const Inputs& x) {
                                 const double tilts[3] = {-4, 2, 8}, v[3] = {0.0846, 0.02115, 0.3384};
                                 glm::dvec3 m;
                                 for (int p = 0; p < 3; ++p) {
                                     const double eye = x.scalar(1) + glm::radians(tilts[p]);
                                     const double cosines = std::cos(x.scalar(0)) * std::abs(std::cos(eye));
                                     const double sines = std::sin(x.scalar(0)) * std::sin(eye);
                                     m[p] = std::exp(-sines / v[p] - 1 / v[p]) * std::cyl_bessel_i(0, cosines / v[p]) /
                                            (v[p] * (1 - std::exp(-2 / v[p])));
                                 }
                                 return values(m);
                             },
                             {.forward = 110000, .backward = 16, .absolute = 1e-4, .why = "an approximation of I0 to six thousandths"}));
    return cases;
}

/// Two streams of a half space whose single scattering w is isotropic, lit by a beam that enters at the cosine mu:
/// mean'' = 4 (1 - w) mean - w exp(-depth / mu), up = mean' / 2; nothing comes down at the top, nothing grows below.
struct Streams {
    glm::dvec3 mean, up;
};
Streams streamsAt(const glm::dvec3& colour, const glm::dvec3& depth, double mu) {
    Streams s{};
    for (int c = 0; c < 3; ++c) {
        const double rate = 2 * (1 - colour[c]) / (1 + colour[c]);
        const double w = 1 - rate * rate / 4;
        const double beam = w / (rate * rate - 1 / (mu * mu));
        const double free = -beam * (1 + 1 / (2 * mu)) / (1 + rate / 2);
        const double falling = free * std::exp(-rate * depth[c]), lit = beam * std::exp(-depth[c] / mu);
        s.mean[c] = falling + lit;
        s.up[c] = -(rate * falling + lit / mu) / 2;
    }
    return s;
}

std::vector<FunctionCase> manyFibres() {
    std::vector<FunctionCase> cases;
    const std::vector<Argument> arguments = {linear(0.02, 0.98, 3), linear(0, 5, 3), linear(0.03, 1)};
    const auto regular = [](const Inputs& x) {
        bool far = true;
        for (std::size_t c = 0; c < 3; ++c)
            far = far && std::abs(2 * (1 - x.scalar(0, c)) / (1 + x.scalar(0, c)) * x.scalar(2) - 1) > 0.03;
        return far;
    };
    const Tolerance streams{
        .forward = 64, .backward = 16, .absolute = 1e-4, .why = "a difference of two exponentials over 0.03 of their size"};
    cases.push_back(function(
        "tgFibreField", "return float4(tgFibreField(a0, a1, a2).mean, 0);", arguments,
        [](const Inputs& x) { return values(streamsAt(x.vec3(0), x.vec3(1), x.scalar(2)).mean); }, streams));
    cases.back().domain = regular;
    cases.push_back(function(
        "tgFibreField", "return float4(tgFibreField(a0, a1, a2).up, 0);", arguments,
        [](const Inputs& x) { return values(streamsAt(x.vec3(0), x.vec3(1), x.scalar(2)).up); }, streams));
    cases.back().domain = regular;
    // What comes out of the top of a half space: the colour where it is lit from all sides, Hapke's reflectance of a beam.
    cases.push_back(function("tgFibreField", "TgFibreField f = tgFibreField(a0, 0.0, a1); return float4((f.mean + f.up) / a1, 0);",
                             {linear(0.02, 0.98, 3), linear(0.03, 1)},
                             [](const Inputs& x) {
                                 const glm::dvec3 dark = (1.0 - x.vec3(0)) / (1.0 + x.vec3(0));
                                 return values((1.0 - dark) / (1.0 + 2.0 * dark * x.scalar(1)));
                             },
                             {.forward = 64, .backward = 16, .absolute = 1.5e-2, .why = "near 2 dark mu = 1 it is that beside it"}));
    cases.push_back(function("tgFibreFieldAround", "TgFibreField f = tgFibreFieldAround(a0, a1); return float4(f.mean + f.up, 0);",
                             {linear(0.02, 0.98, 3), linear(0, 5, 3)},
                             [](const Inputs& x) { // less comes up with depth than the colour's share of what goes down
                                 const glm::dvec3 dark = (1.0 - x.vec3(0)) / (1.0 + x.vec3(0));
                                 return values(x.vec3(0) * glm::exp(-2.0 * dark * x.vec3(1)));
                             },
                             {.forward = 32, .backward = 8, .absolute = 1e-6, .why = "an exponential"}));
    cases.push_back(function("tgFibreAlbedo", "return float4(tgFibreDepth(tgFibreAlbedo(a0)), 0);", {linear(0, 1, 3)},
                             [](const Inputs& x) { return values(1.0 - 0.615 * glm::exp(-1.9 * x.vec3(0))); },
                             {.forward = 8, .backward = 4, .absolute = 1e-6, .why = "an exponential"}));
    cases.push_back(function("tgFibreDepth", "return float4(tgFibreDepth(a0), 0);", {linear(0, 1, 3)},
                             [](const Inputs& x) { return values(1.0 - 0.615 * x.vec3(0)); },
                             {.forward = 4, .backward = 2, .why = "a sum"}));
    cases.push_back(function("tgFibreStraight", "return float4(tgFibreStraight(a0, a1, a2), 0, 0, 0);",
                             {linear(0, 6), linear(0, 6), linear(0, 50)},
                             [](const Inputs& x) { // what both ways have in common lies within the mean of exp(-apart t) over them
                                 constexpr int kSteps = 2000;
                                 double together = 0;
                                 for (int i = 0; i < kSteps; ++i)
                                     together += std::exp(-x.scalar(2) * (i + 0.5) / kSteps) / kSteps;
                                 const double common = std::sqrt(x.scalar(0) * x.scalar(1)) * together;
                                 return values(std::exp(-std::max(x.scalar(0) - common, 0.0)));
                             },
                             {.forward = 32, .backward = 8, .absolute = 2e-3, .why = "a mean of 2000 steps; 1 below apart = 1e-3"}));
    return cases;
}

FunctionCase furCoatCase(const char* name, std::string body, std::vector<Argument> arguments, std::function<Values(const Inputs&)> expected,
                         Tolerance tolerance) {
    FunctionCase made = passCase("FurCoat.fx", with(kLockScene, kFurView), name, std::move(body), std::move(arguments), std::move(expected),
                                 std::move(tolerance));
    made.globals["gCoatHotSpot"] = {45};
    for (const char* map : {"gCoatSkinMap", "gCoatFrontMap", "gCoatOpacityMap", "gShadowMap", "gFurRootsMap"})
        made.maps[map] = oneTexel(0);
    return made;
}

/// Of four samples as many as the coverage says, one more with the chance that is left, whichever is first.
FunctionCase samples() {
    return furCoatCase("chanceSamples", "float4 s = chanceSamples(a0, a1, (uint)a2); return float4(dot(s, 1.0), s.x, 0, 0);",
                       {linear(0.0021, 1), linear(0.01, 0.99), whole(0, 7)},
                       [](const Inputs& x) {
                           double sum = 0, first = 0;
                           for (int i = 0; i < 4; ++i) {
                               const double stratum = std::fmod(i + std::round(x.scalar(2)), 4.0);
                               const double covered = x.scalar(0) >= std::max((stratum + x.scalar(1)) / 4, 0.002) ? 1 : 0;
                               sum += covered;
                               if (i == 0) first = covered;
                           }
                           return values(sum, first);
                       },
                       {.forward = 1, .backward = 0, .why = "whole numbers"});
}

/// pcg3d of whole numbers, and of it the 24 bits that a chance has: the same to the last one.
FunctionCase chances(const char* name) {
    return furCoatCase(
        name, "uint3 h = chanceHash(uint3((uint)a0, (uint)a1, (uint)a2)); return float4(chanceOf(h.x), chanceOf(h.y), chanceOf(h.z), 0);",
        {whole(0, 4'000'000), whole(0, 4'000'000), whole(0, 4'000'000)},
        [](const Inputs& x) {
            std::array<std::uint32_t, 3> v{};
            for (std::size_t i = 0; i < 3; ++i)
                v[i] = static_cast<std::uint32_t>(std::llround(x.scalar(i))) * 1664525U + 1013904223U;
            const auto mix = [&] {
                for (std::size_t i = 0; i < 3; ++i)
                    v[i] += v[(i + 1) % 3] * v[(i + 2) % 3];
            };
            mix();
            for (std::uint32_t& each : v)
                each ^= each >> 16U;
            mix();
            return values(glm::dvec3(v[0] >> 8U, v[1] >> 8U, v[2] >> 8U) / 16777216.0);
        },
        {.forward = 0, .backward = 0, .why = "whole numbers below 2^24"});
}

} // namespace

std::vector<FunctionCase> fibreCases() {
    FunctionCase sampled = samples();
    sampled.domain = [](const Inputs& x) { // where no stratum's edge leaps
        const double edge = 4 * x.scalar(0) - x.scalar(1);
        return std::abs(edge - std::round(edge)) > 1e-4;
    };
    return together(oneFibre(), manyFibres(), sampled, chances("chanceHash"), chances("chanceOf"));
}

} // namespace tegument::test
