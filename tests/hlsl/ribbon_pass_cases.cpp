// Ribbons, their shadow and the undercoat (effects/passes/fur_ribbons.fxh, fur_opacity.fxh, fur_coat.fxh, fur_locks.fxh), and lamps
// (lamp_light.fxh) in double precision.

#include "tests/hlsl/lock_scene.h"

namespace tegument::test {

namespace {

constexpr double kRibbonThin = 0.7;
constexpr double kSoftEdge = 0.4;
const dvec3 kEye = {100, -200, 250};

FunctionCase ribbon(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    const Globals more = {{"gWorldInverseTranspose", kLockScene.at("gWorld")},
                          {"gCameraPosition", numbersOf(kEye)},
                          {"gRibbonThin", {kRibbonThin}},
                          {"gFurEdge", {kSoftEdge}},
                          {"gCoatShadow", {0.002}},
                          {"gFurDown", {0, -1, 0}},
                          {"gFurMultiple", {0.7}},
                          {"gFurSpecular", {0.08}},
                          {"gFurExponent", {40}}};
    return passCase("FurCoat.fx", with(with(kLockScene, kFurView), more), std::move(call), std::move(arguments), std::move(tolerance),
                    std::move(expected));
}

/// Coverage of a pixel by a ribbon: distance from the axis, half of the width, faintness.
double covered(double distance, double half, double faint) {
    return abs(faint) * saturate(half + 0.5 - abs(distance));
}

void widths(Cases& cases) {
    const Tolerance plain{8, 4, 1e-6, "sums of numbers up to 4"};
    for (const double length : {0.06, 0.2}) { // a coat on a body that bends as a ball of a quarter of its radius, at least 0.28 of that
        cases += ribbon("ribbonHorizon() + 0.0 * a0", {linear(0, 1)}, plain,
                        [=](In) { return -sin(acos(1 / (1 + 1.5 * max(4 * length, 0.28)))); });
        cases.back().globals["gFurLength"] = {length};
    }
    cases += ribbon({"ribbonPixel", "return float4(a0 * ribbonPixel(), 0, 0, 0);"}, {linear(1, 100)},
                    {8, 2, 0, "a tangent and two products"}, [](In x) { return kFurPixel * x[0]; });
    const auto nearest = [](In x) { return length(x.vec3(0)) - 4 * kLockLength * kLockMesh; };
    cases += ribbon({"ribbonThin", "RibbonFrame f = (RibbonFrame)0; f.toEye = a0; return float4(ribbonThin(f, a1) ? 1 : 0, 0, 0, 0);"},
                    {vector(3, 10, 500), logarithmic(0.001, 1)}, plain,
                    [=](In x) { return 2 * x[1] < kRibbonThin * kFurPixel * nearest(x) ? 1 : 0; });
    cases.back().domain = [=](In x) { return abs(2 * x[1] / (kRibbonThin * kFurPixel * nearest(x)) - 1) > 1e-4; };
    cases +=
        ribbon({"ribbonDrawn", "TgVertexInput v = (TgVertexInput)0; v.uv.y = a0; return float4(ribbonDrawn(v, a1, a2) ? 1 : 0, 0, 0, 0);"},
               {whole(4000, 4200), linear(0, 1), linear(0, 1)}, plain, [](In x) { return x[0] >= 4096 && x[1] < x[2] ? 1 : 0; });
    const char* made = "RibbonVarying r = (RibbonVarying)0; r.color.w = a0; r.edge = float2(a1, a2); ";
    const Arguments edges = {linear(-1, 1), linear(-3, 3), linear(0.5, 2), linear(0.1, 0.9)};
    cases += ribbon({"ribbonCore", std::string(made) + "return float4(ribbonCore(r, a3), 0, 0, 0);"}, edges, plain, [](In x) {
        const double coverage = covered(x[1], x[2], x[0]);
        return x[0] < kRibbonThin ? -1 : coverage - x[3];
    });
    cases.back().domain = [](In x) { return abs(x[0] - kRibbonThin) > 1e-6; };
    // what the core leaves, and is more than an 8-bit target's half step
    cases += ribbon({"ribbonFringe", std::string(made) + "return float4(ribbonFringe(r, a3), 0, 0, 0);"}, edges, plain, [](In x) {
        const double coverage = covered(x[1], x[2], x[0]);
        return coverage < x[3] || x[0] < kRibbonThin ? coverage - 0.004 : -1;
    });
    cases.back().domain = [](In x) {
        const double coverage = covered(x[1], x[2], x[0]);
        return abs(x[0] - kRibbonThin) > 1e-6 && abs(coverage - x[3]) > 1e-5;
    };
}

/// Arguments: frame's place, way to the eye, offset, tangent, radius, side.
struct Drawn {
    double pixel, half, reach, side;

