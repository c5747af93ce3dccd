// Ribbons, their shadow and the undercoat (effects/passes/fur_ribbons.fxh, fur_opacity.fxh, fur_coat.fxh, fur_locks.fxh), and lamps
// (lamp_light.fxh) in double precision.

#include "tests/hlsl/lock_scene.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

constexpr double kRibbonThin = 0.7;
constexpr double kSoftEdge = 0.4;
const glm::dvec3 kEye = {100, -200, 250};

FunctionCase ribbon(const char* function, std::string body, std::vector<Argument> arguments, std::function<Values(const Inputs&)> expected,
                    Tolerance tolerance) {
    const Globals more = {{"gWorldInverseTranspose", kLockScene.at("gWorld")},
                          {"gCameraPosition", numbersOf(kEye)},
                          {"gRibbonThin", {kRibbonThin}},
                          {"gFurEdge", {kSoftEdge}},
                          {"gCoatShadow", {0.002}},
                          {"gFurDown", {0, -1, 0}},
                          {"gFurMultiple", {0.7}},
                          {"gFurSpecular", {0.08}},
                          {"gFurExponent", {40}}};
    return passCase("FurCoat.fx", with(with(kLockScene, kFurView), more), function, std::move(body), std::move(arguments),
                    std::move(expected), std::move(tolerance));
}

/// Coverage of a pixel by a ribbon: distance from the axis, half of the width, faintness.
double covered(double distance, double half, double faint) {
    return std::abs(faint) * std::clamp(half + 0.5 - std::abs(distance), 0.0, 1.0);
}

std::vector<FunctionCase> widths() {
    const Tolerance plain{.forward = 8, .backward = 4, .absolute = 1e-6, .why = "sums of numbers up to 4"};
    std::vector<FunctionCase> cases;
    for (const double length : {0.06, 0.2}) { // a coat on a body that bends as a ball of a quarter of its radius, at least 0.28 of that
        cases.push_back(ribbon(
            "ribbonHorizon", "return float4(ribbonHorizon() + 0.0 * a0, 0, 0, 0);", {linear(0, 1)},
            [=](const Inputs&) { return values(-std::sin(std::acos(1 / (1 + 1.5 * std::max(4 * length, 0.28))))); }, plain));
        cases.back().globals["gFurLength"] = {length};
    }
    cases.push_back(ribbon("ribbonPixel", "return float4(a0 * ribbonPixel(), 0, 0, 0);", {linear(1, 100)},
                           [](const Inputs& x) { return values(kFurPixel * x.scalar(0)); },
                           {.forward = 8, .backward = 2, .why = "a tangent and two products"}));
    const auto nearest = [](const Inputs& x) { return glm::length(x.vec3(0)) - 4 * kLockLength * kLockMesh; };
    cases.push_back(ribbon(
        "ribbonThin", "RibbonFrame f = (RibbonFrame)0; f.toEye = a0; return float4(ribbonThin(f, a1) ? 1 : 0, 0, 0, 0);",
        {vector(3, 10, 500), logarithmic(0.001, 1)},
        [=](const Inputs& x) { return values(2 * x.scalar(1) < kRibbonThin * kFurPixel * nearest(x) ? 1 : 0); }, plain));
    cases.back().domain = [=](const Inputs& x) { return std::abs(2 * x.scalar(1) / (kRibbonThin * kFurPixel * nearest(x)) - 1) > 1e-4; };
    cases.push_back(ribbon(
        "ribbonDrawn", "TgVertexInput v = (TgVertexInput)0; v.uv.y = a0; return float4(ribbonDrawn(v, a1, a2) ? 1 : 0, 0, 0, 0);",
        {whole(4000, 4200), linear(0, 1), linear(0, 1)},
        [](const Inputs& x) { return values(x.scalar(0) >= 4096 && x.scalar(1) < x.scalar(2) ? 1 : 0); }, plain));
    const char* made = "RibbonVarying r = (RibbonVarying)0; r.color.w = a0; r.edge = float2(a1, a2); ";
    const std::vector<Argument> edges = {linear(-1, 1), linear(-3, 3), linear(0.5, 2), linear(0.1, 0.9)};
    cases.push_back(ribbon(
        "ribbonCore", std::string(made) + "return float4(ribbonCore(r, a3), 0, 0, 0);", edges,
        [](const Inputs& x) {
            const double coverage = covered(x.scalar(1), x.scalar(2), x.scalar(0));
            return values(x.scalar(0) < kRibbonThin ? -1 : coverage - x.scalar(3));
        },
        plain));
    cases.back().domain = [](const Inputs& x) { return std::abs(x.scalar(0) - kRibbonThin) > 1e-6; };
    cases.push_back(ribbon(
        "ribbonFringe", std::string(made) + "return float4(ribbonFringe(r, a3), 0, 0, 0);", edges,
        [](const Inputs& x) { // what the core leaves, and is more than an 8-bit target's half step
            const double coverage = covered(x.scalar(1), x.scalar(2), x.scalar(0));
            return values(coverage < x.scalar(3) || x.scalar(0) < kRibbonThin ? coverage - 0.004 : -1);
        },
        plain));
    cases.back().domain = [](const Inputs& x) {
        const double coverage = covered(x.scalar(1), x.scalar(2), x.scalar(0));
        return std::abs(x.scalar(0) - kRibbonThin) > 1e-6 && std::abs(coverage - x.scalar(3)) > 1e-5;
    };
    return cases;
}

