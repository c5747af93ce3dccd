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

FunctionCase shellCase(const char* function, std::string body, std::vector<Argument> arguments,
                       std::function<Values(const Inputs&)> expected, Tolerance tolerance) {
    static const TestMap kHull{.size = 1, .texels = {kHullTexel}};
    const Globals more = {{"gFurLayers", {32}},      {"gFurSpread", {kSpread}},       {"gFurSoftness", {kSoft}},
                          {"gFurTaper", {kTaper}},   {"gFurDeviation", {kDeviation}}, {"gFurGrain", {kGrain}},
                          {"gFurAlphaTest", {0.02}}, {"gFurShadow", {kHullShadow}},   {"gFurShadowHeight", {kHullHeight}}};
    FunctionCase made = passCase("Fur.fx", with(furScene(), more), function, std::move(body), std::move(arguments), std::move(expected),
                                 std::move(tolerance));
    made.map = &kHull;
    made.maps = {{"gShadowMap", oneTexel(0)}};
    return made;
}

/// A point of the coat that no surface shadows.
struct Lit {
    glm::dvec3 normal, world, albedo;
    double height = 0;
    double strands = 1; // share of what is lit that they are
    double passed = 1;

    [[nodiscard]] glm::dvec3 strand() const { return glm::normalize(normal + 2 * height * kFurLean * kFurDown); }
    [[nodiscard]] glm::dvec3 toEye() const { return glm::normalize(kFurEye - world); }

    [[nodiscard]] glm::dvec3 by(const glm::dvec3& toLight, const glm::dvec3& colour) const {
        const double cosine = glm::dot(normal, toLight);
        const glm::dvec3 dull = albedo * std::max(cosine, 0.0);
        const double open = 1 - kFurStrands + kFurStrands * coatLeaves(height, cosine);
        return glm::mix(dull, strandsLit(albedo, strand(), toLight, toEye()), kFurStrands * strands) * colour * open;
    }
    [[nodiscard]] glm::dvec3 radiance() const {
        return passed * by(glm::normalize(kFurLamp - world), kFurColour) + albedo * kFurAround * coatFilled(height);
    }
    [[nodiscard]] glm::dvec3 lamps() const {
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < kFurLampWays.size(); ++i)
            sum += by(kFurLampWays[i], kFurLampColours[i]);
        return sum;
    }
    /// From where sines of small angles and horizons would decide.
    [[nodiscard]] bool plain() const {
        return isUnit(normal) && glm::length(normal + 2 * height * kFurLean * kFurDown) > 0.3 &&
               std::abs(glm::dot(strand(), glm::normalize(kFurLamp - world))) < 0.999;
    }
};

const Tolerance kLitTolerance{
    .forward = 64, .backward = 8, .absolute = 1e-3, .why = "sines are roots of differences; the 40th power of a cosine"};

/// Arguments: normal of the mesh, place in the world, height, albedo, share of strands, what passed.
Lit litAt(const Inputs& x) {
    return {furTurned(x.vec3(0)), x.vec3(1), x.vec3(3), x.scalar(2), x.scalar(4), x.scalar(5)};
}

constexpr const char* kLitBody = "FurVarying v = (FurVarying)0; v.normal = a0; v.world = a1; v.coat = float4(a2, 0.3, 0.4, 1); "
                                 "v.lightClip = float4(0, 0, 0.5, 1); ";

std::vector<FunctionCase> radiances() {
    const std::vector<Argument> arguments = {unit(), linear(-80, 80, 3), linear(0, 1), linear(0, 1, 3), linear(0, 1), linear(0, 1)};
    const auto plain = [](const Inputs& x) { return litAt(x).plain(); };
    std::vector<FunctionCase> cases;
    cases.push_back(shellCase(
        "furRadiance", std::string(kLitBody) + "return float4(furRadiance(v, a3, a4, a5), 0);", arguments,
        [](const Inputs& x) { return values(litAt(x).radiance()); }, kLitTolerance));
    cases.back().domain = plain;
    cases.push_back(shellCase(
        "furRadiance", std::string(kLitBody) + "return float4(furRadiance(v, a3, a4, a5), 0);", arguments,
        [](const Inputs& x) { return values(litAt(x).radiance() + litAt(x).lamps()); }, kLitTolerance));
    addLamps(cases.back());
    cases.back().tolerance.absolute = 4e-3; // of each of three lamps, too
    cases.back().domain = plain;
    cases.push_back(
        shellCase("furAlbedo", std::string(kLitBody) + "return float4(furAlbedo(v), 0);", arguments,
                  [](const Inputs& x) { return values(glm::mix(kFurDark, kFurPale, x.scalar(2)) * glm::dvec3(0.75, 0.5, 0.25)); },
                  {.forward = 8, .backward = 2, .why = "a mixture and a product"}));
    cases.back().maps["gFurColorMap"] = oneTexel(0.75, 0.5, 0.25, 1);
    cases.back().defines.emplace_back("TEGUMENT_FUR_COLOR_MAP", "1");
    cases.push_back(shellCase("furShadowTolerance", "return float4(a0 * furShadowTolerance(), 0, 0, 0);", {linear(1, 2)},
                              [](const Inputs& x) { // in the printed settings of z / w
                                  return values(x.scalar(0) * 0.005 * kFurMesh * (x.corrected() ? kFurUnit : 1.0 / 400));
                              },
                              {.forward = 4, .backward = 1, .why = "products and a quotient"}));
    cases.back().settings = {0, 2};
    return cases;
}