    explicit Drawn(In x)
        : pixel(kFurPixel * length(x.vec3(1) - x.vec3(2))), half(max(x[4], pixel / 2)), reach(half + kSoftEdge * pixel),
          side(x[5] > 0.5 ? 1 : -1) {}

    [[nodiscard]] dvec4 position(In x) const {
        const dvec3 aside = normalize(cross(x.vec3(3), x.vec3(1) - x.vec3(2)));
        return furClip(x.vec3(0) + x.vec3(2) + side * reach * aside);
    }
};

void ribbons(Cases& cases) {
    const char* made = "TgVertexInput v = (TgVertexInput)0; v.tangent.w = a5 > 0.5 ? 1 : -1; RibbonFrame f = (RibbonFrame)0; f.world = a0; "
                       "f.toEye = a1; RibbonVarying r = ribbonVarying(v, f, a2, a3, a4, float3(0.1, 0.2, 0.3)); ";
    const Arguments arguments = {linear(-80, 80, 3), vector(3, 150, 400), linear(-5, 5, 3), unit(), logarithmic(0.02, 2), whole(0, 1)};
    const auto plain = [](In x) { // neither along the way to the eye, nor with a vector that is none
        const dvec3 toEye = x.vec3(1) - x.vec3(2);
        return length(toEye) > 100 && length(cross(x.vec3(3), toEye)) > 0.05 * length(toEye) && x[4] > 0;
    };
    cases += ribbon({"ribbonVarying", std::string(made) + "return float4(r.color.w, r.edge, r.color.z);"}, arguments,
                    {16, 4, 0, "lengths and quotients"}, [](In x) {
                        const Drawn d(x);
                        return values(x[4] / d.half, d.side * d.reach / d.pixel, d.half / d.pixel, 0.3);
                    });
    cases.back().domain = plain;
    cases += ribbon({"ribbonVarying", std::string(made) + "return r.position;"}, arguments, {8, 4, 4e-4, "sums of up to 700"},
                    [](In x) { return Drawn(x).position(x); });
    cases.back().domain = plain;
}

double fromLight(const dvec3& world) {
    return length(kFurLamp - world);
}

/// A map of one texel: depth of the coat's front and of the skin, mm, and the sums of opacity.
constexpr std::array<float, 4> kOpacities = {290, 400, 520, 700};
constexpr double kThickness = kLockLength * kLockMesh;

double opacityAt(double depth) {
    constexpr std::array<double, 5> kDepths = {0, 0.25, 0.6, 1.2, 2.4};
    double sum = 0;
    for (std::size_t i = 1; i < kDepths.size(); ++i) {
        const double layer = static_cast<double>(kOpacities[i - 1]) - (i > 1 ? static_cast<double>(kOpacities[i - 2]) : 0);
        sum += layer * saturate((depth - kDepths[i - 1]) / (kDepths[i] - kDepths[i - 1]));
    }
    return sum;
}

Cases shadows() {
    static const TestMap kMaps{.size = 1, .texels = {kOpacities}};
    const Arguments point = {linear(-3, 3), linear(-3, 3), linear(-20, 15)};
    const char* world = "float3 world = float3(20 + a0, -30 + a1, a2); ";
    const auto place = [](In x) { return dvec3(20 + x[0], -30 + x[1], x[2]); };
    Cases cases;
    cases += ribbon({"coatOpen", std::string(world) + "return float4(coatOpen(world, 0.01), 0, 0, 0);"}, point,
                    {8, 4, 1e-4, "distances of 300 mm to 3e-5, times 290 / 4.8 / 0.25"}, [=](In x) {
                        const double distance = fromLight(place(x));
                        const double depth = (distance - 290) / kThickness;
                        const double behind = saturate((distance - 290) / (0.5 * kThickness));
                        return exp(-0.002 * opacityAt(depth - 0.05)) * (1 - behind);
                    });
    cases += ribbon({"coatOpen", std::string(world) + "return float4(coatOpen(world, 0.01), 0, 0, 0);"}, point,
                    {8, 4, 1e-3, "the same, and a coat a sixth as long"}, [=](In x) {
                        const double distance = fromLight(place(x));
                        const double behind = saturate((distance - 290) / (0.02 * kLockMesh));
                        return exp(-0.002 * opacityAt((distance - 290) / (0.01 * kLockMesh) - 0.05)) * (1 - behind);
                    });
    cases.back().globals["gFurLength"] = {0.01};
    cases += ribbon("coatDepth(float2(0.5, 0.5), a0)", {linear(270, 310)}, {4, 2, 1e-5, "a difference of numbers up to 310"},
                    [](In x) { return (x[0] - 290) / kThickness; });
    cases +=
        ribbon({"OpacityPS",
                "OpacityVarying o; o.position = 0; o.edge = float3(a0, 1, 0.8); o.place = float4(0.1, 0.2, 1, a1); return OpacityPS(o);"},
               {linear(-2, 2), linear(285, 305)}, {8, 4, 2e-4, "a depth to 1e-5, 16 times"}, [](In x) {
                   const double depth = (x[1] - 290) / kThickness;
                   const double coverage = covered(x[0], 1, 0.8);
                   const auto layer = [&](double end) { return coverage * saturate(16 * (end - depth) + 0.5); };
                   return values(layer(0.25), layer(0.6), layer(1.2), layer(2.4));
               });
    cases += ribbon({"CoatSkinPS", "CoatFrontVarying c = (CoatFrontVarying)0; c.light = a0; return CoatSkinPS(c);"}, {linear(-1, 300)},
                    {1, 1, 0, "a maximum"}, [](In x) { return values(max(x[0], 1e-6), 0, 0, 1); });
    cases += ribbon("furFromLight(a0)", {linear(-80, 80, 3)}, {8, 2, 0, "a length"}, [](In x) { return fromLight(x.vec3(0)); });
    cases += ribbon(
        {"furFromAxes", "float4x4 m = float4x4(2, 0, 0, 0, 0, 0, 3, 0, 0, -0.5, 0, 0, 7, 8, 9, 1); return float4(furFromAxes(a0, m), 0);"},
        // the mesh's axes are x, z and -y of the world, whatever their lengths
        {linear(-3, 3, 3)}, {4, 1, 1e-6, "unit vectors"}, [](In x) { return dvec3(x.scalar(0, 0), -x.scalar(0, 2), x.scalar(0, 1)); });
    cases += ribbon("furSkinShadow(float4(a0, a1, a2, 1), a3)", {linear(-1.5, 1.5), linear(-1.5, 1.5), linear(-0.5, 1.5), linear(280, 300)},
                    {1, 0, 0, "0 or 1"}, [](In x) { // millimetres; 0.005 of the mesh's radius nearer counts as on the skin
                        const bool seen = abs(x[0]) < 1 && abs(x[1]) < 1 && x[2] > 0;
                        return seen && x[3] - 0.005 * kLockMesh > 290 ? 0 : 1;
                    });
    cases.back().domain = [](In x) {
        const double inside = min(1 - max(abs(x[0]), abs(x[1])), x[2]);
        return abs(inside) > 1e-5 && abs(x[3] - 290.4) > 1e-3;
    };
    for (FunctionCase& each : cases)
        each.map = &kMaps;
    return cases;
}

/// What the coat leaves of the light at a point, with every map one texel.
double openAt(const dvec3& world) {
    const double behind = (fromLight(world) - 290) / kThickness;
    return exp(-0.002 * opacityAt(behind - 0.05)) * (1 - saturate(2 * behind));
}

/// The opaque layer below strands: dull, half as bright, paler on what looks down; from afar of the colour half-way.
FunctionCase undercoat() {
    static const TestMap kMaps{.size = 1, .texels = {kOpacities}};
    const auto place = [](In x) { return dvec3(20 + x[1], -30 + x[2], x[3]); };
    FunctionCase made = ribbon(
        {"UndercoatPS", "FurVarying f = (FurVarying)0; f.normal = a0; f.world = float3(20 + a1, -30 + a2, a3); return UndercoatPS(f);"},
        {unit(), linear(-3, 3), linear(-3, 3), linear(8, 20)}, {16, 4, 1e-4, "the share of light that comes, as in coatOpen"}, [=](In x) {
            const dvec3 normal = x.vec3(0);
            const dvec3 world = place(x);
            const double below = -normal.y;
            const double belly = 0.8 * saturate(1.6 * below - 0.4);
            const double pixel = kFurPixel * length(kEye - world) / kThickness;
            const double far = saturate((pixel - 0.05) / 0.2);
            const dvec3 near = mix(kLockRoot, 0.4 * kLockPale, belly);
            const dvec3 albedo = mix(near, mix(kLockMid, 0.75 * kLockPale, belly), 0.5 * far);
            const double lit = saturate(0.3 + 0.7 * dot(normal, normalize(kFurLamp - world))) * openAt(world);
            const dvec3 around = mix(kLockSky, kLockGround, 0.5 + 0.5 * below);
            return dvec4(albedo * (kFurColour * (0.5 * lit + 0.12 * around)), 1);
        });
    made.map = &kMaps;
    made.globals["gFurLength"] = {kLockLength};
    made.domain = [](In x) { return isUnit(x.vec3(0)); };
    return made;
}

void lamps(Cases& cases) {
    const auto add = [&](const char* body, Reference expected) {
        cases += ribbon({"lampAt", body}, {linear(-80, 80, 3), linear(0, 1, 3)},
                        {32, 4, 1e-5, "lengths, a quotient's square, a smooth step"}, std::move(expected));
        cases.back().defines = {{"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_LAMP_SHADOWS", "0"}};
        cases.back().globals["gLampPlace"] = {120, -40, 200, 1, 0, 0.6, 0.8, 0, 10, 20, -300, 1};
        cases.back().globals["gLampColor"] = {0.5, 0.6, 0.7, 150, 0.3, 0.2, 0.1, 0, 1, 0.9, 0.8, 300};
        cases.back().globals["gLampAxis"] = {-0.48, 0.16, -0.8624, 0.25, 0, 0, 1, 0, 0, 0, 1, 0};
        cases.back().globals["gLampSpot"] = {0.97, 0.85, 0.6, 1, -1, -2, 1, 1, -1, -2, 0.4, 1};
    };
    static const dvec3 kSpotted = {120, -40, 200};
    static const auto spot = [](In x) {
        const dvec3 way = kSpotted - x.vec3(0);
        const double cosine = dot(-way, dvec3(-0.48, 0.16, -0.8624)) / length(way);
        const double t = saturate((cosine - 0.85) / 0.12);
        return pow(150 / length(way), 2) * (3 * t * t - 2 * t * t * t);
    };
    add("return float4(lampAt(0, a0, a1).light, 0);", [](In x) { return dvec3(0.5, 0.6, 0.7) * spot(x); });
    add("return float4(lampAt(0, a0, a1).toLight, 0);", [](In x) { return normalize(kSpotted - x.vec3(0)); });
    add("return float4(lampAt(1, a0, a1).toLight + lampAt(1, a0, a1).light, 0);", [](In) { return dvec3(0.3, 0.8, 0.9); });
    add("return float4(lampAt(2, a0, a1).light, 0);",
        [](In x) { return dvec3(1, 0.9, 0.8) * pow(300 / length(dvec3(10, 20, -300) - x.vec3(0)), 2); });
    for (std::size_t lamp : {0U, 2U}) { // with shadows: of each its own share that is seen, by its own weight
        add(lamp == 0 ? "return float4(lampAt(0, a0, a1).light.x, lampAt(1, a0, a1).light.x, 0, 0);"
                      : "return float4(lampAt(2, a0, a1).light.x, 0, 0, 0);",
            [=](In x) {
                if (lamp == 0) return values(0.5 * spot(x) * (0.4 + 0.6 * x[1]), 0.3 * x.scalar(1, 1));
                const double falloff = pow(300 / length(dvec3(10, 20, -300) - x.vec3(0)), 2);
                return values(falloff * (0.6 + 0.4 * x.scalar(1, 2)));
            });
        cases.back().defines.back().second = "3";
    }
}

} // namespace

Cases ribbonPassCases() {
    return together(widths, ribbons, shadows(), lamps, undercoat());
}

} // namespace tegument::test
