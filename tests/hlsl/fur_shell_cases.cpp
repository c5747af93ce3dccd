// Shells (effects/passes/fur_shell.fxh), their light (fur_coat.fxh), and the shadow of their hull (fur_shadow.fxh) in double precision.

#include "tests/hlsl/fur_light.h"
#include "tests/hlsl/maps.h"

#include <algorithm>

namespace tegument::test {

namespace {

constexpr double kSpread = 0.8;
constexpr double kSoft = 0.2;
constexpr double kTaper = 0.7;
constexpr double kDeviation = 0.1;
constexpr double kGrain = 0.006;
constexpr double kOuter = 0.3; // between its two values: both kinds of coverage show
constexpr double kHullHeight = 0.65;
constexpr double kHullShadow = 0.8;
/// Every map but that of shadows is one texel: distance of the hull's back and how thick it is, mm.
constexpr std::array<float, 4> kHullTexel = {450, 6, 0.5F, 0.25F};

FunctionCase shellCase(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    static const TestMap kHull{.size = 1, .texels = {kHullTexel}};
    const Globals more = {{"gFurLayers", {32}},      {"gFurSpread", {kSpread}},       {"gFurSoftness", {kSoft}},
                          {"gFurTaper", {kTaper}},   {"gFurDeviation", {kDeviation}}, {"gFurGrain", {kGrain}},
                          {"gFurAlphaTest", {0.02}}, {"gFurShadow", {kHullShadow}},   {"gFurShadowHeight", {kHullHeight}}};
    FunctionCase made =
        passCase("Fur.fx", with(furScene(), more), std::move(call), std::move(arguments), std::move(tolerance), std::move(expected));
    made.map = &kHull;
    made.maps = {{"gShadowMap", oneTexel(0)}};
    return made;
}

/// A point of the coat that no surface shadows.
struct Lit {
    dvec3 normal, world, albedo;
    double height = 0;
    double strands = 1; // share of what is lit that they are
    double passed = 1;

    [[nodiscard]] dvec3 strand() const { return normalize(normal + 2 * height * kFurLean * kFurDown); }
    [[nodiscard]] dvec3 toEye() const { return normalize(kFurEye - world); }