/// Arguments: frame's place, way to the eye, offset, tangent, radius, side.
struct Drawn {
    double pixel, half, reach, side;

    explicit Drawn(const Inputs& x)
        : pixel(kFurPixel * glm::length(x.vec3(1) - x.vec3(2))), half(std::max(x.scalar(4), pixel / 2)), reach(half + kSoftEdge * pixel),
          side(x.scalar(5) > 0.5 ? 1 : -1) {}

    [[nodiscard]] glm::dvec4 position(const Inputs& x) const {
        const glm::dvec3 aside = glm::normalize(glm::cross(x.vec3(3), x.vec3(1) - x.vec3(2)));
        return furClip(x.vec3(0) + x.vec3(2) + side * reach * aside);
    }
};

std::vector<FunctionCase> ribbons() {
    const char* made = "TgVertexInput v = (TgVertexInput)0; v.tangent.w = a5 > 0.5 ? 1 : -1; RibbonFrame f = (RibbonFrame)0; f.world = a0; "
                       "f.toEye = a1; RibbonVarying r = ribbonVarying(v, f, a2, a3, a4, float3(0.1, 0.2, 0.3)); ";
    const std::vector<Argument> arguments = {linear(-80, 80, 3),   vector(3, 150, 400), linear(-5, 5, 3), unit(),
                                             logarithmic(0.02, 2), whole(0, 1)};
    const auto plain = [](const Inputs& x) { // neither along the way to the eye, nor with a vector that is none
        const glm::dvec3 toEye = x.vec3(1) - x.vec3(2);
        return glm::length(toEye) > 100 && glm::length(glm::cross(x.vec3(3), toEye)) > 0.05 * glm::length(toEye) && x.scalar(4) > 0;
    };
    std::vector<FunctionCase> cases;
    cases.push_back(ribbon("ribbonVarying", std::string(made) + "return float4(r.color.w, r.edge, r.color.z);", arguments,
                           [](const Inputs& x) {
                               const Drawn d(x);
                               return values(x.scalar(4) / d.half, d.side * d.reach / d.pixel, d.half / d.pixel, 0.3);
                           },
                           {.forward = 16, .backward = 4, .why = "lengths and quotients"}));
    cases.back().domain = plain;
    cases.push_back(ribbon("ribbonVarying", std::string(made) + "return r.position;", arguments,
                           [](const Inputs& x) { return values(Drawn(x).position(x)); },
                           {.forward = 8, .backward = 4, .absolute = 4e-4, .why = "sums of up to 700"}));
    cases.back().domain = plain;
    return cases;
}

double fromLight(const glm::dvec3& world) {
    return glm::length(kFurLamp - world);
}