/// What the light has passed of the hull of others before it comes to a point (docs/design/fur.md), piece by piece.
double hullLeaves(const glm::dvec3& world, const glm::dvec3& normal, double height) {
    const double coat = kFurLength * kFurMesh * kFurUnit;
    const double back = kHullTexel[0];
    const double front = back - static_cast<double>(kHullTexel[1]);
    const double place = furFromLamp(world) - std::max(height - kHullHeight, 0.0) * coat;
    const double own = wayThroughCoat(height, glm::dot(normal, glm::normalize(kFurLamp - world)));
    const double inside = (place - front) / coat - 1.25 * own - 0.25;
    const double foreign = glm::mix(inside, (back - front) / coat, share(4 * (place - back) / coat));
    return std::exp(-kFurDense * kHullShadow * std::max(foreign, 0.0));
}

std::vector<FunctionCase> hulls() {
    const std::vector<Argument> arguments = {unit(), linear(-20, 20, 3), linear(0, 1)};
    const char* made = "FurVarying v = (FurVarying)0; v.normal = a0; v.world = a1; v.coat = float4(a2, 0, 0, 1); v.lightClip = 1; ";
    const auto cosine = [](const Inputs& x) { return glm::dot(furTurned(x.vec3(0)), glm::normalize(kFurLamp - x.vec3(1))); };
    const Tolerance lengths{.forward = 8, .backward = 2, .absolute = 1e-4, .why = "differences of lengths of 450"};
    std::vector<FunctionCase> cases;
    cases.push_back(shellCase(
        "HullFrontPS", std::string(made) + "return HullFrontPS(v);", arguments,
        [](const Inputs& x) { return values(furFromLamp(x.vec3(1)), 0, 0, 1); }, lengths));
    cases.push_back(shellCase(
        "HullBackPS", std::string(made) + "return HullBackPS(v);", arguments,
        [=](const Inputs& x) {
            const double distance = furFromLamp(x.vec3(1));
            return cosine(x) > 0 ? kDiscarded : values(distance, std::max(distance - kHullTexel[0], 0.0), 0, 1);
        },
        lengths));
    cases.back().discards = true;
    cases.back().domain = [=](const Inputs& x) { return isUnit(x.vec3(0)) && std::abs(cosine(x)) > 1e-5; };
    cases.push_back(shellCase("furHullShadow", std::string(made) + "return float4(furHullShadow(v), 0, 0, 0);", arguments,
                              [](const Inputs& x) { return values(hullLeaves(x.vec3(1), furTurned(x.vec3(0)), x.scalar(2))); },
                              {.forward = 32, .backward = 4, .absolute = 1e-3, .why = "differences of 450 mm by a coat of 7.2"}));
    cases.back().domain = [](const Inputs& x) { return isUnit(x.vec3(0)); };
    return cases;
}

/// A vertex: normal and place in the mesh.
constexpr const char* kVertexBody = "TgVertexInput i = (TgVertexInput)0; i.normal = a0; i.position = a1; i.uv = float2(0.3, 0.4); ";

glm::dvec3 placeInCoat(const glm::dvec3& position, const glm::dvec3& normal, double height) {
    return furWorld(position) + (furTurned(normal) + kFurLean * height * kFurDown) * (kFurLength * kFurMesh * height);
}

/// Over the skin, while a ray falls by the coat's height.
double wayOver(const glm::dvec3& world, const glm::dvec3& normal, double height) {
    const glm::dvec3 view = glm::normalize(world - kFurEye);
    const glm::dvec3 strand = normal + 2 * height * kFurLean * kFurDown;
    return glm::length(view * (glm::dot(strand, normal) / -glm::dot(view, normal)) + strand) * kFurLength * kFurMesh;
}

