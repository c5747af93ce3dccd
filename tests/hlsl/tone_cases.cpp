// hlsl/scatter/tone.fxh against photons: skin of so much melanin and blood, of which the numbers there know nothing but by photons of
// other seeds.

#include "lab/reference/skin_tone.h"
#include "tests/hlsl/function_case.h"

#include <algorithm>

namespace tegument::test {

namespace {

constexpr int kSkins = 24;

/// Of the same photons for all skins; those of one skin, rounded to six digits, are weighed once.
const reference::ToneResponse& skin(In x) {
    static const reference::WhitePhotons kPhotons(8'000, 5);
    static std::map<std::pair<long, long>, reference::ToneResponse> known;
    const auto step = [](double value, const std::array<double, 2>& range) {
        return std::lround(1e6 * log(std::clamp(value, range[0], range[1])));
    };
    const auto [found, made] = known.try_emplace({step(x[0], reference::kToneMelanin), step(x[1], reference::kToneBlood)});
    if (made)
        found->second = kPhotons.response(
            reference::toneOf(exp(1e-6 * static_cast<double>(found->first.first)), exp(1e-6 * static_cast<double>(found->first.second))));
    return found->second;
}

} // namespace

Cases toneCases() {
    Cases cases;
    // Light on half a plane, a2 mm from its edge; erf by Abramowitz and Stegun 1964, 7.1.26.
    cases.add({"tgToneWeight", "float3 sum = 0.0, lit = 0.0; [unroll] for (int i = 0; i < 6; i++) { float3 w = tgToneWeight(i, a0, a1); "
                               "sum += w; float x = a2 / sqrt(2.0 * kTgToneVariance[i]); float t = 1.0 / (1.0 + 0.3275911 * x); float e = "
                               "((((1.061405429 * t - 1.453152027) * t + 1.421413741) * t - 0.284496736) * t + 0.254829592) * t * exp(-x * "
                               "x); lit += w * (1.0 - 0.5 * e); } return float4(lit / sum, 1.0);"},
              {logarithmic(0.004, 0.1), logarithmic(0.002, 0.05), logarithmic(0.02, 10)},
              {4, 2, 0.025, "blue within .0134, others .005, of many photons; of 8,000 another .01"}, {.samples = kSkins}, [](In x) {
                  const reference::ToneResponse& truth = skin(x);
                  const auto lit = [&](std::size_t c) { return reference::halfPlane(truth.rings.at(c), x[2]); };
                  return values(lit(0), lit(1), lit(2), 1);
              });
    cases.back().domain = [](In x) { return x[0] > 0 && x[0] <= 0.1 && x[1] > 0 && x[2] >= 0.02 && x[2] <= 10; };
    cases.add({"tgToneAlbedo",
               "float3 sum = 0.0; [unroll] for (int i = 0; i < 6; i++) sum += tgToneWeight(i, a0, a1); float3 albedo = tgToneAlbedo(a0, "
               "a1); float3 apart = abs(albedo - sum); return float4(albedo, max(apart.x, max(apart.y, apart.z)));"},
              {logarithmic(0.004, 0.32), logarithmic(0.002, 0.05)}, {4, 2, 0.012, "2 % of what light skin gives back, 8,000 photons"},
              {.samples = kSkins}, [](In x) {
                  const dvec3 albedo = skin(x).albedo;
                  return values(albedo.x, albedo.y, albedo.z, 0);
              });
    cases.back().domain = [](In x) { return x[0] > 0 && x[1] > 0; };
    cases.add({"tgTonePlace",
               "TgTonePlace p = tgTonePlace(a0, a1); return float4(dot(p.melanin0, 1.0) + dot(p.melanin3, 1.0), dot(p.blood, 1.0), "
               "dot(p.melanin0, float3(0, 0.2, 0.4)) + dot(p.melanin3, float3(0.6, 0.8, 1)), dot(p.blood, float4(0, 1, 2, 3)) / 3);"},
              {logarithmic(0.001, 1), logarithmic(0.0005, 0.2)}, {4, 2, 4e-6, "sums of products of numbers up to 1, after logarithms"},
              [](In x) {
                  const auto place = [](double value, const std::array<double, 2>& range) {
                      return saturate(log(max(value, 1e-6) / range[0]) / log(range[1] / range[0]));
                  };
                  return values(1, 1, place(x[0], reference::kToneMelanin), place(x[1], reference::kToneBlood));
              });
    cases.add({"tgToneFlesh", "return float4(tgToneFlesh(a0), 1.0);"}, {logarithmic(0.001, 0.1)},
              {4, 2, 1e-4, "coefficients are printed with five decimals"}, [](In x) {
                  const double blood = std::clamp(x[0], reference::kToneBlood[0], reference::kToneBlood[1]);
                  const dvec3 factor = reference::fleshFactor({.blood = blood});
                  return values(factor.x, factor.y, factor.z, 1);
              });
    cases.back().domain = [](In x) { return x[0] > 0; };
    return cases;
}

} // namespace tegument::test
