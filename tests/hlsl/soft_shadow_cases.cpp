// hlsl/shadow/soft.fxh against Fernando's definition, tap by tap in double precision.

#include "tests/hlsl/maps.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

constexpr double kGolden = 2.399963229728653; // pi (3 - sqrt 5)

double softStored(glm::dvec2 uv) {
    if (uv != glm::clamp(uv, 0.0, 1.0)) return 1e9;
    const double depth = shadowMap().at(uv).x;
    return depth > 0 ? depth : 1e9;
}

glm::dvec2 softTap(int i, int count, double turn) {
    return std::sqrt((i + 0.5) / count) * glm::dvec2(std::cos(kGolden * i + turn), std::sin(kGolden * i + turn));
}

/// Share of a disc of so many texels in which nothing lies before `depth`.
double softDisc(glm::dvec2 uv, double depth, double radius, double turn) {
    double lit = 0;
    for (int i = 0; i < 32; ++i)
        lit += depth <= softStored(uv + radius * softTap(i, 32, turn) / double{kTestMapSize}) ? 1.0 / 32 : 0;
    return lit;
}

struct SoftLight {
    double size = 0;
    bool point = false;

    [[nodiscard]] double width(double gap, double before) const { return size * gap / std::max(point ? before : 1.0, 1e-3); }
};

double softShare(glm::dvec2 uv, double depth, const SoftLight& light, double turn) {
    constexpr double kFootprint = 0.5;
    const auto seen = [&](const glm::dvec2& texels) { return softStored(uv + texels / double{kTestMapSize}); };
    const double search = std::max(light.width(depth - 400, 400) / kFootprint, 1.5);
    double hiding = 0;
    double widths = 0;
    for (int i = 0; i < 64; ++i) {
        const glm::dvec2 offset = search * softTap(i, 64, turn);
        const double before = seen(offset);
        const double width = std::max(light.width(depth - before, before) / kFootprint, 1.5);
        if (before > depth || glm::length(offset) > width) continue;
        hiding += 1;
        widths += width;
    }
    return softDisc(uv, depth, hiding > 0 ? std::max(widths / hiding, 1.5) : 1.5, turn);
}

} // namespace

std::vector<FunctionCase> softShadowCases() {
    std::vector<FunctionCase> cases;
    cases.push_back({.function = "tgSoftNoise",
                     .body = "return float4(tgSoftNoise(a0), 0, 0, 0);",
                     .arguments = {linear(0, 1024, 2)},
                     .expected =
                         [](const Inputs& x) {
                             const glm::dvec2 p = glm::floor(x.vec2(0));
                             return values(glm::fract(52.9829189 * glm::fract(0.06711056 * p.x + 0.00583715 * p.y)));
                         },
                     .tolerance = {.absolute = 6e-4, .why = "53 times a sum of up to 75, half an ULP of it 4e-6 twice"},
                     .domain =
                         [](const Inputs& x) {
                             const glm::dvec2 p = glm::floor(x.vec2(0));
                             const double inner = glm::fract(0.06711056 * p.x + 0.00583715 * p.y);
                             const double outer = glm::fract(52.9829189 * inner);
                             return std::min(outer, 1 - outer) > 1e-3 && std::min(inner, 1 - inner) > 1e-4;
                         }});
    cases.push_back({.function = "tgSoftTap",
                     .body = "return float4(tgSoftTap(a0, 64, a1), 0, 0);",
                     .arguments = {whole(0, 63), linear(0, 6.28)},
                     .expected = [](const Inputs& x) { return values(softTap(static_cast<int>(x.scalar(0)), 64, x.scalar(1))); },
                     .tolerance = {.absolute = 4e-5, .why = "sine and cosine of up to 160 rad, 1e-5 off"}});
    cases.push_back(
        {.function = "tgSoftWidth",
         .body = "return float4(tgSoftWidth(float2(a0, a3), a1, a2), 0, 0, 0);",
         .arguments = {linear(0, 50), linear(0, 500), linear(1, 1000), whole(0, 1)},
         .expected = [](const Inputs& x) { return values(x.scalar(0) * x.scalar(1) / (x.scalar(3) > 0.5 ? x.scalar(2) : 1.0)); },
         .tolerance = {.forward = 8, .why = "a product and a quotient; 1 + 1 (x - 1)"}});
    // Along a plane whose distance is the reciprocal of a linear function: a small step and a large one lie on the same plane.
    cases.push_back({.function = "tgSoftDepths",
                     .body = "float2 d = tgSoftDepths(TG_SAMPLER2D_ARG(gTest), float2(0.5, 0.5), a0, a1, a2, float2(1, a3)); "
                             "return float4(d.x, 0, 0, 0);",
                     .arguments = {linear(-20, 20, 2), linear(400, 700), linear(-2, 2, 2), whole(0, 1)},
                     .expected =
                         [](const Inputs& x) {
                             const double rise = glm::dot(x.vec2(0), x.vec2(2));
                             const double depth = x.scalar(1);
                             return values(x.scalar(3) > 0.5 ? 1 / (1 / depth - rise / (depth * depth)) : depth + rise);
                         },
                     .tolerance = {.forward = 16, .backward = 4, .absolute = 1e-3, .why = "a sum of 700, 6e-5 off, and two quotients"},
                     .map = &shadowMap()});
    cases.push_back({.function = "tgShadowDisc",
                     .body = "return float4(tgShadowDisc(TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), float2(1, 1), a2, a3), 0, 0, 0);",
                     .arguments = {linear(0.1, 0.9, 2), linear(500, 700), linear(0.5, 4), linear(0, 6.28)},
                     .expected = [](const Inputs& x) { return values(softDisc(x.vec2(0), x.scalar(1), x.scalar(2), x.scalar(3))); },
                     .tolerance = {.absolute = 0.0955, .why = "three taps of 32 on the border of a texel may see either side of it"},
                     .map = &shadowMap()});
    cases.push_back({.function = "tgShadowSoft",
                     .body = "return float4(tgShadowSoft(TG_SAMPLER2D_ARG(gTest), a0, a1, float2(0, 0), 0.5, float2(a2, a3), 400, a4), 0, "
                             "0, 0);",
                     .arguments = {linear(0.1, 0.9, 2), linear(500, 700), linear(0.005, 0.02), whole(0, 1), linear(0, 6.28)},
                     .expected =
                         [](const Inputs& x) {
                             const SoftLight light{.size = x.scalar(2), .point = x.scalar(3) > 0.5};
                             return values(softShare(x.vec2(0), x.scalar(1), light, x.scalar(4)));
                         },
                     .tolerance = {.absolute = 0.0955, .why = "three taps of 32 on the border of a texel may see either side of it"},
                     .map = &shadowMap()});
    return cases;
}

} // namespace tegument::test
