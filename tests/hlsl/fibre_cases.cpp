// hlsl/fur/fibre.fxh and the light of effects/passes/fur_fibre_light.fxh in double precision: a fibre by the near-field BCSDF of the path
// tracer (lab/reference/fibre_paths.h), averaged over its width; light scattered many times by the differential equations of two streams.

#include "lab/reference/fibre_paths.h"
#include "tests/hlsl/lock_scene.h"
#include "tests/hlsl/maps.h"

#include <cstdint>
#include <numbers>

namespace tegument::test {

namespace {

constexpr double kPi = std::numbers::pi;

FunctionCase function(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    return check(std::move(call), std::move(arguments), std::move(tolerance), {.samples = 1024}, std::move(expected));
}

/// Of unpolarised light, by the angles of incidence and refraction (Fresnel's own form).
double fresnelOf(double cosine) {
    const double in = acos(cosine);
    const double out = asin(sin(in) / 1.55);
    if (in < 1e-3) return pow(0.55 / 2.55, 2);
    const double s = sin(in - out) / sin(in + out);
    const double p = tan(in - out) / tan(in + out);
    return (s * s + p * p) / 2;
}

/// Mean of a wrapped logistic over `wide` around x, by the midpoint rule over its density.
double azimuthMean(double x, double wide) {
    constexpr int kSteps = 2000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int turn = -3; turn <= 3; ++turn) {
            const double at = (x + wide * ((i + 0.5) / kSteps - 0.5) + 2 * kPi * turn) / 0.1172;
            sum += 1 / (4 * 0.1172 * pow(cosh(at / 2), 2)) / kSteps;
        }
    return sum;
}

/// Averaged over the width of a fibre: what one sends to the eye of light from this azimuth, both across it.
dvec3 acrossFibre(double azimuth, const dvec3& absorption) {
    constexpr int kOffsets = 400;
    dvec3 sum(0);
    for (int i = 0; i < kOffsets; ++i) {
        const reference::FibreScattering fibre({}, absorption, {0, 1, 0}, -1 + 2 * (i + 0.5) / kOffsets);
        sum += fibre.evaluate({0, cos(azimuth), sin(azimuth)}) / static_cast<double>(kOffsets);
    }
    return sum;
}

void oneFibre(Cases& cases) {
    cases += function("tgFibreAbsorption(a0)", {linear(0.002, 0.998, 3)},
                      {128, 4, 1e-7, "a constant of five digits; a logarithm near 1, squared"},
                      [](In x) { return reference::fibreAbsorption(x.vec3(0), 0.3); });
    cases +=
        function("tgFibreFresnel(a0)", {linear(0.01, 1)}, {16, 8, 2e-6, "differences of cosines"}, [](In x) { return fresnelOf(x[0]); });
    cases += function("tgFibreSigmoid(a0)", {linear(-2, 2, 3)}, {16, 4, 1e-6, "an exponential of up to 17"},
                      [](In x) { return 0.5 + 0.5 * glm::tanh(x.vec3(0) / (2 * 0.1172)); });
    cases +=
        function("tgFibreAzimuth(a0, a1)", {linear(-9, 9, 3), linear(0.02, 3.14)},
                 {16, 4, 2e-4, "differences of 1e-7 by 0.02; the mean by 2000 steps"}, [](In x) {
                     const double wide = x[1];
                     return values(azimuthMean(x.scalar(0, 0), wide), azimuthMean(x.scalar(0, 1), wide), azimuthMean(x.scalar(0, 2), wide));
                 });
    cases.back().samples = 128;
    // Of a fibre across which light and eye stand all of the table shows, times the three lobes along it.
    cases += function({"tgFibreTable", "TgFibreTable t = tgFibreTable(a0, 1.0, 0.02); float3 m = tgFibreAlong(0.0, 1.0, 0.0, 1.0, "
                                       "kTgFibreVariance); return float4(tgFibreScattered(t.bright, t.path, m, a1), 0);"},
                      {linear(0.02, 3.12), linear(0, 0.3, 3)},
                      {64, 4, 1.2e-2, "mean ways instead of a mean of exponentials; all beyond TRT with its lobe along"},
                      [](In x) { return acrossFibre(x[0], x.vec3(1)); });
    cases.back().samples = 64;
    cases += function("tgFibreScattered(a0, a1, a2, a3)", {linear(0, 1, 3), linear(0, 6, 2), linear(0, 3, 3), linear(0, 2, 3)},
                      {16, 4, 1e-6, "two exponentials"}, [](In x) {
                          dvec3 sum(x[0] * x[2]);
                          for (std::size_t p = 1; p < 3; ++p)
                              sum += x.scalar(0, p) * x.scalar(2, p) * exp(-x.vec3(3) * x.scalar(1, p - 1));
                          return sum;
                      });
    // Its lobes apart: a narrow one by its own formula in double precision, with the Bessel function of the standard library.
    cases += function("tgFibreAlong(sin(a0), cos(a0), sin(a1), cos(a1), kTgFibreVariance)", {linear(-1.5, 1.5), linear(-1.5, 1.5)},
                      {110000, 16, 1e-4, "an approximation of I0 to six thousandths"}, [](In x) {
                          const double tilts[3] = {-4, 2, 8}, v[3] = {0.0846, 0.02115, 0.3384};
                          dvec3 m;
                          for (int p = 0; p < 3; ++p) {
                              const double eye = x[1] + radians(tilts[p]);
                              const double cosines = cos(x[0]) * abs(cos(eye));
                              const double sines = sin(x[0]) * sin(eye);
                              m[p] = exp(-sines / v[p] - 1 / v[p]) * std::cyl_bessel_i(0, cosines / v[p]) / (v[p] * (1 - exp(-2 / v[p])));
                          }
                          return m;
                      });
}

/// Two streams of a half space whose single scattering w is isotropic, lit by a beam that enters at the cosine mu:
/// mean'' = 4 (1 - w) mean - w exp(-depth / mu), up = mean' / 2; nothing comes down at the top, nothing grows below.
struct Streams {
    dvec3 mean, up;
};
Streams streamsAt(const dvec3& colour, const dvec3& depth, double mu) {
    Streams s{};
    for (int c = 0; c < 3; ++c) {
        const double rate = 2 * (1 - colour[c]) / (1 + colour[c]);
        const double w = 1 - rate * rate / 4;
        const double beam = w / (rate * rate - 1 / (mu * mu));
        const double free = -beam * (1 + 1 / (2 * mu)) / (1 + rate / 2);
        const double falling = free * exp(-rate * depth[c]), lit = beam * exp(-depth[c] / mu);
        s.mean[c] = falling + lit;
        s.up[c] = -(rate * falling + lit / mu) / 2;
    }
    return s;
}

void manyFibres(Cases& cases) {
    const Arguments arguments = {linear(0.02, 0.98, 3), linear(0, 5, 3), linear(0.03, 1)};
    const auto regular = [](In x) {
        bool far = true;
        for (std::size_t c = 0; c < 3; ++c)
            far = far && abs(2 * (1 - x.scalar(0, c)) / (1 + x.scalar(0, c)) * x[2] - 1) > 0.03;
        return far;
    };
    const Tolerance streams{64, 16, 1e-4, "a difference of two exponentials over 0.03 of their size"};
    cases += function("tgFibreField(a0, a1, a2).mean", arguments, streams, [](In x) { return streamsAt(x.vec3(0), x.vec3(1), x[2]).mean; });
    cases.back().domain = regular;
    cases += function("tgFibreField(a0, a1, a2).up", arguments, streams, [](In x) { return streamsAt(x.vec3(0), x.vec3(1), x[2]).up; });
    cases.back().domain = regular;
    // What comes out of the top of a half space: the colour where it is lit from all sides, Hapke's reflectance of a beam.
    cases += function({"tgFibreField", "TgFibreField f = tgFibreField(a0, 0.0, a1); return float4((f.mean + f.up) / a1, 0);"},
                      {linear(0.02, 0.98, 3), linear(0.03, 1)}, {64, 16, 1.5e-2, "near 2 dark mu = 1 it is that beside it"}, [](In x) {
                          const dvec3 dark = (1.0 - x.vec3(0)) / (1.0 + x.vec3(0));
                          return (1.0 - dark) / (1.0 + 2.0 * dark * x[1]);
                      });
    // less comes up with depth than the colour's share of what goes down
    cases += function({"tgFibreFieldAround", "TgFibreField f = tgFibreFieldAround(a0, a1); return float4(f.mean + f.up, 0);"},
                      {linear(0.02, 0.98, 3), linear(0, 5, 3)}, {32, 8, 1e-6, "an exponential"}, [](In x) {
                          const dvec3 dark = (1.0 - x.vec3(0)) / (1.0 + x.vec3(0));
                          return x.vec3(0) * exp(-2.0 * dark * x.vec3(1));
                      });
    cases += function({"tgFibreAlbedo", "return float4(tgFibreDepth(tgFibreAlbedo(a0)), 0);"}, {linear(0, 1, 3)},
                      {8, 4, 1e-6, "an exponential"}, [](In x) { return 1.0 - 0.615 * exp(-1.9 * x.vec3(0)); });
    cases += function("tgFibreDepth(a0)", {linear(0, 1, 3)}, {4, 2, 0, "a sum"}, [](In x) { return 1.0 - 0.615 * x.vec3(0); });
    // what both ways have in common lies within the mean of exp(-apart t) over them
    cases += function("tgFibreStraight(a0, a1, a2)", {linear(0, 6), linear(0, 6), linear(0, 50)},
                      {32, 8, 2e-3, "a mean of 2000 steps; 1 below apart = 1e-3"}, [](In x) {
                          constexpr int kSteps = 2000;
                          double together = 0;
                          for (int i = 0; i < kSteps; ++i)
                              together += exp(-x[2] * (i + 0.5) / kSteps) / kSteps;
                          const double common = sqrt(x[0] * x[1]) * together;
                          return exp(-max(x[0] - common, 0.0));
                      });
}

FunctionCase furCoatCase(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    FunctionCase made = passCase("FurCoat.fx", with(kLockScene, kFurView), std::move(call), std::move(arguments), std::move(tolerance),
                                 std::move(expected));
    made.globals["gCoatHotSpot"] = {45};
    for (const char* map : {"gCoatSkinMap", "gCoatFrontMap", "gCoatOpacityMap", "gShadowMap", "gFurRootsMap"})
        made.maps[map] = oneTexel(0);
    return made;
}

/// Of four samples as many as the coverage says, one more with the chance that is left, whichever is first.
FunctionCase samples() {
    return furCoatCase({"chanceSamples", "float4 s = chanceSamples(a0, a1, (uint)a2); return float4(dot(s, 1.0), s.x, 0, 0);"},
                       {linear(0.0021, 1), linear(0.01, 0.99), whole(0, 7)}, {1, 0, 0, "whole numbers"}, [](In x) {
                           double sum = 0, first = 0;
                           for (int i = 0; i < 4; ++i) {
                               const double stratum = fmod(i + round(x[2]), 4.0);
                               const double covered = x[0] >= max((stratum + x[1]) / 4, 0.002) ? 1 : 0;
                               sum += covered;
                               if (i == 0) first = covered;
                           }
                           return values(sum, first);
                       });
}

/// pcg3d of whole numbers, and of it the 24 bits that a chance has: the same to the last one.
FunctionCase chances(const char* name) {
    return furCoatCase(
        {name, "uint3 h = chanceHash(uint3((uint)a0, (uint)a1, (uint)a2)); return float4(chanceOf(h.x), chanceOf(h.y), chanceOf(h.z), 0);"},
        {whole(0, 4'000'000), whole(0, 4'000'000), whole(0, 4'000'000)}, {0, 0, 0, "whole numbers below 2^24"}, [](In x) {
            std::array<std::uint32_t, 3> v{};
            for (std::size_t i = 0; i < 3; ++i)
                v[i] = static_cast<std::uint32_t>(std::llround(x[i])) * 1664525U + 1013904223U;
            const auto mix = [&] {
                for (std::size_t i = 0; i < 3; ++i)
                    v[i] += v[(i + 1) % 3] * v[(i + 2) % 3];
            };
            mix();
            for (std::uint32_t& each : v)
                each ^= each >> 16U;
            mix();
            return dvec3(v[0] >> 8U, v[1] >> 8U, v[2] >> 8U) / 16777216.0;
        });
}

} // namespace

Cases fibreCases() {
    FunctionCase sampled = samples();
    sampled.domain = [](In x) { // where no stratum's edge leaps
        const double edge = 4 * x[0] - x[1];
        return abs(edge - round(edge)) > 1e-4;
    };
    return together(oneFibre, manyFibres, sampled, chances("chanceHash"), chances("chanceOf"));
}

} // namespace tegument::test
