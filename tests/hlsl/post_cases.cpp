// hlsl/scatter/post.fxh against the definitions of docs/design/modules/SkinPost.md, for a view and six Gaussians that can be written down.

#include "tests/hlsl/maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tegument::test {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array<double, 6> kWeights = {0.1, 0.15, 0.2, 0.25, 0.2, 0.1};
constexpr std::array<double, 6> kVariances = {0.01, 0.05, 0.2, 0.6, 2, 7};
constexpr glm::dvec2 kPixel = {0.01, 0.02};

/// P(u, v, z) = z (0.8 u - 0.4, 0.3 - 0.6 v, 1).
const std::string kView = "TgPostView view = (TgPostView)0; view.ray = float3(-0.4, 0.3, 1.0); view.rayU = float3(0.8, 0.0, 0.0); "
                          "view.rayV = float3(0.0, -0.6, 0.0); const float2 texel = float2(0.01, 0.02); ";
const std::string kGaussians =
    "float4 g[6]; g[0] = tgPostStored(float4(0.1, 0.05, 0.025, 0.01)); g[1] = tgPostStored(float4(0.15, 0.075, 0.0375, 0.05)); "
    "g[2] = tgPostStored(float4(0.2, 0.1, 0.05, 0.2)); g[3] = tgPostStored(float4(0.25, 0.125, 0.0625, 0.6)); "
    "g[4] = tgPostStored(float4(0.2, 0.1, 0.05, 2.0)); g[5] = tgPostStored(float4(0.1, 0.05, 0.025, 7.0)); ";
const glm::dvec3 kChannels = {1, 0.5, 0.25};

glm::dvec3 rayAt(const glm::dvec2& uv) {
    return {0.8 * uv.x - 0.4, 0.3 - 0.6 * uv.y, 1};
}
glm::dvec3 tangent(const glm::dvec2& uv, const glm::dvec2& way, double z, double slope) {
    return z * glm::dvec3(0.8 * way.x, -0.6 * way.y, 0) + slope * rayAt(uv);
}
double facing(double z) {
    return 0.48 * z * z * kPixel.x * kPixel.y;
}

/// A sum over the Gaussians of what `of` says for a weight and a variance.
template <class Of>
double summed(Of of) {
    double sum = 0;
    for (std::size_t i = 0; i < kWeights.size(); ++i)
        sum += of(kWeights.at(i), kVariances.at(i));
    return sum;
}
double reflectance(double square) {
    return summed([&](double w, double v) { return w / (2 * kPi * v) * std::exp(-square / (2 * v)); });
}
double share(double square) {
    return summed([&](double w, double v) { return w * (1 - std::exp(-square / (2 * v))); });
}
double chance(double square) {
    const double all = summed([](double w, double) { return std::pow(w, 0.4); });
    return summed([&](double w, double v) { return std::pow(w, 0.4) * (1 - std::exp(-square / (2 * v))); }) / all;
}
double radius(double of) {
    double low = 0;
    double high = 32;
    for (int i = 0; i < 60; ++i)
        (chance(0.25 * (low + high) * (low + high)) < of ? low : high) = 0.5 * (low + high);
    return low;
}

FunctionCase post(std::string function, std::string body, std::vector<Argument> arguments, std::function<Values(const Inputs&)> expected,
                  Tolerance tolerance = {.forward = 64, .backward = 16, .absolute = 1e-5, .why = "sums of some products"}) {
    FunctionCase made{.function = std::move(function),
                      .body = std::move(body),
                      .arguments = std::move(arguments),
                      .expected = std::move(expected),
                      .tolerance = std::move(tolerance)};
    made.samples = 1024;
    return made;
}