/// A map of one texel: depth of the coat's front and of the skin, mm, and the sums of opacity.
constexpr std::array<float, 4> kOpacities = {290, 400, 520, 700};
constexpr double kThickness = kLockLength * kLockMesh;

double opacityAt(double depth) {
    constexpr std::array<double, 5> kDepths = {0, 0.25, 0.6, 1.2, 2.4};
    double sum = 0;
    for (std::size_t i = 1; i < kDepths.size(); ++i) {
        const double layer = static_cast<double>(kOpacities[i - 1]) - (i > 1 ? static_cast<double>(kOpacities[i - 2]) : 0);
        sum += layer * std::clamp((depth - kDepths[i - 1]) / (kDepths[i] - kDepths[i - 1]), 0.0, 1.0);
    }
    return sum;
}

std::vector<FunctionCase> shadows() {
    static const TestMap kMaps{.size = 1, .texels = {kOpacities}};
    const std::vector<Argument> point = {linear(-3, 3), linear(-3, 3), linear(-20, 15)};
    const char* world = "float3 world = float3(20 + a0, -30 + a1, a2); ";
    const auto place = [](const Inputs& x) { return glm::dvec3(20 + x.scalar(0), -30 + x.scalar(1), x.scalar(2)); };
    std::vector<FunctionCase> cases;
    cases.push_back(ribbon("coatOpen", std::string(world) + "return float4(coatOpen(world, 0.01), 0, 0, 0);", point,
                           [=](const Inputs& x) {
                               const double distance = fromLight(place(x));
                               const double depth = (distance - 290) / kThickness;
                               const double behind = std::clamp((distance - 290) / (0.5 * kThickness), 0.0, 1.0);
                               return values(std::exp(-0.002 * opacityAt(depth - 0.05)) * (1 - behind));
                           },
                           {.forward = 8, .backward = 4, .absolute = 1e-4, .why = "distances of 300 mm to 3e-5, times 290 / 4.8 / 0.25"}));
    cases.push_back(ribbon("coatOpen", std::string(world) + "return float4(coatOpen(world, 0.01), 0, 0, 0);", point,
                           [=](const Inputs& x) {
                               const double distance = fromLight(place(x));
                               const double behind = std::clamp((distance - 290) / (0.02 * kLockMesh), 0.0, 1.0);
                               return values(std::exp(-0.002 * opacityAt((distance - 290) / (0.01 * kLockMesh) - 0.05)) * (1 - behind));
                           },
                           {.forward = 8, .backward = 4, .absolute = 1e-3, .why = "the same, and a coat a sixth as long"}));
    cases.back().globals["gFurLength"] = {0.01};
    cases.push_back(ribbon("coatDepth", "return float4(coatDepth(float2(0.5, 0.5), a0), 0, 0, 0);", {linear(270, 310)},
                           [](const Inputs& x) { return values((x.scalar(0) - 290) / kThickness); },
                           {.forward = 4, .backward = 2, .absolute = 1e-5, .why = "a difference of numbers up to 310"}));
    cases.push_back(ribbon("OpacityPS",
                           "OpacityVarying o; o.position = 0; o.edge = float3(a0, 1, 0.8); o.place = float4(0.1, 0.2, 1, a1); "
                           "return OpacityPS(o);",
                           {linear(-2, 2), linear(285, 305)},
                           [](const Inputs& x) {
                               const double depth = (x.scalar(1) - 290) / kThickness;
                               const double coverage = covered(x.scalar(0), 1, 0.8);
                               const auto layer = [&](double end) { return coverage * std::clamp(16 * (end - depth) + 0.5, 0.0, 1.0); };
                               return values(layer(0.25), layer(0.6), layer(1.2), layer(2.4));
                           },
                           {.forward = 8, .backward = 4, .absolute = 2e-4, .why = "a depth to 1e-5, 16 times"}));
    cases.push_back(ribbon("CoatFrontPS", "CoatFrontVarying c; c.position = 0; c.distance = a0; return CoatFrontPS(c);", {linear(-1, 300)},
                           [](const Inputs& x) { return values(std::max(x.scalar(0), 1e-6), 0, 0, 1); },
                           {.forward = 1, .backward = 1, .why = "a maximum"}));
    cases.push_back(ribbon("furFromLight", "return float4(furFromLight(a0), 0, 0, 0);", {linear(-80, 80, 3)},
                           [](const Inputs& x) { return values(fromLight(x.vec3(0))); }, {.forward = 8, .backward = 2, .why = "a length"}));
    cases.push_back(ribbon(
        "furFromAxes", "float4x4 m = float4x4(2, 0, 0, 0, 0, 0, 3, 0, 0, -0.5, 0, 0, 7, 8, 9, 1); return float4(furFromAxes(a0, m), 0);",
        {linear(-3, 3, 3)}, // the mesh's axes are x, z and -y of the world, whatever their lengths
        [](const Inputs& x) { return values(glm::dvec3(x.scalar(0, 0), -x.scalar(0, 2), x.scalar(0, 1))); },
        {.forward = 4, .backward = 1, .absolute = 1e-6, .why = "unit vectors"}));
    cases.push_back(ribbon("furSkinShadow", "return float4(furSkinShadow(float4(a0, a1, a2, 1), a3), 0, 0, 0);",
                           {linear(-1.5, 1.5), linear(-1.5, 1.5), linear(-0.5, 1.5), linear(280, 300)},
                           [](const Inputs& x) { // millimetres; 0.005 of the mesh's radius nearer counts as on the skin
                               const bool seen = std::abs(x.scalar(0)) < 1 && std::abs(x.scalar(1)) < 1 && x.scalar(2) > 0;
                               return values(seen && x.scalar(3) - 0.005 * kLockMesh > 290 ? 0 : 1);
                           },
                           {.forward = 1, .backward = 0, .why = "0 or 1"}));
    cases.back().domain = [](const Inputs& x) {
        const double inside = std::min(1 - std::max(std::abs(x.scalar(0)), std::abs(x.scalar(1))), x.scalar(2));
        return std::abs(inside) > 1e-5 && std::abs(x.scalar(3) - 290.4) > 1e-3;
    };
    for (FunctionCase& each : cases)
        each.map = &kMaps;
    return cases;
}

