// hlsl/fur/ribbons.fxh in double precision: digits by whole numbers, coverage by the overlap of two intervals, opacity by a walk from depth
// to depth, highlights by angles.
#include "tests/hlsl/function_case.h"

#include <numbers>

namespace tegument::test {

namespace {

/// A vertex's number, and what it was made of.
struct Digits {
    std::int64_t shortness, red, green, blue, row;

    explicit Digits(In x)
        : shortness(std::llround(x[0])), red(std::llround(x[1])), green(std::llround(x[2])), blue(std::llround(x[3])),
          row(std::llround(x[4])) {}
};

constexpr const char* kStored = "float stored = a0 + 16.0 * (a1 + 32.0 * (a2 + 32.0 * a3)) + a4 / 32.0; ";

/// Share of the pixel [-0.5, 0.5] around `distance` that lies within `half` of the axis.
double overlap(double distance, double half) {
    return saturate(min(distance + 0.5, half) - max(distance - 0.5, -half));
}

double opacity(const dvec4& sums, const dvec4& depths, double depth) {
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
double lobe(const dvec3& strand, const dvec3& halfway, double exponent) {
    const double angle = atan2(length(cross(strand, halfway)), dot(strand, halfway));
    return pow(max(abs(sin(angle)), 1e-3), exponent);
}

} // namespace

Cases furRibbonCases() {
    const Arguments digits = {whole(0, 15), whole(0, 31), whole(0, 31), whole(0, 31), whole(0, 31)};
    const Tolerance shares{4, 0, 0, "digits are exact; a quotient and a square"};
    Cases cases;
    cases.add({"tgRibbon", std::string(kStored) + "TgRibbon r = tgRibbon(stored); return float4(r.along, r.shortness, 0, 0);"}, digits,
              shares, [](In x) {
                  const Digits d(x);
                  return values(static_cast<double>(d.row) / 31, static_cast<double>(d.shortness) / 15);
              });
    cases.add({"tgRibbon", std::string(kStored) + "return float4(tgRibbon(stored).color, 0);"}, digits, shares, [](In x) {
        const Digits d(x);
        const auto square = [](std::int64_t v) { return static_cast<double>(v * v) / (31.0 * 31.0); };
        return values(square(d.red), square(d.green), square(d.blue));
    });
    cases.add("tgRibbonRank(a0)", {whole(4096, 16777215)}, {0, 0, 2e-3, "sums of up to 5,600, of which the fraction is left"}, [](In x) {
        const double address = round(x[0]);
        const double row = floor(address / 4096);
        const double sum = 0.6180340 * (address - 4096 * row) + 0.7548777 * row;
        return sum - floor(sum);
    });
    cases.back().domain = [](In x) {
        const double address = round(x[0]);
        const double row = floor(address / 4096);
        const double sum = 0.6180340 * (address - 4096 * row) + 0.7548777 * row;
        return abs(sum - round(sum)) > 2e-3; // where the fraction leaps
    };
    // what is drawn, times how much of it is covered, is the strand's own width
    cases.add("tgRibbonWidth(a0, a1)", {logarithmic(1e-4, 10), logarithmic(1e-3, 10)}, {4, 2, 0, "one quotient"}, [](In x) {
        const double half = max(x[0], x[1] / 2);
        return values(half, x[0] / half);
    });
    cases.back().domain = [](In x) { return x[0] > 0 && x[1] > 0; };
    cases.add("tgRibbonCoverage(float3(a0, a1, a2))", {linear(-4, 4), linear(0.5, 3), linear(0, 1)},
              {4, 4, 1e-6, "differences of numbers up to 4"}, [](In x) { return x[2] * overlap(x[0], x[1]); });
    cases.add({"tgFurOpacity", "float4 sums = float4(a0, a0 + a1.x, a0 + a1.x + a1.y, a0 + a1.x + a1.y + a1.z); return "
                               "float4(tgFurOpacity(sums, float4(0.25, 0.6, 1.2, 2.4), a2), 0, 0, 0);"},
              {linear(0, 2), linear(0, 2, 3), linear(-1, 4)}, {8, 4, 4e-6, "four products, sums of up to 8"}, [](In x) {
                  dvec4 sums(x[0]);
                  for (glm::length_t i = 1; i < 4; ++i)
                      sums[i] = sums[i - 1] + x.vec3(1)[i - 1];
                  return opacity(sums, {0.25, 0.6, 1.2, 2.4}, x[2]);
              });
    cases.add("tgFurHighlights(a0, a1, a2, a3, float2(-0.1, 0.2), float2(60, 14))", {unit(), unit(), unit(), unit()},
              {64, 8, 1e-5, "the 60th power of a sine, by its square"}, [](In x) {
                  const dvec3 halfway = x.vec3(2) + x.vec3(3);
                  return values(lobe(x.vec3(0) - 0.1 * x.vec3(1), halfway, 60), lobe(x.vec3(0) + 0.2 * x.vec3(1), halfway, 14));
              });
    cases.back().domain = [](In x) { return length(x.vec3(2) + x.vec3(3)) > 0.01; };
    return cases;
}

} // namespace tegument::test