std::vector<FunctionCase> masks() {
    std::vector<FunctionCase> cases;
    cases.push_back(post("tgPostMask", "return tgPostMask(a0, a1).xxxx;", {whole(0, 15), linear(0, 1)}, [](const Inputs& x) {
        const double mask = (std::round(x.scalar(0)) + 0.0625 + 0.875 * std::clamp(x.scalar(1), 0.0, 1.0)) / 16;
        return values(mask, mask, mask, mask);
    }));
    cases.push_back(post("tgPostCounts", "return float4(tgPostCounts(a0), tgPostCounts(0.0), tgPostCounts(0.001), 0.0);", {linear(0.01, 1)},
                         [](const Inputs&) { return values(1, 0, 0.5); }));
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) > 0.003; };
    cases.push_back(
        post("tgPostProfile", "return tgPostProfile(tgPostMask(a0, a1)).xxxx;", {whole(0, 15), linear(0, 1)}, [](const Inputs& x) {
            const double profile = std::round(x.scalar(0));
            return values(profile, profile, profile, profile);
        }));
    cases.push_back(
        post("tgPostStrength", "return tgPostStrength(tgPostMask(a0, a1)).xxxx;", {whole(0, 15), linear(0, 1)}, [](const Inputs& x) {
            const double strength = std::clamp(x.scalar(1), 0.0, 1.0);
            return values(strength, strength, strength, strength);
        }));
    return cases;
}

std::vector<FunctionCase> places() {
    const std::string matrix = "const float4x4 from = float4x4(2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, -0.5, -1, -1, 1, 1); ";
    const Argument uv = linear(0, 1, 2);
    const Argument depth = linear(20, 80);
    const Tolerance wide{.forward = 64, .backward = 16, .absolute = 2e-3, .why = "differences of places some tens of mm away"};
    std::vector<FunctionCase> cases;
    cases.push_back(
        post("tgPostUnproject", matrix + "return float4(tgPostUnproject(a0, a1, from, 10.0), 0);", {uv, linear(0, 1)}, [](const Inputs& x) {
            return values(10 / (1 - 0.5 * x.scalar(1)) * glm::dvec3(2 * x.scalar(0) - 1, 3 * x.scalar(0, 1) - 1, 1));
        }));
    cases.push_back(post("tgPostRay", "return float4(tgPostRay(float3(a0, 1.0), float3(a1, 3.0)), 0);",
                         {linear(-9, 9, 2), linear(-9, 9, 2)},
                         [](const Inputs& x) { return values(glm::dvec3(0.5 * (x.vec2(1) - x.vec2(0)), 1)); }));
    cases.push_back(post(
        "tgPostView",
        matrix + "TgPostView view = tgPostView(from, 10.0); return float4(view.ray + a0.x * view.rayU + a0.y * view.rayV, "
                 "length(view.origin) + length(view.originU) + length(view.originV));",
        {uv}, [](const Inputs& x) { return values(2 * x.scalar(0) - 1, 3 * x.scalar(0, 1) - 1, 1, 0); }, wide));
    cases.push_back(post("tgPostPlace", kView + "return float4(tgPostPlace(view, a0, a1), 0);", {uv, depth},
                         [](const Inputs& x) { return values(x.scalar(1) * rayAt(x.vec2(0))); }));
    cases.push_back(post("tgPostSpread", kView + "return tgPostSpread(view, a0).xxxx;", {depth}, [](const Inputs& x) {
        const double spread = 0.48 * x.scalar(0) * x.scalar(0);
        return values(spread, spread, spread, spread);
    }));
    cases.push_back(post("tgPostSlope",
                         kView + "return float4(tgPostSlope(view, texel, float2(a0, 1), 50.0, float2(a1, 1)), "
                                 "tgPostSlope(view, texel, float2(a0, 0), 50.0, float2(a1, 1)), "
                                 "tgPostSlope(view, texel, float2(a0, 0), 50.0, float2(a1, 0)), 0);",
                         {linear(35, 65), linear(35, 65)}, [](const Inputs& x) {
                             const double most = 12 * std::sqrt(facing(50));
                             const double before = 50 - x.scalar(0);
                             const double after = x.scalar(1) - 50;
                             const double nearer = std::abs(before) < std::abs(after) ? before : after;
                             return values(std::abs(nearer) < most ? nearer : 0, std::abs(after) < most ? after : 0, 0);
                         }));
    cases.back().domain = [](const Inputs& x) {
        const double most = 12 * std::sqrt(facing(50));
        const double before = std::abs(50 - x.scalar(0));
        const double after = std::abs(x.scalar(1) - 50);
        return std::abs(before - after) > 1e-3 && std::abs(before - most) > 1e-3 && std::abs(after - most) > 1e-3;
    };
    cases.push_back(post("tgPostTangent", kView + "return float4(tgPostTangent(view, a0, float2(texel.x, 0), a1, a2), 0);",
                         {uv, depth, linear(-2, 2)}, [](const Inputs& x) {
                             return values(tangent(x.vec2(0), {kPixel.x, 0}, x.scalar(1), x.scalar(2)));
                         }));
    cases.push_back(post("tgPostGrazing", kView + "return tgPostGrazing(view, a0, texel, a1, a2).xxxx;", {uv, depth, linear(-2, 2, 2)},
                         [](const Inputs& x) {
                             const glm::dvec3 right = tangent(x.vec2(0), {kPixel.x, 0}, x.scalar(1), x.scalar(2));
                             const glm::dvec3 down = tangent(x.vec2(0), {0, kPixel.y}, x.scalar(1), x.scalar(2, 1));
                             const double grazing = std::clamp(glm::length(glm::cross(right, down)) / facing(x.scalar(1)), 1.0, 12.0);
                             return values(grazing, grazing, grazing, grazing);
                         },
                         {.forward = 64, .backward = 64, .absolute = 1e-4, .why = "a cross product over a product"}));
    cases.back().domain = [](const Inputs& x) { return x.scalar(1) > 1; };
    return cases;
}

