// hlsl/fur/ribbons.fxh in double precision: digits by whole numbers, coverage by the overlap of two intervals, opacity by a walk from depth
// to depth, highlights by angles.
#include "tests/hlsl/function_case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::test {

namespace {

/// A vertex's number, and what it was made of.
struct Digits {
    std::int64_t shortness, red, green, blue, row;

    explicit Digits(const Inputs& x)
        : shortness(std::llround(x.scalar(0))), red(std::llround(x.scalar(1))), green(std::llround(x.scalar(2))),
          blue(std::llround(x.scalar(3))), row(std::llround(x.scalar(4))) {}
};

constexpr const char* kStored = "float stored = a0 + 16.0 * (a1 + 32.0 * (a2 + 32.0 * a3)) + a4 / 32.0; ";

/// Share of the pixel [-0.5, 0.5] around `distance` that lies within `half` of the axis.
double overlap(double distance, double half) {
    return std::clamp(std::min(distance + 0.5, half) - std::max(distance - 0.5, -half), 0.0, 1.0);
}

double opacity(const glm::dvec4& sums, const glm::dvec4& depths, double depth) {
    double from = 0;
    double sum = 0;
    for (glm::length_t i = 0; i < 4; ++i) {
        if (depth <= depths[i]) return depth <= from ? sum : sum + (sums[i] - sum) * (depth - from) / (depths[i] - from);
        from = depths[i];
        sum = sums[i];
    }
    return sum;
}

/// Of the sine between two directions that need not be unit.
double lobe(const glm::dvec3& strand, const glm::dvec3& halfway, double exponent) {
    const double angle = std::atan2(glm::length(glm::cross(strand, halfway)), glm::dot(strand, halfway));
    return std::pow(std::max(std::abs(std::sin(angle)), 1e-3), exponent);
}

} // namespace

std::vector<FunctionCase> furRibbonCases() {
    const std::vector<Argument> digits = {whole(0, 15), whole(0, 31), whole(0, 31), whole(0, 31), whole(0, 31)};
    const Tolerance shares{.forward = 4, .backward = 0, .why = "digits are exact; a quotient and a square"};
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgRibbon",
                     .body = std::string(kStored) + "TgRibbon r = tgRibbon(stored); return float4(r.along, r.shortness, 0, 0);",
                     .arguments = digits,
                     .expected =
                         [](const Inputs& x) {
                             const Digits d(x);
                             return values(static_cast<double>(d.row) / 31, static_cast<double>(d.shortness) / 15);
                         },
                     .tolerance = shares});
    cases.push_back({.function = "tgRibbon",
                     .body = std::string(kStored) + "return float4(tgRibbon(stored).color, 0);",
                     .arguments = digits,
                     .expected =
                         [](const Inputs& x) {
                             const Digits d(x);
                             const auto square = [](std::int64_t v) { return static_cast<double>(v * v) / (31.0 * 31.0); };
                             return values(square(d.red), square(d.green), square(d.blue));
                         },
                     .tolerance = shares});
    cases.push_back(
        {.function = "tgRibbonRank",
         .body = "return float4(tgRibbonRank(a0), 0, 0, 0);",
         .arguments = {whole(4096, 16777215)},
         .expected =
             [](const Inputs& x) {
                 const double address = std::round(x.scalar(0));
                 const double row = std::floor(address / 4096);
                 const double sum = 0.6180340 * (address - 4096 * row) + 0.7548777 * row;
                 return values(sum - std::floor(sum));
             },
         .tolerance = {.forward = 0, .backward = 0, .absolute = 2e-3, .why = "sums of up to 5,600, of which the fraction is left"},
         .domain =
             [](const Inputs& x) {
                 const double address = std::round(x.scalar(0));
                 const double row = std::floor(address / 4096);
                 const double sum = 0.6180340 * (address - 4096 * row) + 0.7548777 * row;
                 return std::abs(sum - std::round(sum)) > 2e-3; // where the fraction leaps
             }});
    cases.push_back({.function = "tgRibbonWidth",
                     .body = "return float4(tgRibbonWidth(a0, a1), 0, 0);",
                     .arguments = {logarithmic(1e-4, 10), logarithmic(1e-3, 10)},
                     .expected =
                         [](const Inputs& x) { // what is drawn, times how much of it is covered, is the strand's own width
                             const double half = std::max(x.scalar(0), x.scalar(1) / 2);
                             return values(half, x.scalar(0) / half);
                         },
                     .tolerance = {.forward = 4, .backward = 2, .why = "one quotient"},
                     .domain = [](const Inputs& x) { return x.scalar(0) > 0 && x.scalar(1) > 0; }});
    cases.push_back({.function = "tgRibbonCoverage",
                     .body = "return float4(tgRibbonCoverage(float3(a0, a1, a2)), 0, 0, 0);",
                     .arguments = {linear(-4, 4), linear(0.5, 3), linear(0, 1)},
                     .expected = [](const Inputs& x) { return values(x.scalar(2) * overlap(x.scalar(0), x.scalar(1))); },
                     .tolerance = {.forward = 4, .backward = 4, .absolute = 1e-6, .why = "differences of numbers up to 4"}});
    cases.push_back({.function = "tgFurOpacity",
                     .body = "float4 sums = float4(a0, a0 + a1.x, a0 + a1.x + a1.y, a0 + a1.x + a1.y + a1.z); "
                             "return float4(tgFurOpacity(sums, float4(0.25, 0.6, 1.2, 2.4), a2), 0, 0, 0);",
                     .arguments = {linear(0, 2), linear(0, 2, 3), linear(-1, 4)},
                     .expected =
                         [](const Inputs& x) {
                             glm::dvec4 sums(x.scalar(0));
                             for (glm::length_t i = 1; i < 4; ++i)
                                 sums[i] = sums[i - 1] + x.vec3(1)[i - 1];
                             return values(opacity(sums, {0.25, 0.6, 1.2, 2.4}, x.scalar(2)));
                         },
                     .tolerance = {.forward = 8, .backward = 4, .absolute = 4e-6, .why = "four products, sums of up to 8"}});
    cases.push_back({.function = "tgFurHighlights",
                     .body = "return float4(tgFurHighlights(a0, a1, a2, a3, float2(-0.1, 0.2), float2(60, 14)), 0, 0);",
                     .arguments = {unit(), unit(), unit(), unit()},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec3 halfway = x.vec3(2) + x.vec3(3);
                             return values(lobe(x.vec3(0) - 0.1 * x.vec3(1), halfway, 60), lobe(x.vec3(0) + 0.2 * x.vec3(1), halfway, 14));
                         },
                     .tolerance = {.forward = 64, .backward = 8, .absolute = 1e-5, .why = "the 60th power of a sine, by its square"},
                     .domain = [](const Inputs& x) { return glm::length(x.vec3(2) + x.vec3(3)) > 0.01; }});
    return cases;
}

} // namespace tegument::test