bool seesEye(const glm::dvec3& world, const glm::dvec3& normal) {
    return isUnit(normal) && glm::dot(normal, glm::normalize(kFurEye - world)) > 0.1;
}

double layerHeight(double layer) {
    return std::pow(layer / 32, kSpread);
}

std::vector<FunctionCase> vertices() {
    const std::vector<Argument> arguments = {unit(), linear(-40, 40, 3), whole(0, 31)};
    const auto world = [](const Inputs& x) { return placeInCoat(x.vec3(1), x.vec3(0), layerHeight(std::round(x.scalar(2)) + 1)); };
    std::vector<FunctionCase> cases;
    cases.push_back(shellCase("shellVarying",
                              std::string(kVertexBody) + "FurVarying v = shellVarying(i, a2, -1.0); "
                                                         "return float4(v.coat.xw, furRound(v), v.world.x);",
                              arguments,
                              [=](const Inputs& x) {
                                  const double layer = std::round(x.scalar(2));
                                  return values(layerHeight(layer + 1), layerHeight(layer + 2), -1, world(x).x);
                              },
                              {.forward = 32, .backward = 2, .absolute = 2e-5, .why = "powers; sums of up to 90"}));
    cases.back().domain = [](const Inputs& x) { return isUnit(x.vec3(0)); };
    const auto vertexLight = [&](const char* returned, auto expected) {
        cases.push_back(shellCase(
            "shellVarying", std::string(kVertexBody) + "FurVarying v = shellVarying(i, a2, 1.0); return float4(" + returned + ");",
            arguments,
            [=](const Inputs& x) {
                const glm::dvec3 normal = furTurned(x.vec3(0));
                const double height = layerHeight(std::round(x.scalar(2)) + 1);
                return expected(Lit{normal, world(x), glm::dvec3(0), height, 1, hullLeaves(world(x), normal, height)});
            },
            kLitTolerance));
        cases.back().tolerance.absolute = 3e-3;
        cases.back().tolerance.why = "the same, and a hull's shadow to 1e-3";
        cases.back().defines.emplace_back("TEGUMENT_FUR_VERTEX_LIGHT", "1");
        cases.back().domain = [=](const Inputs& x) {
            const glm::dvec3 normal = furTurned(x.vec3(0));
            return seesEye(world(x), normal) && Lit{normal, world(x), glm::dvec3(0), layerHeight(std::round(x.scalar(2)) + 1)}.plain();
        };
    };
    vertexLight("v.mirrored.rgb, v.mirrored.w / 100.0", [](const Lit& black) {
        return values(glm::dvec4(black.radiance(), wayOver(black.world, black.normal, black.height) / 100));
    });
    vertexLight("v.lit, 0", [](const Lit& black) {
        Lit white = black;
        white.albedo = glm::dvec3(1);
        return values(white.radiance() - black.radiance());
    });
    cases.push_back(shellCase("CoatEndVS",
                              std::string(kVertexBody) + "FurVarying v = CoatEndVS(i); "
                                                         "return float4(v.coat.xw, furRound(v) + a2, v.world.y);",
                              arguments,
                              [](const Inputs& x) { return values(1, 1, 1 + x.scalar(2), placeInCoat(x.vec3(1), x.vec3(0), 1).y); },
                              {.forward = 8, .backward = 2, .absolute = 2e-5, .why = "sums of up to 90"}));
    cases.back().domain = [](const Inputs& x) { return isUnit(x.vec3(0)); };
    cases.push_back(
        shellCase("shellWay", std::string(kLitBody) + "return float4(shellWay(v), 0, 0, 0);", {unit(), linear(-80, 80, 3), linear(0, 1)},
                  [](const Inputs& x) { return values(wayOver(x.vec3(1), furTurned(x.vec3(0)), x.scalar(2))); },
                  {.forward = 64, .backward = 4, .absolute = 1e-3, .why = "a quotient by a cosine of 0.1 and more, 4.8 times"}));
    cases.back().domain = [](const Inputs& x) { return seesEye(x.vec3(1), furTurned(x.vec3(0))); };
    return cases;
}