    [[nodiscard]] dvec3 by(const dvec3& toLight, const dvec3& colour) const {
        const double cosine = dot(normal, toLight);
        const dvec3 dull = albedo * max(cosine, 0.0);
        const double open = 1 - kFurStrands + kFurStrands * coatLeaves(height, cosine);
        return mix(dull, strandsLit(albedo, strand(), toLight, toEye()), kFurStrands * strands) * colour * open;
    }
    [[nodiscard]] dvec3 radiance() const {
        return passed * by(normalize(kFurLamp - world), kFurColour) + albedo * kFurAround * coatFilled(height);
    }
    [[nodiscard]] dvec3 lamps() const {
        dvec3 sum(0);
        for (std::size_t i = 0; i < kFurLampWays.size(); ++i)
            sum += by(kFurLampWays[i], kFurLampColours[i]);
        return sum;
    }
    /// From where sines of small angles and horizons would decide.
    [[nodiscard]] bool plain() const {
        return isUnit(normal) && length(normal + 2 * height * kFurLean * kFurDown) > 0.3 &&
               abs(dot(strand(), normalize(kFurLamp - world))) < 0.999;
    }
};

const Tolerance kLitTolerance{64, 8, 1e-3, "sines are roots of differences; the 40th power of a cosine"};

/// Arguments: normal of the mesh, place in the world, height, albedo, share of strands, what passed.
Lit litAt(In x) {
    return {furTurned(x.vec3(0)), x.vec3(1), x.vec3(3), x[2], x[4], x[5]};
}

constexpr const char* kLitBody = "FurVarying v = (FurVarying)0; v.normal = a0; v.world = a1; v.coat = float4(a2, 0.3, 0.4, 1); "
                                 "v.lightClip = float4(0, 0, 0.5, 1); ";

void radiances(Cases& cases) {
    const Arguments arguments = {unit(), linear(-80, 80, 3), linear(0, 1), linear(0, 1, 3), linear(0, 1), linear(0, 1)};
    const auto plain = [](In x) { return litAt(x).plain(); };
    cases += shellCase({"furRadiance", std::string(kLitBody) + "return float4(furRadiance(v, a3, a4, a5), 0);"}, arguments, kLitTolerance,
                       [](In x) { return litAt(x).radiance(); });
    cases.back().domain = plain;
    cases += shellCase({"furRadiance", std::string(kLitBody) + "return float4(furRadiance(v, a3, a4, a5), 0);"}, arguments, kLitTolerance,
                       [](In x) { return litAt(x).radiance() + litAt(x).lamps(); });
    addLamps(cases.back());
    cases.back().tolerance.absolute = 4e-3; // of each of three lamps, too
    cases.back().domain = plain;
    cases += shellCase({"furAlbedo", std::string(kLitBody) + "return float4(furAlbedo(v), 0);"}, arguments,
                       {8, 2, 0, "a mixture and a product"}, [](In x) { return mix(kFurDark, kFurPale, x[2]) * dvec3(0.75, 0.5, 0.25); });
    cases.back().maps["gFurColorMap"] = oneTexel(0.75, 0.5, 0.25, 1);
    cases.back().defines.emplace_back("TEGUMENT_FUR_COLOR_MAP", "1");
    // in the printed settings of z / w
    cases += shellCase({"furShadowTolerance", "return float4(a0 * furShadowTolerance(), 0, 0, 0);"}, {linear(1, 2)},
                       {4, 1, 0, "products and a quotient"},
                       [](In x) { return x[0] * 0.005 * kFurMesh * (x.corrected() ? kFurUnit : 1.0 / 400); });
    cases.back().settings = {0, 2};
}

/// What the light has passed of the hull of others before it comes to a point (docs/design/fur.md), piece by piece.
double hullLeaves(const dvec3& world, const dvec3& normal, double height) {
    const double coat = kFurLength * kFurMesh * kFurUnit;
    const double back = kHullTexel[0];
    const double front = back - static_cast<double>(kHullTexel[1]);
    const double place = furFromLamp(world) - max(height - kHullHeight, 0.0) * coat;
    const double own = wayThroughCoat(height, dot(normal, normalize(kFurLamp - world)));
    const double inside = (place - front) / coat - 1.25 * own - 0.25;
    const double foreign = mix(inside, (back - front) / coat, share(4 * (place - back) / coat));
    return exp(-kFurDense * kHullShadow * max(foreign, 0.0));
}

void hulls(Cases& cases) {
    const Arguments arguments = {unit(), linear(-20, 20, 3), linear(0, 1)};
    const char* made = "FurVarying v = (FurVarying)0; v.normal = a0; v.world = a1; v.coat = float4(a2, 0, 0, 1); v.lightClip = 1; ";
    const auto cosine = [](In x) { return dot(furTurned(x.vec3(0)), normalize(kFurLamp - x.vec3(1))); };
    const Tolerance lengths{8, 2, 1e-4, "differences of lengths of 450"};
    cases += shellCase({"HullFrontPS", std::string(made) + "return HullFrontPS(v);"}, arguments, lengths,
                       [](In x) { return values(furFromLamp(x.vec3(1)), 0, 0, 1); });
    cases += shellCase({"HullBackPS", std::string(made) + "return HullBackPS(v);"}, arguments, lengths, [=](In x) {
        const double distance = furFromLamp(x.vec3(1));
        return cosine(x) > 0 ? kDiscarded : values(distance, max(distance - kHullTexel[0], 0.0), 0, 1);
    });
    cases.back().discards = true;
    cases.back().domain = [=](In x) { return isUnit(x.vec3(0)) && abs(cosine(x)) > 1e-5; };
    cases += shellCase({"furHullShadow", std::string(made) + "return float4(furHullShadow(v), 0, 0, 0);"}, arguments,
                       {32, 4, 1e-3, "differences of 450 mm by a coat of 7.2"},
                       [](In x) { return hullLeaves(x.vec3(1), furTurned(x.vec3(0)), x[2]); });
    cases.back().domain = [](In x) { return isUnit(x.vec3(0)); };
}

/// A vertex: normal and place in the mesh.
constexpr const char* kVertexBody = "TgVertexInput i = (TgVertexInput)0; i.normal = a0; i.position = a1; i.uv = float2(0.3, 0.4); ";

dvec3 placeInCoat(const dvec3& position, const dvec3& normal, double height) {
    return furWorld(position) + (furTurned(normal) + kFurLean * height * kFurDown) * (kFurLength * kFurMesh * height);
}

/// Over the skin, while a ray falls by the coat's height.
double wayOver(const dvec3& world, const dvec3& normal, double height) {
    const dvec3 view = normalize(world - kFurEye);
    const dvec3 strand = normal + 2 * height * kFurLean * kFurDown;
    return length(view * (dot(strand, normal) / -dot(view, normal)) + strand) * kFurLength * kFurMesh;
}

bool seesEye(const dvec3& world, const dvec3& normal) {
    return isUnit(normal) && dot(normal, normalize(kFurEye - world)) > 0.1;
}

double layerHeight(double layer) {
    return pow(layer / 32, kSpread);
}

void vertices(Cases& cases) {
    const Arguments arguments = {unit(), linear(-40, 40, 3), whole(0, 31)};
    const auto world = [](In x) { return placeInCoat(x.vec3(1), x.vec3(0), layerHeight(round(x[2]) + 1)); };
    cases += shellCase({"shellVarying", std::string(kVertexBody) + "FurVarying v = shellVarying(i, a2, -1.0); "
                                                                   "return float4(v.coat.xw, furRound(v), v.world.x);"},
                       arguments, {32, 2, 2e-5, "powers; sums of up to 90"}, [=](In x) {
                           const double layer = round(x[2]);
                           return values(layerHeight(layer + 1), layerHeight(layer + 2), -1, world(x).x);
                       });
    cases.back().domain = [](In x) { return isUnit(x.vec3(0)); };
    const auto vertexLight = [&](const char* returned, auto expected) {
        cases += shellCase(
            {"shellVarying", std::string(kVertexBody) + "FurVarying v = shellVarying(i, a2, 1.0); return float4(" + returned + ");"},
            arguments, kLitTolerance, [=](In x) {
                const dvec3 normal = furTurned(x.vec3(0));
                const double height = layerHeight(round(x[2]) + 1);
                return expected(Lit{normal, world(x), dvec3(0), height, 1, hullLeaves(world(x), normal, height)});
            });
        cases.back().tolerance.absolute = 3e-3;
        cases.back().tolerance.why = "the same, and a hull's shadow to 1e-3";
        cases.back().defines.emplace_back("TEGUMENT_FUR_VERTEX_LIGHT", "1");
        cases.back().domain = [=](In x) {
            const dvec3 normal = furTurned(x.vec3(0));
            return seesEye(world(x), normal) && Lit{normal, world(x), dvec3(0), layerHeight(round(x[2]) + 1)}.plain();
        };
    };
    vertexLight("v.mirrored.rgb, v.mirrored.w / 100.0",
                [](const Lit& black) { return values(dvec4(black.radiance(), wayOver(black.world, black.normal, black.height) / 100)); });
    vertexLight("v.lit, 0", [](const Lit& black) {
        Lit white = black;
        white.albedo = dvec3(1);
        return values(white.radiance() - black.radiance());
    });
    cases += shellCase({"CoatEndVS", std::string(kVertexBody) + "FurVarying v = CoatEndVS(i); "
                                                                "return float4(v.coat.xw, furRound(v) + a2, v.world.y);"},
                       arguments, {8, 2, 2e-5, "sums of up to 90"},
                       [](In x) { return values(1, 1, 1 + x[2], placeInCoat(x.vec3(1), x.vec3(0), 1).y); });
    cases.back().domain = [](In x) { return isUnit(x.vec3(0)); };
    cases += shellCase({"shellWay", std::string(kLitBody) + "return float4(shellWay(v), 0, 0, 0);"},
                       {unit(), linear(-80, 80, 3), linear(0, 1)}, {64, 4, 1e-3, "a quotient by a cosine of 0.1 and more, 4.8 times"},
                       [](In x) { return wayOver(x.vec3(1), furTurned(x.vec3(0)), x[2]); });
    cases.back().domain = [](In x) { return seesEye(x.vec3(1), furTurned(x.vec3(0))); };
}

/// docs/design/fur.md, "Seen from afar": of logistic heights.
double meanCoverage(double mean, double height, double above, double variance, double slope) {
    const double scale = sqrt(3 * variance) / std::numbers::pi + 1e-4;
    const double tip = mean + kSoft * (0.5 - min(0.2 / sqrt(kSoft), 1.0));
    const auto shorter = [&](double h) { return 1 / (1 + exp(std::clamp((tip - h) / scale, -60.0, 60.0))); };
    const double taller = 1 - shorter(height);
    const double entered = 1 - pow(shorter(height) / shorter(above), 0.5 + hypot(0.5, slope / std::numbers::pi));
    const double both = entered * entered * entered + taller * taller * taller;
    return both < 1e-20 ? 0 : entered * taller / std::cbrt(both);
}

/// Arguments: heights of the layer and how much higher the next is, sides of a pixel, slope, round, alpha.
struct Shell {
    double tested, drawn;

