// hlsl/scatter/gaussian.fxh against the definitions of docs/design/modules/Convolution.md.

#include "tests/hlsl/maps.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

constexpr double kKernel[7] = {.006, .061, .242, .383, .242, .061, .006};
constexpr double kSum = 1.001;
constexpr double kTexel = 1.0 / 12;
const glm::dvec4 kInvalid{0, 0, 0, 1};

bool valid(const glm::dvec4& texel) {
    return texel.w < 0.995;
}

double increment(const Inputs& x, double before, double after, double present) {
    if (x.seed()) return after;
    return x.corrected() ? std::max(after, present) - std::max(before, present) : std::max(after - before, 0.0);
}

/// Variance of taps `spacing` apart that are interpolated between texels: each lies on its two neighbours in shares.
double varianceOf(double spacing) {
    double sum = 0;
    for (int j = -3; j <= 3; ++j) {
        const double place = j * spacing;
        const double left = std::floor(place);
        const double f = place - left;
        sum += kKernel[j + 3] * ((1 - f) * left * left + f * (left + 1) * (left + 1));
    }
    return sum / kSum;
}

double spacingFor(double variance) {
    double low = 0;
    double high = std::sqrt(variance) + 1;
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

    explicit Line(const Inputs& in) : x(static_cast<int>(in.scalar(0))), y(static_cast<int>(in.scalar(1))), alongU(in.scalar(2) < 0.5) {}

    [[nodiscard]] glm::dvec4 at(double steps) const {
        const int n = static_cast<int>(steps);
        return alongU ? irradianceMap().texel(x + n, y) : irradianceMap().texel(x, y + n);
    }
};

struct Sum {
    glm::dvec4 value{0};
    double weight = 0;

    void add(double share, const glm::dvec4& texel) {
        if (!valid(texel)) return;
        value += share * texel;
        weight += share;
    }
};

Sum tap(const Line& line, double offset) {
    const double left = std::floor(offset);
    Sum sum;
    sum.add(1 - (offset - left), line.at(left));
    sum.add(offset - left, line.at(left + 1));
    return sum;
}

glm::dvec4 overValid(const Line& line, double spacing) {
    Sum all;
    for (int j = -3; j <= 3; ++j) {
        const Sum one = tap(line, j * spacing);
        all.value += kKernel[j + 3] * one.value;
        all.weight += kKernel[j + 3] * one.weight;
    }
    return all.weight > 1e-4 ? all.value / all.weight : kInvalid;
}

/// The interpolated texel; where one of the two is invalid, the other.
glm::dvec4 asTexel(const Line& line, double offset) {
    const double left = std::floor(offset);
    const double f = offset - left;
    const glm::dvec4 a = line.at(left);
    const glm::dvec4 b = line.at(left + 1);
    if (f == 0 || !valid(b)) return a;
    return valid(a) ? (1 - f) * a + f * b : b;
}

/// Table 7 of the seed. Alpha of what is valid stays at most 0.99.
glm::dvec4 repaired(const Line& line, double spacing) {
    glm::dvec4 taps[7];
    for (int j = 0; j < 7; ++j)
        taps[j] = asTexel(line, (j - 3) * spacing);
    glm::dvec4 centre = taps[3];
    if (!valid(centre)) {
        const auto* first = std::find_if(std::begin(taps), std::end(taps), valid);
        centre = first == std::end(taps) ? kInvalid : *first;
    }
    glm::dvec4 sum(0);
    for (int j = 0; j < 7; ++j)
        sum += kKernel[j] * (valid(taps[j]) ? taps[j] : centre);
    sum.w = valid(centre) ? std::min(sum.w, 0.99) : 1;
    return sum;
}

constexpr const char* kLine =
    "float2 uv = (float2(a0, a1) + 0.5) / kTgMapSize; float2 axis = (a2 < 0.5 ? float2(1, 0) : float2(0, 1)) / kTgMapSize; ";

/// Spacings up to 30 texels: sigma 2.3 mm at 9 texels per mm.
std::vector<Argument> alongLine(double low, double high) {
    return {whole(0, kTestMapSize - 1), whole(0, kTestMapSize - 1), whole(0, 1), linear(low, high, 1, 2e-6)};
}

const Tolerance kTaps{
    .forward = 16, .backward = 4, .absolute = 1e-6, .why = "fourteen weighted texels; the fraction of a tap rounds at 2e-6"};