/// docs/design/fur.md, "Seen from afar": of logistic heights.
double meanCoverage(double mean, double height, double above, double variance, double slope) {
    const double scale = std::sqrt(3 * variance) / std::numbers::pi + 1e-4;
    const double tip = mean + kSoft * (0.5 - std::min(0.2 / std::sqrt(kSoft), 1.0));
    const auto shorter = [&](double h) { return 1 / (1 + std::exp(std::clamp((tip - h) / scale, -60.0, 60.0))); };
    const double taller = 1 - shorter(height);
    const double entered = 1 - std::pow(shorter(height) / shorter(above), 0.5 + std::hypot(0.5, slope / std::numbers::pi));
    const double both = entered * entered * entered + taller * taller * taller;
    return both < 1e-20 ? 0 : entered * taller / std::cbrt(both);
}

/// Arguments: heights of the layer and how much higher the next is, sides of a pixel, slope, round, alpha.
struct Shell {
    double tested, drawn;

    explicit Shell(const Inputs& x) {
        const double height = x.scalar(0);
        const double alpha = x.scalar(5);
        const double square = std::pow(std::sqrt(3.0) * 0.98149546 * x.scalar(2), 2); // 1.7
        const double variance = std::min(kDeviation * kDeviation * square / (square + kGrain * kGrain), alpha * alpha);
        const double afar = 12 * variance / (12 * variance + 0.36 * kSoft * kSoft) * kTaper * (1 - kOuter);
        const double mean = meanCoverage(alpha, height, height + x.scalar(1), variance, x.scalar(3));
        const double coverage = glm::mix(alpha, std::min(share((alpha - height) / kSoft + 0.5), share(1e4 * alpha)), kTaper);
        tested = x.scalar(4) < 0 ? -1 : glm::mix(coverage - kOuter / 2, mean - 0.002, afar);
        drawn = std::max(glm::mix(coverage, mean, afar), kOuter); // of 32 layers coverage is what it is
    }
};

std::vector<FunctionCase> pixels() {
    const std::vector<Argument> arguments = {linear(0, 1),  linear(0.01, 0.1), logarithmic(1e-4, 0.1),
                                             linear(0, 10), linear(-1, 1),     linear(0.05, 1)};
    const char* made = "FurVarying v = (FurVarying)0; v.coat = float4(a0, 0, 0, a0 + a1); v.lit = float3(0.5, 0.6, 0.7); v.mirrored = 0.1; "
                       "ShellPixel own; own.sides = float2(a2, 2.0 * a2); own.slope = a3; own.left = a4; float left; "
                       "float4 color = shell(v, own, float4(0.9, 0.8, 0.7, a5), left); ";
    std::vector<FunctionCase> cases;
    cases.push_back(shellCase("shell", std::string(made) + "return float4(left, color.w, color.rg);", arguments,
                              [](const Inputs& x) {
                                  const Shell s(x);
                                  const glm::dvec3 albedo = glm::mix(kFurDark, kFurPale, x.scalar(0)) * glm::dvec3(0.9, 0.8, 0.7);
                                  const glm::dvec3 lit = albedo * glm::dvec3(0.5, 0.6, 0.7) + 0.1;
                                  const double seen = s.tested >= 0 ? 1 : 0;
                                  return values(s.tested, s.drawn, seen * lit.x, seen * lit.y);
                              },
                              {.forward = 32, .backward = 8, .absolute = 5e-4, .why = "powers of quotients of exponentials"}));
    cases.back().globals["gFurOuterFirst"] = {kOuter};
    cases.back().defines.emplace_back("TEGUMENT_FUR_VERTEX_LIGHT", "1");
    cases.back().domain = [](const Inputs& x) { return std::abs(Shell(x).tested) > 1e-3 && x.scalar(2) >= 1e-4; };
    const std::vector<Argument> plane = {linear(-1, 1, 3), vector(3, 1e-3, 1), vector(3, 1e-3, 1), linear(0.1, 2)};
    const char* across = "float2 q = fmod(pixel, 2.0); float3 v = a0 + q.x * a1 + q.y * a2; ";
    const auto quad = [&](const char* function, const std::string& body, std::function<Values(const Inputs&)> expected) {
        cases.push_back(shellCase(function, across + body, plane, std::move(expected),
                                  {.forward = 8, .backward = 2, .absolute = 2e-6, .why = "differences of numbers up to 2"}));
        cases.back().perQuad = true;
        cases.back().domain = [](const Inputs& x) { // where neither a direction nor a difference is lost
            const double less = std::min(glm::length(x.vec3(1)), glm::length(x.vec3(2)));
            return less > 1e-3 && glm::length(x.vec3(0)) < 4;
        };
    };
    quad("shellSides", "return float4(shellSides(v), 0, 0);", [](const Inputs& x) {
        const double less = std::min(glm::length(x.vec3(1)), glm::length(x.vec3(2)));
        const double more = std::max(glm::length(x.vec3(1)), glm::length(x.vec3(2)));
        return values(std::max(less, more / 100), more);
    });
    quad("shellSlope",
         "FurVarying i = (FurVarying)0; i.plainRest.xyz = v; i.mirrored.w = 3.0; return float4(1e-3 * shellSlope(i, a3), 0, 0, 0);",
         [](const Inputs& x) {
             const double more = std::max(glm::length(x.vec3(1)), glm::length(x.vec3(2)));
             return values(1e-3 * 2.8 * kDeviation / kGrain * x.scalar(3) * 3 / more);
         });
    cases.back().tolerance = {
        .forward = 8, .backward = 2, .absolute = 0.2, .why = "a quotient of up to 280 by differences that are 4e-4 off"};
    cases.back().defines.emplace_back("TEGUMENT_FUR_VERTEX_LIGHT", "1");
    cases.push_back(shellCase("shellShrink", "return float4(shellShrink(float2(a0, a1)), 0, 0, 0);", {linear(0.01, 1), linear(0.5, 1)},
                              [](const Inputs& x) { return values(std::max(x.scalar(0) / x.scalar(1), 0.01)); },
                              {.forward = 4, .backward = 1, .why = "a quotient"}));
    cases.push_back(cases.back());
    cases.back().globals["gFurDeviation"] = {0};
    cases.back().expected = [](const Inputs&) { return values(1); };
    cases.push_back(shellCase("CoatEndPS", "FurVarying v = (FurVarying)0; v.world = a0; return CoatEndPS(v);", {linear(-80, 80, 3)},
                              [](const Inputs& x) { return values(1 / glm::length(x.vec3(0) - kFurEye), 0, 0, 1); },
                              {.forward = 8, .backward = 2, .why = "an inverse root"}));
    cases.push_back(shellCase("furInRound", "return float4(furInRound(a0, float2(3.5, 4.5), a1), 0, 0, 0);", {linear(0, 2), linear(-1, 1)},
                              [](const Inputs& x) { return values((x.scalar(0) - 0.75) * x.scalar(1)); },
                              {.forward = 2, .backward = 1, .absolute = 1e-7, .why = "a difference"}));
    cases.back().maps["gCoatEndMap"] = oneTexel(0.75);
    return cases;
}

