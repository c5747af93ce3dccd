// hlsl/scatter/gaussian.fxh against the definitions of docs/design/modules/Convolution.md.

#include "tests/hlsl/maps.h"

#include <algorithm>

namespace tegument::test {

namespace {

constexpr double kKernel[7] = {.006, .061, .242, .383, .242, .061, .006};
constexpr double kSum = 1.001;
constexpr double kTexel = 1.0 / 12;
const dvec4 kInvalid{0, 0, 0, 1};

bool valid(const dvec4& texel) {
    return texel.w < 0.995;
}

double increment(In x, double before, double after, double present) {
    if (x.seed()) return after;
    return x.corrected() ? max(after, present) - max(before, present) : max(after - before, 0.0);
}

/// Variance of taps `spacing` apart that are interpolated between texels: each lies on its two neighbours in shares.
double varianceOf(double spacing) {
    double sum = 0;
    for (int j = -3; j <= 3; ++j) {
        const double place = j * spacing;
        const double left = floor(place);
        const double f = place - left;
        sum += kKernel[j + 3] * ((1 - f) * left * left + f * (left + 1) * (left + 1));
    }
    return sum / kSum;
}

double spacingFor(double variance) {
    double low = 0;
    double high = sqrt(variance) + 1;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (varianceOf(middle) < variance ? low : high) = middle;
    }
    return high;
}

/// Texel (x, y) of the map, moved along U (a2 < 0.5) or V.
struct Line {
    int x, y;
    bool alongU;

    explicit Line(In in) : x(static_cast<int>(in[0])), y(static_cast<int>(in[1])), alongU(in[2] < 0.5) {}

    [[nodiscard]] dvec4 at(double steps) const {
        const int n = static_cast<int>(steps);
        return alongU ? irradianceMap().texel(x + n, y) : irradianceMap().texel(x, y + n);
    }
};

struct Sum {
    dvec4 value{0};
    double weight = 0;

    void add(double share, const dvec4& texel) {
        if (!valid(texel)) return;
        value += share * texel;
        weight += share;
    }
};

Sum tap(const Line& line, double offset) {
    const double left = floor(offset);
    Sum sum;
    sum.add(1 - (offset - left), line.at(left));
    sum.add(offset - left, line.at(left + 1));
    return sum;
}

dvec4 overValid(const Line& line, double spacing) {
    Sum all;
    for (int j = -3; j <= 3; ++j) {
        const Sum one = tap(line, j * spacing);
        all.value += kKernel[j + 3] * one.value;
        all.weight += kKernel[j + 3] * one.weight;
    }
    return all.weight > 1e-4 ? all.value / all.weight : kInvalid;
}

/// The interpolated texel; where one of the two is invalid, the other.
dvec4 asTexel(const Line& line, double offset) {
    const double left = floor(offset);
    const double f = offset - left;
    const dvec4 a = line.at(left);
    const dvec4 b = line.at(left + 1);
    if (f == 0 || !valid(b)) return a;
    return valid(a) ? (1 - f) * a + f * b : b;
}

/// Table 7 of the seed. Alpha of what is valid stays at most 0.99.
dvec4 repaired(const Line& line, double spacing) {
    dvec4 taps[7];
    for (int j = 0; j < 7; ++j)
        taps[j] = asTexel(line, (j - 3) * spacing);
    dvec4 centre = taps[3];
    if (!valid(centre)) {
        const auto* first = std::find_if(std::begin(taps), std::end(taps), valid);
        centre = first == std::end(taps) ? kInvalid : *first;
    }
    dvec4 sum(0);
    for (int j = 0; j < 7; ++j)
        sum += kKernel[j] * (valid(taps[j]) ? taps[j] : centre);
    sum.w = valid(centre) ? min(sum.w, 0.99) : 1;
    return sum;
}

constexpr const char* kLine =
    "float2 uv = (float2(a0, a1) + 0.5) / kTgMapSize; float2 axis = (a2 < 0.5 ? float2(1, 0) : float2(0, 1)) / kTgMapSize; ";

/// Spacings up to 30 texels: sigma 2.3 mm at 9 texels per mm.
Arguments alongLine(double low, double high) {
    return {whole(0, kTestMapSize - 1), whole(0, kTestMapSize - 1), whole(0, 1), linear(low, high, 1, 2e-6)};
}

const Tolerance kTaps{16, 4, 1e-6, "fourteen weighted texels; the fraction of a tap rounds at 2e-6"};

void widths(Cases& cases) {
    cases.add("tgGaussianIncrement(a0, a1, a2, a3)", {linear(0, 3), linear(0, 3), logarithmic(1e-3, 30), linear(0.05, 4)},
              {4, 4, 2e-8, "a difference of two products; 1/12 rounds"}, {.settings = {0, 1, 2}}, [](In x) {
                  const double d2 = x[2] * x[2];
                  return increment(x, x[0] * x[0] * d2, x[1] * x[1] * d2, x[3]);
              });
    // a box w wide has variance w^2 / 12: a texel, and three of the light's map
    cases.add("tgGaussianPresent(a0, a1)", {linear(0, 2), linear(0, 10)}, {4, 2, 0, "four products and a sum"}, [](In x) {
        const double three = 3 * x[0] * x[1];
        return 1.0 / 12 + three * three / 12;
    });
    cases.add("tgGaussianSpacing(a0)", {logarithmic(1e-6, 1e4)},
              {16, 16, 1e-6, "Newton steps on sums of three; 1.0789 is rounded, but only the start depends on it; as printed a root"},
              {.settings = {0, 2}}, [](In x) { return x.corrected() ? spacingFor(x[0]) : sqrt(x[0]); });
    cases.add("tgGaussianDensity(a0)", {linear(0, 1, 4)}, {4, 0, 0, "a quotient and a product"}, {.settings = {0, 2}}, [](In x) {
        const bool ignored = x.seed() && x.scalar(0, 3) > 0.5;
        return (ignored ? dvec2(1) : x.vec2(0)) / 102.4 * double{kTestMapSize};
    });
    cases.add("tgGaussianReach(a0, a1)", {linear(0, 30), linear(0, 1, 4)}, {0, 0, 0, "a choice"},
              [](In x) { return x.scalar(1, 3) > 0.5 ? max(x[0], 1.0) : x[0]; });
}

void convolutions(Cases& cases) {
    const auto line = [](const std::string& code) { return kLine + code; };
    cases.add(
        {"tgGaussianTap", line("float v; float4 t = tgGaussianTap(TG_SAMPLER2D_ARG(gTest), uv, axis, a3, v); return float4(t.xyz, v);")},
        alongLine(-30, 30), kTaps, {.map = &irradianceMap()}, [](In x) {
            const Sum sum = tap(Line(x), x[3]);
            return values(sum.value.x, sum.value.y, sum.value.z, sum.weight);
        });
    cases.add({"tgGaussianTexel", line("return tgGaussianTexel(TG_SAMPLER2D_ARG(gTest), uv, axis, a3);")}, alongLine(-30, 30), kTaps,
              {.settings = {0, 1}, .map = &irradianceMap()}, [](In x) { return asTexel(Line(x), x[3]); });
    cases.add({"tgGaussianConvolve", line("return tgGaussianConvolve(TG_SAMPLER2D_ARG(gTest), uv, axis, a3);")}, alongLine(0, 10), kTaps,
              {.settings = {0, 1, 2}, .map = &irradianceMap()},
              [](In x) { return x.corrected() ? overValid(Line(x), x[3]) : repaired(Line(x), x[3]); });
}

} // namespace

Cases gaussianCases() {
    return together(widths, convolutions);
}

} // namespace tegument::test