std::vector<FunctionCase> profiles() {
    static const TestMap kStored = mapOf(64, 16, [](int x, int y) { return texelOf(x, y, x + y, 0.25 * y); });
    static const TestMap kDepths = mapOf(8, 1, [](int x, int) { return texelOf(12.0 * x, 0.25 * x); });
    std::vector<FunctionCase> cases;
    cases.push_back(post("tgPostZ", "return float4(tgPostZ(TG_SAMPLER2D_ARG(gTest), float2((a0 + 0.5) / 8.0, 0.5)), 0, 0);", {whole(0, 7)},
                         [](const Inputs& x) { return std::round(x.scalar(0)) > 0 ? values(48, 1) : values(0, 0); }));
    cases.back().map = &kDepths;
    cases.push_back(
        post("tgPostStored", "return tgPostStored(float4(a0, a1));", {linear(0, 1, 3), logarithmic(0.01, 10)}, [](const Inputs& x) {
            return values(glm::dvec4(x.vec3(0) / (2 * kPi * x.scalar(1)), 0.5 * std::numbers::log2e / x.scalar(1)));
        }));
    cases.back().domain = [](const Inputs& x) { return x.scalar(1) > 1e-3; };
    cases.push_back(post("tgPostReflectance", kGaussians + "return float4(tgPostReflectance(g, a0), 0);", {linear(0, 40)},
                         [](const Inputs& x) { return values(reflectance(x.scalar(0)) * kChannels); }));
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) >= 0 && x.scalar(0) < 100; };
    cases.push_back(post("tgPostShare", kGaussians + "return float4(tgPostShare(g, a0), 0);", {linear(0, 40)},
                         [](const Inputs& x) { return values(share(x.scalar(0)) * kChannels); }));
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) >= 0 && x.scalar(0) < 100; };
    cases.push_back(post("tgPostRead", "float4 g[6]; tgPostRead(TG_SAMPLER2D_ARG(gTest), a0, g); return g[1] + 10.0 * g[5];",
                         {whole(0, 15)}, [](const Inputs& x) {
                             const double y = std::round(x.scalar(0)); // eight texels lie over the 64 of the map
                             return values(12 + 440, 11 * y, 452 + 11 * y, 11 * 0.25 * y);
                         }));
    cases.back().map = &kStored;
    cases.push_back(
        post("tgPostTapOf", "return tgPostTapOf(TG_SAMPLER2D_ARG(gTest), a0, a1);", {whole(0, 15), whole(0, 63)}, [](const Inputs& x) {
            const double row = std::round(x.scalar(0));
            const double i = std::round(x.scalar(1));
            return values(i, row, i + row, 0.25 * row);
        }));
    cases.back().map = &kStored;
    cases.push_back(post("tgPostChance", kGaussians + "return tgPostChance(g, a0).xxxx;", {linear(0, 40)}, [](const Inputs& x) {
        const double c = chance(x.scalar(0));
        return values(c, c, c, c);
    }));
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) >= 0 && x.scalar(0) < 100; };
    cases.push_back(post("tgPostRadius", kGaussians + "return tgPostRadius(g, a0).xxxx;", {linear(0.05, 0.95)},
                         [](const Inputs& x) {
                             const double r = radius(x.scalar(0));
                             return values(r, r, r, r);
                         },
                         {.forward = 4096, .backward = 64, .absolute = 1e-4, .why = "24 halvings of 32 mm, of sums of six exponentials"}));
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) > 0.02 && x.scalar(0) < 0.98; };
    cases.push_back(
        post("tgPostTap", kGaussians + "return tgPostTap(g, a0, 24.0);", {whole(0, 23)},
             [](const Inputs& x) {
                 const double i = std::round(x.scalar(0));
                 const double inner = i > 0 ? radius(i / 24) : 0;
                 const double outer = i + 1.5 < 24 ? radius((i + 1) / 24) : 32;
                 const double middle = radius((i + 0.5) / 24);
                 const double far = std::min(outer, 2 * middle - inner);
                 const double area = kPi * (far * far - inner * inner);
                 const glm::dvec3 ring(std::min((share(outer * outer) - share(inner * inner)) / reflectance(middle * middle), 4 * area));
                 return values(glm::dvec4(ring, middle));
             },
             {.forward = 1 << 16, .backward = 4, .absolute = 1e-4, .why = "radii are found by halving, 2e-6 mm of some hundredths"}));
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) >= 0 && x.scalar(0) <= 23; };
    return cases;
}