    explicit Shell(In x) {
        const double height = x[0];
        const double alpha = x[5];
        const double square = pow(sqrt(3.0) * 0.98149546 * x[2], 2); // 1.7
        const double variance = min(kDeviation * kDeviation * square / (square + kGrain * kGrain), alpha * alpha);
        const double afar = 12 * variance / (12 * variance + 0.36 * kSoft * kSoft) * kTaper * (1 - kOuter);
        const double mean = meanCoverage(alpha, height, height + x[1], variance, x[3]);
        const double coverage = mix(alpha, min(share((alpha - height) / kSoft + 0.5), share(1e4 * alpha)), kTaper);
        tested = x[4] < 0 ? -1 : mix(coverage - kOuter / 2, mean - 0.002, afar);
        drawn = max(mix(coverage, mean, afar), kOuter); // of 32 layers coverage is what it is
    }
};

void pixels(Cases& cases) {
    const Arguments arguments = {linear(0, 1), linear(0.01, 0.1), logarithmic(1e-4, 0.1), linear(0, 10), linear(-1, 1), linear(0.05, 1)};
    const char* made = "FurVarying v = (FurVarying)0; v.coat = float4(a0, 0, 0, a0 + a1); v.lit = float3(0.5, 0.6, 0.7); v.mirrored = 0.1; "
                       "ShellPixel own; own.sides = float2(a2, 2.0 * a2); own.slope = a3; own.left = a4; float left; "
                       "float4 color = shell(v, own, float4(0.9, 0.8, 0.7, a5), left); ";
    cases += shellCase({"shell", std::string(made) + "return float4(left, color.w, color.rg);"}, arguments,
                       {32, 8, 5e-4, "powers of quotients of exponentials"}, [](In x) {
                           const Shell s(x);
                           const dvec3 albedo = mix(kFurDark, kFurPale, x[0]) * dvec3(0.9, 0.8, 0.7);
                           const dvec3 lit = albedo * dvec3(0.5, 0.6, 0.7) + 0.1;
                           const double seen = s.tested >= 0 ? 1 : 0;
                           return values(s.tested, s.drawn, seen * lit.x, seen * lit.y);
                       });
    cases.back().globals["gFurOuterFirst"] = {kOuter};
    cases.back().defines.emplace_back("TEGUMENT_FUR_VERTEX_LIGHT", "1");
    cases.back().domain = [](In x) { return abs(Shell(x).tested) > 1e-3 && x[2] >= 1e-4; };
    const Arguments plane = {linear(-1, 1, 3), vector(3, 1e-3, 1), vector(3, 1e-3, 1), linear(0.1, 2)};
    const char* across = "float2 q = fmod(pixel, 2.0); float3 v = a0 + q.x * a1 + q.y * a2; ";
    const auto quad = [&](Call call, Reference expected) {
        call.body = across + call.body;
        cases += shellCase(std::move(call), plane, {8, 2, 2e-6, "differences of numbers up to 2"}, std::move(expected));
        cases.back().perQuad = true;
        cases.back().domain = [](In x) { // where neither a direction nor a difference is lost
            const double less = min(length(x.vec3(1)), length(x.vec3(2)));
            return less > 1e-3 && length(x.vec3(0)) < 4;
        };
    };
    quad({"shellSides", "return float4(shellSides(v), 0, 0);"}, [](In x) {
        const double less = min(length(x.vec3(1)), length(x.vec3(2)));
        const double more = max(length(x.vec3(1)), length(x.vec3(2)));
        return values(max(less, more / 100), more);
    });
    quad({"shellSlope",
          "FurVarying i = (FurVarying)0; i.plainRest.xyz = v; i.mirrored.w = 3.0; return float4(1e-3 * shellSlope(i, a3), 0, 0, 0);"},
         [](In x) {
             const double more = max(length(x.vec3(1)), length(x.vec3(2)));
             return 1e-3 * 2.8 * kDeviation / kGrain * x[3] * 3 / more;
         });
    cases.back().tolerance = {8, 2, 0.2, "a quotient of up to 280 by differences that are 4e-4 off"};
    cases.back().defines.emplace_back("TEGUMENT_FUR_VERTEX_LIGHT", "1");
    cases += shellCase("shellShrink(float2(a0, a1))", {linear(0.01, 1), linear(0.5, 1)}, {4, 1, 0, "a quotient"},
                       [](In x) { return max(x[0] / x[1], 0.01); });
    cases.push_back(cases.back());
    cases.back().globals["gFurDeviation"] = {0};
    cases.back().expected = [](In) { return 1; };
    cases += shellCase({"CoatEndPS", "FurVarying v = (FurVarying)0; v.world = a0; return CoatEndPS(v);"}, {linear(-80, 80, 3)},
                       {8, 2, 0, "an inverse root"}, [](In x) { return values(1 / length(x.vec3(0) - kFurEye), 0, 0, 1); });
    cases += shellCase("furInRound(a0, float2(3.5, 4.5), a1)", {linear(0, 2), linear(-1, 1)}, {2, 1, 1e-7, "a difference"},
                       [](In x) { return (x[0] - 0.75) * x[1]; });
    cases.back().maps["gCoatEndMap"] = oneTexel(0.75);
}

/// A cube whose alpha tells the level that it was read from.
const TestMap& leveledCube() {
    static const TestMap kMap = leveledMap(true, [](int mip) { return texelOf(1, 1, 1, 0.1 * (mip + 1)); });
    return kMap;
}

/// Of a pixel that covers the map by a0 and a1 radians: the level of its shorter side, which here is the nearest one.
FunctionCase cubes() {
    const auto levelOf = [](In x) { return log2(128 * max(min(x[0], x[1]), 1.0 / 128)); };
    FunctionCase made = shellCase(
        {"cubeShell",
         "float2 q = fmod(pixel, 2.0); FurVarying v = (FurVarying)0; v.coat = float4(0.5, 0, 0, 0.6); v.world = 1.0; v.plainRest.w = 1; "
         "return float4(cubeShell(v, float2(3.5, 4.5), float3(0, 0, 1), float3(q.x * a0, q.y * a1, 1)).w, 0, 0, 0);"},
        {linear(0.02, 0.4), linear(0.02, 0.4)}, {8, 0, 1e-6, "a level's own number"}, [=](In x) { return 0.1 * (1 + round(levelOf(x))); });
    made.maps["gFurCubeMap"] = &leveledCube();
    made.maps["gCoatEndMap"] = oneTexel(0);
    setAll(made, {"gFurTaper", "gFurAlphaTest", "gFurCurl"}, {0});
    made.defines.emplace_back("TEGUMENT_FUR_VERTEX_LIGHT", "1");
    made.perQuad = true;
    made.domain = [=](In x) { // a device may round the level to an eighth and more
        return abs(levelOf(x) - floor(levelOf(x)) - 0.5) > 0.15;
    };
    return made;
}

} // namespace

Cases furShellCases() {
    return together(cubes(), radiances, hulls, vertices, pixels);
}

} // namespace tegument::test
