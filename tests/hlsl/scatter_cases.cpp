// hlsl/scatter (without gaussian.fxh) against the definitions of docs/design/modules/Irradiance.md and docs/design/skin.md.

#include "tests/hlsl/maps.h"

namespace tegument::test {

namespace {

constexpr double kLargestAlpha = 0.99;
constexpr double kOpaque = 5000;

/// Bilinear over the valid texels among four, renormalised.
dvec4 overValid(dvec2 uv) {
    const dvec2 place = uv * double{kTestMapSize} - 0.5;
    const dvec2 corner = floor(place);
    const dvec2 f = place - corner;
    dvec4 sum(0);
    double total = 0;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const dvec4 texel = irradianceMap().texel(static_cast<int>(corner.x) + i, static_cast<int>(corner.y) + j);
            if (texel.w >= 0.995) continue;
            const double weight = (i == 0 ? 1 - f.x : f.x) * (j == 0 ? 1 - f.y : f.y);
            sum += weight * texel;
            total += weight;
        }
    return total > 1e-4 ? sum / total : dvec4(0, 0, 0, 1);
}

double share(In x) {
    const double t = x[0];
    const double v = x[1];
    const double exponent = t * t / (x.seed() ? v : 2 * v);
    const double passed = exponent < 50 ? exp(-exponent) : 0; // 2e-22: nothing
    return x.seed() ? passed : passed * saturate(x[2] / (6 * sqrt(v)));
}

/// On a ball of radius a h is r^2 / (2 a), and its curvature 1 / a.
void flesh(Cases& cases) {
    const Tolerance sums{16, 4, 2e-4, "differences of places and of normals"};
    // a hollow has none, nor has a plane
    cases.add({"tgFleshUnder", "return float4(tgFleshUnder(a2 * a0, a0, a2 * a1, a1), tgFleshUnder(a2 * a0, -a0, a2 * a1, -a1), "
                               "tgFleshUnder(a0, float3(0, 0, 1), a1, float3(0, 0, 1)), tgFleshCurvature(a2 * a0, a0, a2 * a1, a1));"},
              {unit(), unit(), linear(1, 20)}, sums, [](In x) {
                  const double squared = dot(x.vec3(0) - x.vec3(1), x.vec3(0) - x.vec3(1));
                  const double radius = x[2];
                  return values(radius * squared / 2, 0, 0, 1 / radius);
              });
    cases.back().domain = [](In x) { return isUnit(x.vec3(0)) && isUnit(x.vec3(1)) && x[2] > 0.5 && length(x.vec3(0) - x.vec3(1)) > 0.05; };
    cases.add("tgFleshCurvature(a2 * a0, a0, a2 * a1, a1).xxxx", {unit(), unit(), linear(1, 20)}, sums,
              [](In x) { return values(1 / x[2], 1 / x[2], 1 / x[2], 1 / x[2]); });
    cases.back().domain = [](In x) { return isUnit(x.vec3(0)) && isUnit(x.vec3(1)) && x[2] > 0.5 && length(x.vec3(0) - x.vec3(1)) > 0.05; };
    cases.add("tgFleshShare(a0, a1, a2)", {linear(0, 3, 3), linear(0, 1), linear(0, 12)}, sums,
              [](In x) { return 1.0 + x.vec3(0) * (x[1] * x[2]); });
}

void entering(Cases& cases) {
    cases.add("tgIrradianceColour(a0, a1)", {linear(0, 1, 3), linear(0, 1)},
              {40, 2, 0, "pow is exp2(y log2 x): 3 + 2|x| ULP with |x| up to 17"},
              [](In x) { return pow(max(x.vec3(0), 1e-5), dvec3(x[1])); });
    cases.add("tgIrradianceBounded(a0, kTgLargestHalf)", {linear(-1e5, 2e5, 3)}, {0, 0, 0, "one of the given numbers"},
              [](In x) { return clamp(x.vec3(0), 0.0, 64512.0); });
    for (const auto& [bits, most] : {std::pair("16", 64512.0), std::pair("32", 1e30)}) // of maps of halves, of floats
        cases.add({"kTgLargestLight", "return float4(tgIrradianceBounded(a0, kTgLargestLight), 0);"}, {linear(-1e5, 2e5, 3)},
                  {0, 0, 0, "one of the given numbers"}, {.defines = {{"TEGUMENT_MAP_BITS", bits}}},
                  [most = most](In x) { return clamp(x.vec3(0), 0.0, most); });
    // what is no number, and what is infinite
    cases.add({"tgIrradianceBounded", "float zero = a0 - a0; float none = zero / zero; return float4(tgIrradianceBounded(float3(none, 1.0 "
                                      "/ zero, -1.0 / zero), 3.0), 0);"},
              {linear(1, 2)}, {0, 0, 0, "given numbers"}, [](In) { return values(0, 3, 0); });
    cases.add("tgIrradianceEntering(a0, a1, a2, a3, a4, a5)",
              {linear(0, 1, 3), linear(0, 1), linear(0, 10, 3), cosine(), linear(0, 1), linear(0, 1)},
              {48, 2, 1e-36, "one power, four products, of which a denormal one is flushed to 0"}, [](In x) {
                  const dvec3 colour = pow(max(x.vec3(0), 1e-5), dvec3(x[1]));
                  return colour * x.vec3(2) * (saturate(x[3]) * x[4] * x[5]);
              });
    cases.add("tgSeamValidity(a0)", {linear(0, 1.01, 4)}, {0, 2, 0, "a comparison with 0.995, rounded"},
              [](In x) { return x.scalar(0, 3) < 0.995 ? 1 : 0; });
    cases.add("tgSeamBilinear(TG_SAMPLER2D_ARG(gTest), a0)", {linear(0.01, 0.99, 2, 2e-7)},
              {8, 2, 1e-5, "the fraction of a texel rounds at 3e-5, the weights with it"}, {.map = &irradianceMap()},
              [](In x) { return overValid(x.vec2(0)); });
}

void passing(Cases& cases) {
    cases.add("tgTransmissionThickness(a0, a1, a2, a3)", {logarithmic(1e-3, 500), cosine(), unit(), unit()},
              {4, 2, 0, "a dot product and an interpolation"}, [](In x) {
                  const double path = x[0];
                  const double parallel = saturate(-dot(x.vec3(3), x.vec3(2)));
                  if (x[1] > 0) return kOpaque;
                  return path + parallel * (saturate(-x[1]) * path - path);
              });
    cases.add("tgTransmissionEncode(a0)", {logarithmic(1e-4, 5000)}, {180, 1, 0, "exp: 3 + 2|x| ULP with |x| up to 87"},
              {.settings = {0, 2}}, [](In x) { return min(x.seed() ? x[0] : exp(-0.2 * x[0]), kLargestAlpha); });
    // what is no number is opaque
    cases.add({"tgTransmissionEncode", "float zero = a0 - a0; return float4(tgTransmissionEncode(zero / zero), 0, 0, 0);"}, {linear(1, 2)},
              {1, 0, 0, "a constant"}, {.settings = {0, 2}}, [](In x) { return x.seed() ? kLargestAlpha : 0; });
    cases.add("tgTransmissionDecode(a0, a1)", {logarithmic(1e-6, 0.99), linear(1, 1000)}, {4, 2, 2e-6, "log: 3 ULP, 2^-21 absolute near 1"},
              {.settings = {0, 2}}, [](In x) { return x.seed() ? x[0] * x[1] : -5 * log(max(x[0], 1e-6)); });
    cases.add("tgTransmissionShare(a0, a1, a2)", {logarithmic(1e-3, 60), logarithmic(0.0064, 7.41), logarithmic(1e-3, 60)},
              {110, 3, 2e-22, "exp: 3 + 2|x| ULP with |x| up to 50, beyond which it is 0"}, {.settings = {0, 2}},
              [](In x) { return share(x); });
    cases.back().domain = [](In x) { return x[1] >= 0.006; }; // the profile has no narrower Gaussian
    cases.add({"tgTransmissionScale", "float2 p = pixel - floor(pixel / 2) * 2; return float4(tgTransmissionScale(a0 * p.x + a1 * p.y, "
                                      "float2(0.25, 0.5) + a2 * p.x + a3 * p.y), 0, 0, 0);"},
              {linear(-3, 3, 3), linear(-3, 3, 3), linear(-0.03, 0.03, 2, 6e-8), linear(-0.03, 0.03, 2, 6e-8)},
              {16, 4, 1e-4, "differences of coordinates near 0.5 keep 6e-8 of 0.03"}, {.perQuad = true}, [](In x) {
                  const double area = length(cross(x.vec3(0), x.vec3(1)));
                  const dvec2 dx = x.vec2(2);
                  const dvec2 dy = x.vec2(3);
                  return sqrt(area / max(abs(dx.x * dy.y - dx.y * dy.x), 1e-12));
              });
    cases.back().domain = [](In x) {
        const double det = x[2] * x.scalar(3, 1) - x.scalar(2, 1) * x[3];
        return abs(det) > 1e-6; // thinner ones are lost in the rounding of uv
    };
}

/// Of photons through three layers and back (docs/design/skin-error.md, "Through an ear"), over the layers' albedo; between the rows each
/// channel falls exponentially.
dvec3 throughSlab(double thickness) {
    static const std::array kRows = {std::pair(1.5, dvec3(0.1947, 0.1306, 0.0069)), std::pair(2.5, dvec3(0.1738, 0.0837, 0.0002)),
                                     std::pair(4.5, dvec3(0.1392, 0.0373, 1e-7)), std::pair(6.5, dvec3(0.1117, 0.0172, 1e-10))};
    std::size_t i = 0;
    while (i + 2 < kRows.size() && thickness > kRows[i + 1].first)
        ++i;
    const double share = (thickness - kRows[i].first) / (kRows[i + 1].first - kRows[i].first);
    return exp(mix(log(kRows[i].second), log(kRows[i + 1].second), share)) / dvec3(0.4894, 0.4059, 0.3118);
}

Cases slab() {
    return {check("tgSlabPassed(a0)", {linear(1.5, 6.5)},
                  {4, 2, 4e-3, "a fit of the simulation, 1 % off in red and green; its rows are joined by exponentials"},
                  [](In x) { return throughSlab(x[0]); })};
}

} // namespace

Cases scatterCases() {
    return together(flesh, entering, passing, slab());
}

} // namespace tegument::test