/// What the coat leaves of the light at a point, with every map one texel.
double openAt(const glm::dvec3& world) {
    const double behind = (fromLight(world) - 290) / kThickness;
    return std::exp(-0.002 * opacityAt(behind - 0.05)) * (1 - std::clamp(2 * behind, 0.0, 1.0));
}

/// The opaque layer below strands: dull, half as bright, paler on what looks down; from afar of the colour half-way.
FunctionCase undercoat() {
    static const TestMap kMaps{.size = 1, .texels = {kOpacities}};
    const auto place = [](const Inputs& x) { return glm::dvec3(20 + x.scalar(1), -30 + x.scalar(2), x.scalar(3)); };
    FunctionCase made = ribbon(
        "UndercoatPS", "FurVarying f = (FurVarying)0; f.normal = a0; f.world = float3(20 + a1, -30 + a2, a3); return UndercoatPS(f);",
        {unit(), linear(-3, 3), linear(-3, 3), linear(8, 20)},
        [=](const Inputs& x) {
            const glm::dvec3 normal = x.vec3(0);
            const glm::dvec3 world = place(x);
            const double below = -normal.y;
            const double belly = 0.8 * std::clamp(1.6 * below - 0.4, 0.0, 1.0);
            const double pixel = kFurPixel * glm::length(kEye - world) / kThickness;
            const double far = std::clamp((pixel - 0.05) / 0.2, 0.0, 1.0);
            const glm::dvec3 near = glm::mix(kLockRoot, 0.4 * kLockPale, belly);
            const glm::dvec3 albedo = glm::mix(near, glm::mix(kLockMid, 0.75 * kLockPale, belly), 0.5 * far);
            const double lit = std::clamp(0.3 + 0.7 * glm::dot(normal, glm::normalize(kFurLamp - world)), 0.0, 1.0) * openAt(world);
            const glm::dvec3 around = glm::mix(kLockSky, kLockGround, 0.5 + 0.5 * below);
            return values(glm::dvec4(albedo * (kFurColour * (0.5 * lit + 0.12 * around)), 1));
        },
        {.forward = 16, .backward = 4, .absolute = 1e-4, .why = "the share of light that comes, as in coatOpen"});
    made.map = &kMaps;
    made.globals["gFurLength"] = {kLockLength};
    made.domain = [](const Inputs& x) { return isUnit(x.vec3(0)); };
    return made;
}

