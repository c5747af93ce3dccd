// hlsl/scatter/poisson.fxh against seed equations 36 and 40, Table 7, and the printed disc.

#include "lab/reference/convolution.h"
#include "tests/hlsl/maps.h"

namespace tegument::test {

namespace {

dvec2 point(std::size_t i, bool centred, dvec2 rotation) {
    dvec2 mean(0);
    for (const auto& p : reference::kPrintedDisc)
        mean += dvec2(p[0], p[1]) / 12.0;
    const dvec2 p = dvec2(reference::kPrintedDisc[i][0], reference::kPrintedDisc[i][1]) - (centred ? mean : dvec2(0));
    return {p.x * rotation.x - p.y * rotation.y, p.x * rotation.y + p.y * rotation.x};
}

bool valid(const dvec4& texel) {
    return texel.w < 0.995;
}

struct Disc {
    dvec2 uv;
    dvec4 centre;
    dvec2 radius;
    dvec2 rotation;
    bool centred;

    explicit Disc(In x) : uv(x.vec2(0)), centre(x.vec4(1)), radius(x.vec2(2)), rotation(cos(x[3]), sin(x[3])), centred(x.corrected()) {}

    [[nodiscard]] dvec4 tap(std::size_t i) const { return irradianceMap().at(uv + point(i, centred, rotation) * radius); }
};

/// Mean of the valid taps; the centre's alpha stays, an invalid centre takes the taps' mean.
dvec4 overValid(const Disc& disc) {
    dvec4 sum(0);
    double count = 0;
    const auto add = [&](const dvec4& texel) {
        if (!valid(texel)) return;
        sum += texel;
        count += 1;
    };
    add(disc.centre);
    for (std::size_t i = 0; i < reference::kPrintedDisc.size(); ++i)
        add(disc.tap(i));
    if (count == 0) return {0, 0, 0, 1};
    return {dvec3(sum) / count, valid(disc.centre) ? disc.centre.w : sum.w / count};
}

/// Table 7: the first valid tap in the printed order stands in for an invalid centre, the centre for invalid taps.
dvec4 repaired(const Disc& disc) {
    dvec4 centre = disc.centre;
    for (std::size_t i = 0; i < reference::kPrintedDisc.size() && !valid(centre); ++i)
        centre = disc.tap(i);
    if (!valid(centre)) centre = disc.centre;
    dvec3 sum(centre);
    for (std::size_t i = 0; i < reference::kPrintedDisc.size(); ++i)
        sum += dvec3(valid(disc.tap(i)) ? disc.tap(i) : centre);
    return {sum / 13.0, centre.w};
}

/// Equation 40: size * kernel * (1 / width + 1 / height); corrected: mm on the surface, three texels at least outside the charts.
dvec2 radius(In x) {
    const dvec4 centre = x.vec4(1);
    const double kernel = min(centre.w, 0.99);
    if (!x.corrected()) return dvec2(x[0] * kernel * 2 / kTestMapSize);
    const dvec2 texels = x[0] * kernel * x.vec2(2);
    return (valid(centre) ? texels : max(texels, 3.0)) / double{kTestMapSize};
}

std::string blurBody(const std::string& function) {
    return "return " + function + "(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, float2(cos(a3), sin(a3)));";
}

/// uv of the texel, the texel itself, radii in uv, angle of the disc.
Arguments blurArguments() {
    return {linear(0.1, 0.9, 2, 2e-7), linear(0, 1.01, 4), linear(0, 0.05, 2, 1e-7), linear(0, 6.3, 1, 1e-6)};
}

const Tolerance kTaps{16, 2, 1e-6, "thirteen texels summed; a tap on the border of two texels may be either, which the slack of uv allows"};

} // namespace

Cases poissonCases() {
    Cases cases;
    cases.add("tgPoissonPoint((int)a0, a1)", {whole(0, 11), linear(-1, 1, 2)}, {4, 1, 1e-6, "the mean is written with six digits"},
              {.settings = {0, 2}}, [](In x) { return point(static_cast<std::size_t>(x[0]), x.corrected(), x.vec2(1)); });
    cases.add("tgPoissonRadius(a0, a1, a2)", {linear(0, 20), linear(0, 1.01, 4), logarithmic(0.1, 20)}, {4, 2, 0, "a few products"},
              {.settings = {0, 2}}, [](In x) { return radius(x); });
    cases.back().arguments[2].components = 2;
    cases.add({"tgPoissonBlur", blurBody("tgPoissonBlur")}, blurArguments(), kTaps, {.settings = {0, 2}, .map = &irradianceMap()},
              [](In x) { return x.corrected() ? overValid(Disc(x)) : repaired(Disc(x)); });
    return cases;
}

} // namespace tegument::test
