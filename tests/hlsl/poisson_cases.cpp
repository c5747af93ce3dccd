// hlsl/scatter/poisson.fxh against seed equations 36 and 40, Table 7, and the printed disc.

#include "lab/reference/convolution.h"
#include "tests/hlsl/maps.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

glm::dvec2 point(std::size_t i, bool centred, glm::dvec2 rotation) {
    glm::dvec2 mean(0);
    for (const auto& p : reference::kPrintedDisc)
        mean += glm::dvec2(p[0], p[1]) / 12.0;
    const glm::dvec2 p = glm::dvec2(reference::kPrintedDisc[i][0], reference::kPrintedDisc[i][1]) - (centred ? mean : glm::dvec2(0));
    return {p.x * rotation.x - p.y * rotation.y, p.x * rotation.y + p.y * rotation.x};
}

bool valid(const glm::dvec4& texel) {
    return texel.w < 0.995;
}

struct Disc {
    glm::dvec2 uv;
    glm::dvec4 centre;
    glm::dvec2 radius;
    glm::dvec2 rotation;
    bool centred;

    explicit Disc(const Inputs& x)
        : uv(x.vec2(0)), centre(x.vec4(1)), radius(x.vec2(2)), rotation(std::cos(x.scalar(3)), std::sin(x.scalar(3))),
          centred(x.corrected()) {}

    [[nodiscard]] glm::dvec4 tap(std::size_t i) const { return irradianceMap().at(uv + point(i, centred, rotation) * radius); }
};

/// Mean of the valid taps; the centre's alpha stays, an invalid centre takes the taps' mean.
glm::dvec4 overValid(const Disc& disc) {
    glm::dvec4 sum(0);
    double count = 0;
    const auto add = [&](const glm::dvec4& texel) {
        if (!valid(texel)) return;
        sum += texel;
        count += 1;
    };
    add(disc.centre);
    for (std::size_t i = 0; i < reference::kPrintedDisc.size(); ++i)
        add(disc.tap(i));
    if (count == 0) return {0, 0, 0, 1};
    return {glm::dvec3(sum) / count, valid(disc.centre) ? disc.centre.w : sum.w / count};
}

/// Table 7: the first valid tap in the printed order stands in for an invalid centre, the centre for invalid taps.
glm::dvec4 repaired(const Disc& disc) {
    glm::dvec4 centre = disc.centre;
    for (std::size_t i = 0; i < reference::kPrintedDisc.size() && !valid(centre); ++i)
        centre = disc.tap(i);
    if (!valid(centre)) centre = disc.centre;
    glm::dvec3 sum(centre);
    for (std::size_t i = 0; i < reference::kPrintedDisc.size(); ++i)
        sum += glm::dvec3(valid(disc.tap(i)) ? disc.tap(i) : centre);
    return {sum / 13.0, centre.w};
}

/// Equation 40: size * kernel * (1 / width + 1 / height); corrected: mm on the surface, three texels at least outside the charts.
glm::dvec2 radius(const Inputs& x) {
    const glm::dvec4 centre = x.vec4(1);
    const double kernel = std::min(centre.w, 0.99);
    if (!x.corrected()) return glm::dvec2(x.scalar(0) * kernel * 2 / kTestMapSize);
    const glm::dvec2 texels = x.scalar(0) * kernel * x.vec2(2);
    return (valid(centre) ? texels : glm::max(texels, 3.0)) / double{kTestMapSize};
}

std::string blurBody(const std::string& function) {
    return "return " + function + "(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, float2(cos(a3), sin(a3)));";
}

/// uv of the texel, the texel itself, radii in uv, angle of the disc.
std::vector<Argument> blurArguments() {
    return {linear(0.1, 0.9, 2, 2e-7), linear(0, 1.01, 4), linear(0, 0.05, 2, 1e-7), linear(0, 6.3, 1, 1e-6)};
}

const Tolerance kTaps{.forward = 16,
                      .backward = 2,
                      .absolute = 1e-6,
                      .why = "thirteen texels summed; a tap on the border of two texels may be either, which the slack of uv allows"};

} // namespace

std::vector<FunctionCase> poissonCases() {
    std::vector<FunctionCase> cases;
    cases.push_back(
        {.function = "tgPoissonPoint",
         .body = "return float4(tgPoissonPoint((int)a0, a1), 0, 0);",
         .arguments = {whole(0, 11), linear(-1, 1, 2)},
         .expected = [](const Inputs& x) { return values(point(static_cast<std::size_t>(x.scalar(0)), x.corrected(), x.vec2(1))); },
         .tolerance = {.forward = 4, .backward = 1, .absolute = 1e-6, .why = "the mean is written with six digits"},
         .settings = {0, 2}});
    cases.push_back({.function = "tgPoissonRadius",
                     .body = "return float4(tgPoissonRadius(a0, a1, a2), 0, 0);",
                     .arguments = {linear(0, 20), linear(0, 1.01, 4), logarithmic(0.1, 20)},
                     .expected = [](const Inputs& x) { return values(radius(x)); },
                     .tolerance = {.forward = 4, .backward = 2, .why = "a few products"},
                     .settings = {0, 2}});
    cases.back().arguments[2].components = 2;
    cases.push_back({.function = "tgPoissonBlur",
                     .body = blurBody("tgPoissonBlur"),
                     .arguments = blurArguments(),
                     .expected = [](const Inputs& x) { return values(x.corrected() ? overValid(Disc(x)) : repaired(Disc(x))); },
                     .tolerance = kTaps,
                     .settings = {0, 2},
                     .map = &irradianceMap()});
    return cases;
}

} // namespace tegument::test