/// A cube whose alpha tells the level that it was read from.
const TestMap& leveledCube() {
    static const TestMap kMap = leveledMap(true, [](int mip) { return texelOf(1, 1, 1, 0.1 * (mip + 1)); });
    return kMap;
}

/// Of a pixel that covers the map by a0 and a1 radians: the level of its shorter side, which here is the nearest one.
FunctionCase cubes() {
    const auto levelOf = [](const Inputs& x) { return std::log2(128 * std::max(std::min(x.scalar(0), x.scalar(1)), 1.0 / 128)); };
    FunctionCase made =
        shellCase("cubeShell",
                  "float2 q = fmod(pixel, 2.0); FurVarying v = (FurVarying)0; v.coat = float4(0.5, 0, 0, 0.6); v.world = 1.0; "
                  "v.plainRest.w = 1; return float4(cubeShell(v, float2(3.5, 4.5), float3(0, 0, 1), float3(q.x * a0, q.y * "
                  "a1, 1)).w, 0, 0, 0);",
                  {linear(0.02, 0.4), linear(0.02, 0.4)}, [=](const Inputs& x) { return values(0.1 * (1 + std::round(levelOf(x)))); },
                  {.forward = 8, .backward = 0, .absolute = 1e-6, .why = "a level's own number"});
    made.maps["gFurCubeMap"] = &leveledCube();
    made.maps["gCoatEndMap"] = oneTexel(0);
    setAll(made, {"gFurTaper", "gFurAlphaTest", "gFurCurl"}, {0});
    made.defines.emplace_back("TEGUMENT_FUR_VERTEX_LIGHT", "1");
    made.perQuad = true;
    made.domain = [=](const Inputs& x) { // a device may round the level to an eighth and more
        return std::abs(levelOf(x) - std::floor(levelOf(x)) - 0.5) > 0.15;
    };
    return made;
}

} // namespace

std::vector<FunctionCase> furShellCases() {
    return together(cubes(), radiances(), hulls(), vertices(), pixels());
}

} // namespace tegument::test
