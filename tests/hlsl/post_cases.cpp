// hlsl/scatter/post.fxh against the definitions of docs/design/modules/SkinPost.md, for a view and six Gaussians that can be written down.

#include "tests/hlsl/maps.h"

#include <algorithm>
#include <numbers>

namespace tegument::test {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array<double, 6> kWeights = {0.1, 0.15, 0.2, 0.25, 0.2, 0.1};
constexpr std::array<double, 6> kVariances = {0.01, 0.05, 0.2, 0.6, 2, 7};
constexpr dvec2 kPixel = {0.01, 0.02};

/// P(u, v, z) = z (0.8 u - 0.4, 0.3 - 0.6 v, 1).
const std::string kView = "TgPostView view = (TgPostView)0; view.ray = float3(-0.4, 0.3, 1.0); view.rayU = float3(0.8, 0.0, 0.0); "
                          "view.rayV = float3(0.0, -0.6, 0.0); const float2 texel = float2(0.01, 0.02); ";
const std::string kGaussians =
    "float4 g[6]; g[0] = tgPostStored(float4(0.1, 0.05, 0.025, 0.01)); g[1] = tgPostStored(float4(0.15, 0.075, 0.0375, 0.05)); "
    "g[2] = tgPostStored(float4(0.2, 0.1, 0.05, 0.2)); g[3] = tgPostStored(float4(0.25, 0.125, 0.0625, 0.6)); "
    "g[4] = tgPostStored(float4(0.2, 0.1, 0.05, 2.0)); g[5] = tgPostStored(float4(0.1, 0.05, 0.025, 7.0)); ";
const dvec3 kChannels = {1, 0.5, 0.25};

dvec3 rayAt(const dvec2& uv) {
    return {0.8 * uv.x - 0.4, 0.3 - 0.6 * uv.y, 1};
}
dvec3 tangent(const dvec2& uv, const dvec2& way, double z, double slope) {
    return z * dvec3(0.8 * way.x, -0.6 * way.y, 0) + slope * rayAt(uv);
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
    return summed([&](double w, double v) { return w / (2 * kPi * v) * exp(-square / (2 * v)); });
}
double share(double square) {
    return summed([&](double w, double v) { return w * (1 - exp(-square / (2 * v))); });
}
double chance(double square) {
    const double all = summed([](double w, double) { return pow(w, 0.4); });
    return summed([&](double w, double v) { return pow(w, 0.4) * (1 - exp(-square / (2 * v))); }) / all;
}
double radius(double of) {
    double low = 0;
    double high = 32;
    for (int i = 0; i < 60; ++i)
        (chance(0.25 * (low + high) * (low + high)) < of ? low : high) = 0.5 * (low + high);
    return low;
}

FunctionCase post(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    FunctionCase made = check(std::move(call), std::move(arguments), std::move(tolerance), std::move(expected));
    made.samples = 1024;
    return made;
}
FunctionCase post(Call call, Arguments arguments, Reference expected) {
    return post(std::move(call), std::move(arguments), {64, 16, 1e-5, "sums of some products"}, std::move(expected));
}

void masks(Cases& cases) {
    cases += post("tgPostMask(a0, a1).xxxx", {whole(0, 15), linear(0, 1)}, [](In x) {
        const double mask = (round(x[0]) + 0.0625 + 0.875 * saturate(x[1])) / 16;
        return values(mask, mask, mask, mask);
    });
    cases += post({"tgPostCounts", "return float4(tgPostCounts(a0), tgPostCounts(0.0), tgPostCounts(0.001), 0.0);"}, {linear(0.01, 1)},
                  [](In) { return values(1, 0, 0.5); });
    cases.back().domain = [](In x) { return x[0] > 0.003; };
    cases += post("tgPostProfile(tgPostMask(a0, a1)).xxxx", {whole(0, 15), linear(0, 1)}, [](In x) {
        const double profile = round(x[0]);
        return values(profile, profile, profile, profile);
    });
    cases += post("tgPostStrength(tgPostMask(a0, a1)).xxxx", {whole(0, 15), linear(0, 1)}, [](In x) {
        const double strength = saturate(x[1]);
        return values(strength, strength, strength, strength);
    });
}

void places(Cases& cases) {
    const std::string matrix = "const float4x4 from = float4x4(2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, -0.5, -1, -1, 1, 1); ";
    const Argument uv = linear(0, 1, 2);
    const Argument depth = linear(20, 80);
    const Tolerance wide{64, 16, 2e-3, "differences of places some tens of mm away"};
    cases += post({"tgPostUnproject", matrix + "return float4(tgPostUnproject(a0, a1, from, 10.0), 0);"}, {uv, linear(0, 1)},
                  [](In x) { return 10 / (1 - 0.5 * x[1]) * dvec3(2 * x[0] - 1, 3 * x.scalar(0, 1) - 1, 1); });
    cases += post("tgPostRay(float3(a0, 1.0), float3(a1, 3.0))", {linear(-9, 9, 2), linear(-9, 9, 2)},
                  [](In x) { return dvec3(0.5 * (x.vec2(1) - x.vec2(0)), 1); });
    cases += post(
        {"tgPostView", matrix + "TgPostView view = tgPostView(from, 10.0); return float4(view.ray + a0.x * view.rayU + a0.y * view.rayV, "
                                "length(view.origin) + length(view.originU) + length(view.originV));"},
        {uv}, wide, [](In x) { return values(2 * x[0] - 1, 3 * x.scalar(0, 1) - 1, 1, 0); });
    cases += post({"tgPostPlace", kView + "return float4(tgPostPlace(view, a0, a1), 0);"}, {uv, depth},
                  [](In x) { return x[1] * rayAt(x.vec2(0)); });
    cases += post({"tgPostSpread", kView + "return tgPostSpread(view, a0).xxxx;"}, {depth}, [](In x) {
        const double spread = 0.48 * x[0] * x[0];
        return values(spread, spread, spread, spread);
    });
    cases += post({"tgPostSlope", kView + "return float4(tgPostSlope(view, texel, float2(a0, 1), 50.0, float2(a1, 1)), "
                                          "tgPostSlope(view, texel, float2(a0, 0), 50.0, float2(a1, 1)), "
                                          "tgPostSlope(view, texel, float2(a0, 0), 50.0, float2(a1, 0)), 0);"},
                  {linear(35, 65), linear(35, 65)}, [](In x) {
                      const double most = 12 * sqrt(facing(50));
                      const double before = 50 - x[0];
                      const double after = x[1] - 50;
                      const double nearer = abs(before) < abs(after) ? before : after;
                      return values(abs(nearer) < most ? nearer : 0, abs(after) < most ? after : 0, 0);
                  });
    cases.back().domain = [](In x) {
        const double most = 12 * sqrt(facing(50));
        const double before = abs(50 - x[0]);
        const double after = abs(x[1] - 50);
        return abs(before - after) > 1e-3 && abs(before - most) > 1e-3 && abs(after - most) > 1e-3;
    };
    cases += post({"tgPostTangent", kView + "return float4(tgPostTangent(view, a0, float2(texel.x, 0), a1, a2), 0);"},
                  {uv, depth, linear(-2, 2)}, [](In x) {
                      return tangent(x.vec2(0), {kPixel.x, 0}, x[1], x[2]);
                  });
    cases += post({"tgPostGrazing", kView + "return tgPostGrazing(view, a0, texel, a1, a2).xxxx;"}, {uv, depth, linear(-2, 2, 2)},
                  {64, 64, 1e-4, "a cross product over a product"}, [](In x) {
                      const dvec3 right = tangent(x.vec2(0), {kPixel.x, 0}, x[1], x[2]);
                      const dvec3 down = tangent(x.vec2(0), {0, kPixel.y}, x[1], x.scalar(2, 1));
                      const double grazing = std::clamp(length(cross(right, down)) / facing(x[1]), 1.0, 12.0);
                      return values(grazing, grazing, grazing, grazing);
                  });
    cases.back().domain = [](In x) { return x[1] > 1; };
}

void profiles(Cases& cases) {
    static const TestMap kStored = mapOf(64, 16, [](int x, int y) { return texelOf(x, y, x + y, 0.25 * y); });
    static const TestMap kDepths = mapOf(8, 1, [](int x, int) { return texelOf(12.0 * x, 0.25 * x); });
    cases += post("tgPostZ(TG_SAMPLER2D_ARG(gTest), float2((a0 + 0.5) / 8.0, 0.5))", {whole(0, 7)},
                  [](In x) { return round(x[0]) > 0 ? values(48, 1) : values(0, 0); });
    cases.back().map = &kDepths;
    cases += post("tgPostStored(float4(a0, a1))", {linear(0, 1, 3), logarithmic(0.01, 10)},
                  [](In x) { return dvec4(x.vec3(0) / (2 * kPi * x[1]), 0.5 * std::numbers::log2e / x[1]); });
    cases.back().domain = [](In x) { return x[1] > 1e-3; };
    cases += post({"tgPostReflectance", kGaussians + "return float4(tgPostReflectance(g, a0), 0);"}, {linear(0, 40)},
                  [](In x) { return reflectance(x[0]) * kChannels; });
    cases.back().domain = [](In x) { return x[0] >= 0 && x[0] < 100; };
    cases += post({"tgPostShare", kGaussians + "return float4(tgPostShare(g, a0), 0);"}, {linear(0, 40)},
                  [](In x) { return share(x[0]) * kChannels; });
    cases.back().domain = [](In x) { return x[0] >= 0 && x[0] < 100; };
    cases += post({"tgPostRead", "float4 g[6]; tgPostRead(TG_SAMPLER2D_ARG(gTest), a0, g); return g[1] + 10.0 * g[5];"}, {whole(0, 15)},
                  [](In x) {
                      const double y = round(x[0]); // eight texels lie over the 64 of the map
                      return values(12 + 440, 11 * y, 452 + 11 * y, 11 * 0.25 * y);
                  });
    cases.back().map = &kStored;
    cases += post("tgPostTapOf(TG_SAMPLER2D_ARG(gTest), a0, a1)", {whole(0, 15), whole(0, 63)}, [](In x) {
        const double row = round(x[0]);
        const double i = round(x[1]);
        return values(i, row, i + row, 0.25 * row);
    });
    cases.back().map = &kStored;
    cases += post({"tgPostChance", kGaussians + "return tgPostChance(g, a0).xxxx;"}, {linear(0, 40)}, [](In x) {
        const double c = chance(x[0]);
        return values(c, c, c, c);
    });
    cases.back().domain = [](In x) { return x[0] >= 0 && x[0] < 100; };
    cases += post({"tgPostRadius", kGaussians + "return tgPostRadius(g, a0).xxxx;"}, {linear(0.05, 0.95)},
                  {4096, 64, 1e-4, "24 halvings of 32 mm, of sums of six exponentials"}, [](In x) {
                      const double r = radius(x[0]);
                      return values(r, r, r, r);
                  });
    cases.back().domain = [](In x) { return x[0] > 0.02 && x[0] < 0.98; };
    cases += post({"tgPostTap", kGaussians + "return tgPostTap(g, a0, 24.0);"}, {whole(0, 23)},
                  {1 << 16, 4, 1e-4, "radii are found by halving, 2e-6 mm of some hundredths"}, [](In x) {
                      const double i = round(x[0]);
                      const double inner = i > 0 ? radius(i / 24) : 0;
                      const double outer = i + 1.5 < 24 ? radius((i + 1) / 24) : 32;
                      const double middle = radius((i + 0.5) / 24);
                      const double far = min(outer, 2 * middle - inner);
                      const double area = kPi * (far * far - inner * inner);
                      const dvec3 ring(min((share(outer * outer) - share(inner * inner)) / reflectance(middle * middle), 4 * area));
                      return dvec4(ring, middle);
                  });
    cases.back().domain = [](In x) { return x[0] >= 0 && x[0] <= 23; };
}

void sums(Cases& cases) {
    const std::string disc = kView + "TgPostDisc disc = tgPostDisc(view, float2(0.4, 0.6), texel, 50.0, a0); ";
    const std::string flat = "TgPostDisc disc = (TgPostDisc)0; disc.uv = float2(0.4, 0.6); disc.steps = float3(0.02, -0.003, 0.025); "
                             "disc.level = -0.5; disc.coarsest = 6; ";
    struct Disc {
        double area, wide;
        dvec2 rise; // of a row, along the axes
        explicit Disc(const dvec2& slope) {
            const dvec3 right = tangent({0.4, 0.6}, {kPixel.x, 0}, 50, slope.x);
            const dvec3 down = tangent({0.4, 0.6}, {0, kPixel.y}, 50, slope.y);
            area = length(cross(right, down));
            wide = length(right);
            const dvec3 axisU = right / wide;
            rise = {dot(down, axisU), dot(down, cross(cross(right, down) / area, axisU))};
        }
    };
    const Tolerance products{64, 64, 1e-5, "products of vectors"};
    cases += post({"tgPostDisc", disc + "return float4(disc.area, disc.share, disc.level, 0);"}, {linear(-1, 1, 2)}, products, [](In x) {
        const Disc d(x.vec2(0));
        return values(d.area, kPixel.x * kPixel.y / d.area, -0.5 * log2(d.area) - 1, 0);
    });
    cases += post({"tgPostDisc", disc + "return float4(disc.steps, 0);"}, {linear(-1, 1, 2)}, products, [](In x) {
        const Disc d(x.vec2(0));
        return values(kPixel.x / d.wide, -d.rise.x / d.rise.y * kPixel.x / d.wide, kPixel.y / d.rise.y, 0);
    });
    cases += post(
        {"tgPostWithin", "TgPostDisc disc = (TgPostDisc)0; disc.area = a0; return tgPostWithin(disc, float4(0, 0, 0, a1)) ? 1.0 : 0.0;"},
        {linear(0.1, 2), linear(0, 1)}, [](In x) {
            const double within = kPi * x[1] * x[1] < 0.5 * x[0] ? 1 : 0;
            return values(within, within, within, within);
        });
    cases.back().domain = [](In x) { return abs(kPi * x[1] * x[1] - 0.5 * x[0]) > 1e-4; };
    cases += post("tgPostFirst(a0)", {linear(0, 1)}, [](In x) { return values(cos(2 * kPi * x[0]), sin(2 * kPi * x[0])); });
    cases += post(
        {"tgPostNext",
         "float2 way = float2(1.0, 0.0); [loop] for (float i = 0.0; i < a0; i += 1.0) way = tgPostNext(way); return float4(way, 0, 0);"},
        {whole(0, 63)}, {64, 16, 2e-5, "up to 63 turns, each rounded to 24 bits"}, [](In x) {
            const double angle = kPi * (3 - sqrt(5.0)) * round(x[0]);
            return values(cos(angle), sin(angle));
        });
    cases.back().domain = [](In x) { return x[0] >= 0; };
    cases += post({"tgPostTarget", flat + "return float4(tgPostTarget(disc, float4(a0, 0, 0, a1), a2), 0);"},
                  {logarithmic(0.1, 100), linear(0, 10), linear(-1, 1, 2)}, [](In x) {
                      const dvec2 at = x[1] * x.vec2(2);
                      const double level = round(std::clamp(0.5 * log2(x[0]) - 0.5, 0.0, 6.0));
                      return values(0.4 + 0.02 * at.x - 0.003 * at.y, 0.6 + 0.025 * at.y, level);
                  });
    cases.back().domain = [](In x) {
        const double level = 0.5 * log2(x[0]) - 0.5;
        return x[0] > 1e-3 && abs(level + 0.5 - round(level + 0.5)) > 1e-4;
    };
    cases +=
        post({"tgPostAdd",
              kView + kGaussians +
                  "TgPostDisc disc = tgPostDisc(view, float2(0.4, 0.6), texel, 50.0, float2(0, 0)); TgPostSum sum = (TgPostSum)0; "
                  "sum.inner = 0.2; tgPostAdd(sum, view, disc, g, float4(2, 2, 2, 0.6), a0, float4(a1, a1, a1, 0.5), float2(25, 0.5)); "
                  "return float4(sum.light.x, sum.weight.x, sum.inner, sum.outside ? 1.0 : 0.0);"},
             {linear(0.38, 0.42, 2), linear(0, 2)}, {64, 64, 1e-5, "an exponential of a squared difference"}, [](In x) {
                 const dvec3 apart = 50.0 * (rayAt(x.vec2(0)) - rayAt({0.4, 0.6}));
                 const double weight = 2 * reflectance(dot(apart, apart));
                 return values(weight * x[1], weight * 0.5, 0.4, 1);
             });
    cases += post({"tgPostMean", kGaussians +
                                     "TgPostSum sum = (TgPostSum)0; sum.light = a0; sum.weight = float3(0.5, 0.5, 0.5); sum.inner = a1; "
                                     "return float4(tgPostMean(sum, g, float3(1, 2, 3)), 0);"},
                  {linear(0, 1, 3), linear(0, 4)}, [](In x) {
                      const dvec3 mine = share(x[1] * x[1]) * kChannels;
                      return (x.vec3(0) + mine * dvec3(1, 2, 3)) / (0.5 + mine);
                  });
    cases.back().domain = [](In x) { return abs(x[1]) < 9; };
    cases += post({"tgPostBeyond", kGaussians +
                                       "TgPostSum sum = (TgPostSum)0; sum.light = a0; sum.weight = float3(0.5, 0.5, 0.5); sum.inner = a1; "
                                       "return tgPostBeyond(sum, g);"},
                  {linear(0, 1, 3), linear(0, 4)}, [](In x) {
                      const dvec3 mine = share(x[1] * x[1]) * kChannels;
                      return dvec4(x.vec3(0) / 0.5 * (1.0 - mine), 1 + x[1] * x[1]);
                  });
    cases.back().domain = [](In x) { return abs(x[1]) < 9; };
    // Light that is the same everywhere stays so, whatever the samples weigh. The texel is light, depth (z = 5) and kernel at once.
    static const TestMap kEven = oneTexel(5, 1, 1, 1);
    cases +=
        post({"tgPostGather",
              kView + kGaussians +
                  "TgPostDisc disc = tgPostDisc(view, float2(0.5, 0.5), texel, 5.0, float2(0, 0)); "
                  "return float4(tgPostGather(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), g, 3.0, a0, view, "
                  "disc, float3(5, 1, 1), a1), 0);"},
             {whole(1, 24), linear(0, 1)}, {64, 4, 1e-4, "sums of up to 24 weights, over their sum"}, [](In) { return values(5, 1, 1); });
    cases.back().map = &kEven;
    cases.back().domain = [](In x) { return x[0] >= 1 && x[0] <= 24; };
    cases += post(
        {"tgPostSums",
         kView + kGaussians +
             "TgPostDisc disc = tgPostDisc(view, float2(0.5, 0.5), texel, 5.0, float2(0, 0)); "
             "TgPostSum sum = tgPostSums(TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), TG_SAMPLER2D_ARG(gTest), g, 3.0, a0, view, "
             "disc, a1); return float4(sum.light / max(sum.weight, 1e-9), sum.outside ? 1.0 : 0.0);"},
        {whole(1, 24), linear(0, 1)}, {64, 4, 1e-4, "sums of up to 24 weights, over their sum"}, [](In) { return values(5, 1, 1, 1); });
    cases.back().map = &kEven;
    cases.back().domain = [](In x) { return x[0] >= 1 && x[0] <= 24; };
}

} // namespace

Cases postCases() {
    return together(masks, places, profiles, sums);
}

} // namespace tegument::test