std::vector<FunctionCase> widths() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgGaussianIncrement",
                     .body = "return float4(tgGaussianIncrement(a0, a1, a2, a3), 0, 0, 0);",
                     .arguments = {linear(0, 3), linear(0, 3), logarithmic(1e-3, 30), linear(0.05, 4)},
                     .expected =
                         [](const Inputs& x) {
                             const double d2 = x.scalar(2) * x.scalar(2);
                             return values(increment(x, x.scalar(0) * x.scalar(0) * d2, x.scalar(1) * x.scalar(1) * d2, x.scalar(3)));
                         },
                     .tolerance = {.forward = 4, .backward = 4, .absolute = 2e-8, .why = "a difference of two products; 1/12 rounds"},
                     .settings = {0, 1, 2}});
    cases.push_back({.function = "tgGaussianPresent", // a box w wide has variance w^2 / 12: a texel, and three of the light's map
                     .body = "return float4(tgGaussianPresent(a0, a1), 0, 0, 0);",
                     .arguments = {linear(0, 2), linear(0, 10)},
                     .expected =
                         [](const Inputs& x) {
                             const double three = 3 * x.scalar(0) * x.scalar(1);
                             return values(1.0 / 12 + three * three / 12);
                         },
                     .tolerance = {.forward = 4, .backward = 2, .why = "four products and a sum"}});
    cases.push_back(
        {.function = "tgGaussianSpacing",
         .body = "return float4(tgGaussianSpacing(a0), 0, 0, 0);",
         .arguments = {logarithmic(1e-6, 1e4)},
         .expected = [](const Inputs& x) { return values(x.corrected() ? spacingFor(x.scalar(0)) : std::sqrt(x.scalar(0))); },
         .tolerance = {.forward = 16,
                       .backward = 16,
                       .absolute = 1e-6,
                       .why = "Newton steps on sums of three; 1.0789 is rounded, but only the start depends on it; as printed a root"},
         .settings = {0, 2}});
    cases.push_back({.function = "tgGaussianDensity",
                     .body = "return float4(tgGaussianDensity(a0), 0, 0);",
                     .arguments = {linear(0, 1, 4)},
                     .expected =
                         [](const Inputs& x) {
                             const bool ignored = x.seed() && x.scalar(0, 3) > 0.5;
                             return values((ignored ? glm::dvec2(1) : x.vec2(0)) / 102.4 * double{kTestMapSize});
                         },
                     .tolerance = {.forward = 4, .backward = 0, .why = "a quotient and a product"},
                     .settings = {0, 2}});
    cases.push_back({.function = "tgGaussianReach",
                     .body = "return float4(tgGaussianReach(a0, a1), 0, 0, 0);",
                     .arguments = {linear(0, 30), linear(0, 1, 4)},
                     .expected = [](const Inputs& x) { return values(x.scalar(1, 3) > 0.5 ? std::max(x.scalar(0), 1.0) : x.scalar(0)); },
                     .tolerance = {.forward = 0, .backward = 0, .why = "a choice"}});
    return cases;
}

std::vector<FunctionCase> convolutions() {
    std::vector<FunctionCase> cases;
    const auto line = [](const std::string& code) { return kLine + code; };
    cases.push_back({.function = "tgGaussianTap",
                     .body = line("float v; float4 t = tgGaussianTap(TG_SAMPLER2D_ARG(gTest), uv, axis, a3, v); return float4(t.xyz, v);"),
                     .arguments = alongLine(-30, 30),
                     .expected =
                         [](const Inputs& x) {
                             const Sum sum = tap(Line(x), x.scalar(3));
                             return values(sum.value.x, sum.value.y, sum.value.z, sum.weight);
                         },
                     .tolerance = kTaps,
                     .map = &irradianceMap()});
    cases.push_back({.function = "tgGaussianTexel",
                     .body = line("return tgGaussianTexel(TG_SAMPLER2D_ARG(gTest), uv, axis, a3);"),
                     .arguments = alongLine(-30, 30),
                     .expected = [](const Inputs& x) { return values(asTexel(Line(x), x.scalar(3))); },
                     .tolerance = kTaps,
                     .settings = {0, 1},
                     .map = &irradianceMap()});
    cases.push_back(
        {.function = "tgGaussianConvolve",
         .body = line("return tgGaussianConvolve(TG_SAMPLER2D_ARG(gTest), uv, axis, a3);"),
         .arguments = alongLine(0, 10),
         .expected =
             [](const Inputs& x) { return values(x.corrected() ? overValid(Line(x), x.scalar(3)) : repaired(Line(x), x.scalar(3))); },
         .tolerance = kTaps,
         .settings = {0, 1, 2},
         .map = &irradianceMap()});
    return cases;
}

} // namespace

std::vector<FunctionCase> gaussianCases() {
    std::vector<FunctionCase> cases = widths();
    for (FunctionCase& convolution : convolutions())
        cases.push_back(std::move(convolution));
    return cases;
}

} // namespace tegument::test