std::vector<FunctionCase> sums() {
    const std::string disc = kView + "TgPostDisc disc = tgPostDisc(view, float2(0.4, 0.6), texel, 50.0, a0); ";
    const std::string flat = "TgPostDisc disc = (TgPostDisc)0; disc.uv = float2(0.4, 0.6); disc.steps = float3(0.02, -0.003, 0.025); "
                             "disc.level = -0.5; ";
    struct Disc {
        double area, wide;
        glm::dvec2 rise; // of a row, along the axes
        explicit Disc(const glm::dvec2& slope) {
            const glm::dvec3 right = tangent({0.4, 0.6}, {kPixel.x, 0}, 50, slope.x);
            const glm::dvec3 down = tangent({0.4, 0.6}, {0, kPixel.y}, 50, slope.y);
            area = glm::length(glm::cross(right, down));
            wide = glm::length(right);
            const glm::dvec3 axisU = right / wide;
            rise = {glm::dot(down, axisU), glm::dot(down, glm::cross(glm::cross(right, down) / area, axisU))};
        }
    };
    std::vector<FunctionCase> cases;
    const Tolerance products{.forward = 64, .backward = 64, .absolute = 1e-5, .why = "products of vectors"};
    cases.push_back(post(
        "tgPostDisc", disc + "return float4(disc.area, disc.share, disc.level, 0);", {linear(-1, 1, 2)},
        [](const Inputs& x) {
            const Disc d(x.vec2(0));
            return values(d.area, kPixel.x * kPixel.y / d.area, -0.5 * std::log2(d.area) - 1, 0);
        },
        products));
    cases.push_back(post(
        "tgPostDisc", disc + "return float4(disc.steps, 0);", {linear(-1, 1, 2)},
        [](const Inputs& x) {
            const Disc d(x.vec2(0));
            return values(kPixel.x / d.wide, -d.rise.x / d.rise.y * kPixel.x / d.wide, kPixel.y / d.rise.y, 0);
        },
        products));
    cases.push_back(post("tgPostWithin",
                         "TgPostDisc disc = (TgPostDisc)0; disc.area = a0; return tgPostWithin(disc, float4(0, 0, 0, a1)) ? 1.0 : 0.0;",
                         {linear(0.1, 2), linear(0, 1)}, [](const Inputs& x) {
                             const double within = kPi * x.scalar(1) * x.scalar(1) < 0.5 * x.scalar(0) ? 1 : 0;
                             return values(within, within, within, within);
                         }));
    cases.back().domain = [](const Inputs& x) { return std::abs(kPi * x.scalar(1) * x.scalar(1) - 0.5 * x.scalar(0)) > 1e-4; };
    cases.push_back(post("tgPostFirst", "return float4(tgPostFirst(a0), 0, 0);", {linear(0, 1)},
                         [](const Inputs& x) { return values(std::cos(2 * kPi * x.scalar(0)), std::sin(2 * kPi * x.scalar(0))); }));
    cases.push_back(post("tgPostNext",
                         "float2 way = float2(1.0, 0.0); [loop] for (float i = 0.0; i < a0; i += 1.0) way = tgPostNext(way); "
                         "return float4(way, 0, 0);",
                         {whole(0, 63)},
                         [](const Inputs& x) {
                             const double angle = kPi * (3 - std::sqrt(5.0)) * std::round(x.scalar(0));
                             return values(std::cos(angle), std::sin(angle));
                         },
                         {.forward = 64, .backward = 16, .absolute = 2e-5, .why = "up to 63 turns, each rounded to 24 bits"}));
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) >= 0; };
    cases.push_back(post("tgPostTarget", flat + "return float4(tgPostTarget(disc, float4(a0, 0, 0, a1), a2), 0);",
                         {logarithmic(0.1, 100), linear(0, 10), linear(-1, 1, 2)}, [](const Inputs& x) {
                             const glm::dvec2 at = x.scalar(1) * x.vec2(2);
                             const double level = std::round(std::clamp(0.5 * std::log2(x.scalar(0)) - 0.5, 0.0, 6.0));
                             return values(0.4 + 0.02 * at.x - 0.003 * at.y, 0.6 + 0.025 * at.y, level);
                         }));
    cases.back().domain = [](const Inputs& x) {
        const double level = 0.5 * std::log2(x.scalar(0)) - 0.5;
        return x.scalar(0) > 1e-3 && std::abs(level + 0.5 - std::round(level + 0.5)) > 1e-4;
    };
    cases.push_back(
        post("tgPostAdd",
             kView + kGaussians +
                 "TgPostDisc disc = tgPostDisc(view, float2(0.4, 0.6), texel, 50.0, float2(0, 0)); TgPostSum sum = (TgPostSum)0; "
                 "sum.inner = 0.2; tgPostAdd(sum, view, disc, g, float4(2, 2, 2, 0.6), a0, float4(a1, a1, a1, 0.5), float2(25, 0.5)); "
                 "return float4(sum.light.x, sum.weight.x, sum.inner, sum.outside ? 1.0 : 0.0);",
             {linear(0.38, 0.42, 2), linear(0, 2)},
             [](const Inputs& x) {
                 const glm::dvec3 apart = 50.0 * (rayAt(x.vec2(0)) - rayAt({0.4, 0.6}));
                 const double weight = 2 * reflectance(glm::dot(apart, apart));
                 return values(weight * x.scalar(1), weight * 0.5, 0.4, 1);
             },
             {.forward = 64, .backward = 64, .absolute = 1e-5, .why = "an exponential of a squared difference"}));
    cases.push_back(post("tgPostMean",
                         kGaussians + "TgPostSum sum = (TgPostSum)0; sum.light = a0; sum.weight = float3(0.5, 0.5, 0.5); sum.inner = a1; "
                                      "return float4(tgPostMean(sum, g, float3(1, 2, 3)), 0);",
                         {linear(0, 1, 3), linear(0, 4)}, [](const Inputs& x) {
                             const glm::dvec3 mine = share(x.scalar(1) * x.scalar(1)) * kChannels;
                             return values((x.vec3(0) + mine * glm::dvec3(1, 2, 3)) / (0.5 + mine));
                         }));
    cases.back().domain = [](const Inputs& x) { return std::abs(x.scalar(1)) < 9; };
    // Light that is the same everywhere stays so, whatever the samples weigh. The texel is light, depth (z = 5) and kernel at once.
    static const TestMap kEven = oneTexel(5, 1, 1, 1);
    cases.push_back(
        post("tgPostGather",
             kView + kGaussians +
                 "TgPostDisc disc = tgPostDisc(view, float2(0.5, 0.5), texel, 5.0, float2(0, 0)); "
                 "return float4(tgPostGather(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), g, 3.0, a0, view, "
                 "disc, float3(5, 1, 1), a1), 0);",
             {whole(1, 24), linear(0, 1)}, [](const Inputs&) { return values(5, 1, 1); },
             {.forward = 64, .backward = 4, .absolute = 1e-4, .why = "sums of up to 24 weights, over their sum"}));
    cases.back().map = &kEven;
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) >= 1 && x.scalar(0) <= 24; };
    return cases;
}

} // namespace

std::vector<FunctionCase> postCases() {
    return together(masks(), places(), profiles(), sums());
}

} // namespace tegument::test