std::vector<FunctionCase> lamps() {
    std::vector<FunctionCase> cases;
    const auto add = [&](const char* body, std::function<Values(const Inputs&)> expected) {
        cases.push_back(ribbon("lampAt", body, {linear(-80, 80, 3), linear(0, 1, 3)}, std::move(expected),
                               {.forward = 32, .backward = 4, .absolute = 1e-5, .why = "lengths, a quotient's square, a smooth step"}));
        cases.back().defines = {{"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_LAMP_SHADOWS", "0"}};
        cases.back().globals["gLampPlace"] = {120, -40, 200, 1, 0, 0.6, 0.8, 0, 10, 20, -300, 1};
        cases.back().globals["gLampColor"] = {0.5, 0.6, 0.7, 150, 0.3, 0.2, 0.1, 0, 1, 0.9, 0.8, 300};
        cases.back().globals["gLampAxis"] = {-0.48, 0.16, -0.8624, 0.25, 0, 0, 1, 0, 0, 0, 1, 0};
        cases.back().globals["gLampSpot"] = {0.97, 0.85, 0.6, 1, -1, -2, 1, 1, -1, -2, 0.4, 1};
    };
    static const glm::dvec3 kSpotted = {120, -40, 200};
    static const auto spot = [](const Inputs& x) {
        const glm::dvec3 way = kSpotted - x.vec3(0);
        const double cosine = glm::dot(-way, glm::dvec3(-0.48, 0.16, -0.8624)) / glm::length(way);
        const double t = std::clamp((cosine - 0.85) / 0.12, 0.0, 1.0);
        return std::pow(150 / glm::length(way), 2) * (3 * t * t - 2 * t * t * t);
    };
    add("return float4(lampAt(0, a0, a1).light, 0);", [](const Inputs& x) { return values(glm::dvec3(0.5, 0.6, 0.7) * spot(x)); });
    add("return float4(lampAt(0, a0, a1).toLight, 0);", [](const Inputs& x) { return values(glm::normalize(kSpotted - x.vec3(0))); });
    add("return float4(lampAt(1, a0, a1).toLight + lampAt(1, a0, a1).light, 0);",
        [](const Inputs&) { return values(glm::dvec3(0.3, 0.8, 0.9)); });
    add("return float4(lampAt(2, a0, a1).light, 0);", [](const Inputs& x) {
        return values(glm::dvec3(1, 0.9, 0.8) * std::pow(300 / glm::length(glm::dvec3(10, 20, -300) - x.vec3(0)), 2));
    });
    for (std::size_t lamp : {0U, 2U}) { // with shadows: of each its own share that is seen, by its own weight
        add(lamp == 0 ? "return float4(lampAt(0, a0, a1).light.x, lampAt(1, a0, a1).light.x, 0, 0);"
                      : "return float4(lampAt(2, a0, a1).light.x, 0, 0, 0);",
            [=](const Inputs& x) {
                if (lamp == 0) return values(0.5 * spot(x) * (0.4 + 0.6 * x.scalar(1)), 0.3 * x.scalar(1, 1));
                const double falloff = std::pow(300 / glm::length(glm::dvec3(10, 20, -300) - x.vec3(0)), 2);
                return values(falloff * (0.6 + 0.4 * x.scalar(1, 2)));
            });
        cases.back().defines.back().second = "3";
    }
    return cases;
}

} // namespace

std::vector<FunctionCase> ribbonPassCases() {
    return together(widths(), ribbons(), shadows(), lamps(), undercoat());
}

} // namespace tegument::test
