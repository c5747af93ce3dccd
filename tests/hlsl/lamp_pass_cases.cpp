// Lamps and surroundings beside the light of the workspace (effects/passes/lamp_light.fxh, lamps.fxh, more_light.fxh, more_light_sum.fxh,
// light_by_light.fxh) in double precision: docs/design/light.md.

#include "tests/hlsl/skin_scene.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace tegument::test {

namespace {

constexpr double kBody = 50; // radius of what lamps look at, world units
const dvec3 kCentre = {5, -3, 2};
constexpr double kTurn = 50; // of the surroundings, degrees
constexpr double kSky = 1.3;
constexpr double kMirrors = 0.7;
constexpr double kOcclusion = 0.6;

struct LampValues {
    dvec4 place, colour, axis, spot;
};
/// A spot in the world, parallel light, and a point whose light falls off from 200 units on.
const std::array<LampValues, 3> kLamps = {{{{60, 120, 160, 1}, {0.9, 0.7, 0.5, 150}, {-0.3, -0.6, -0.7416198, 6}, {0.9, 0.6, 0.7, 0.8}},
                                           {{-0.7, 0.45, 0.55, 0}, {0.3, 0.5, 0.8, 0}, {0, 0, 1, 0.15}, {-1, -2, 0.9, 0.6}},
                                           {{-90, 40, 140, 1}, {0.6, 0.2, 0.4, 200}, {0, 0, 1, 4}, {-1, -2, 0.4, 1.2}}}};
const std::vector<dvec4> kSeen = {{0.2, 0.3, 0.4, 0.5}, {0, 0, 0, 0}, {0.9, 0.1, 0.6, 1}, {0.25, 0.05, 0.1, 0.25}};
/// Of the cube map: +X -X +Y -Y +Z -Z.
const std::array<dvec3, 6> kFaces = {
    {{0.1, 0.2, 0.3}, {0.9, 0.5, 0.1}, {0.4, 0.8, 0.7}, {0.6, 0.3, 0.9}, {0.2, 0.6, 0.5}, {0.7, 0.1, 0.4}}};
const dvec4 kOpen = {0.8, 0.9, 0.62, 0.45}; // a texel of the occlusion map

const Defines kAll = {{"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_SURROUNDINGS", "1"}};

FunctionCase lampCase(Call call, Arguments arguments, Defines defines, Reference expected) {
    FunctionCase made = skinCase("Main.fx", std::move(call), std::move(arguments),
                                 {64, 8, 1e-5, "roots and quotients of numbers up to 300, sums of three lamps"}, std::move(expected));
    made.defines = std::move(defines);
    const auto add = [&](const char* name, dvec4 LampValues::*member) {
        for (const LampValues& lamp : kLamps)
            for (glm::length_t c = 0; c < 4; ++c)
                made.globals[name].push_back((lamp.*member)[c]);
    };
    add("gLampPlace", &LampValues::place);
    add("gLampColor", &LampValues::colour);
    add("gLampAxis", &LampValues::axis);
    add("gLampSpot", &LampValues::spot);
    made.globals["gLampBody"] = numbersOf(kCentre);
    made.globals["gLampBodyRadius"] = {kBody};
    made.globals["gSurroundings"] = {kSky};
    made.globals["gSurroundingsTurn"] = {kTurn};
    made.globals["gReflections"] = {kMirrors};
    made.globals["gOcclusionShare"] = {kOcclusion};
    made.maps["gLampsSeenMap"] = rowOfTexels(kSeen);
    made.maps["gOcclusionMap"] = oneTexel(kOpen.x, kOpen.y, kOpen.z, kOpen.w);
    TestMap cube{.size = 1, .cube = true};
    for (const dvec3& face : kFaces)
        cube.texels.push_back(texelOf(dvec4(face, 1)));
    made.maps["gEnvironmentMap"] = cube;
    return made;
}
FunctionCase lampCase(Call call, Arguments arguments, Reference expected) {
    return lampCase(std::move(call), std::move(arguments), kAll, std::move(expected));
}

dvec3 seenAt(double place) {
    const dvec4 texel = kSeen[static_cast<std::size_t>(round(place))];
    return texel.w > 0 ? dvec3(texel) / texel.w : dvec3(1);
}

struct Arriving {
    dvec3 toLight, light;
};

/// Inverse square from the distance that its colour holds at, a spot between its cosines, and what hides it by the shadow's weight.
Arriving arriving(std::size_t i, const dvec3& world, const dvec3& seen) {
    const LampValues& lamp = kLamps[i];
    const bool point = lamp.place.w > 0.5;
    const dvec3 towards = point ? dvec3(lamp.place) - world : dvec3(lamp.place);
    const dvec3 toLight = normalize(towards);
    const double falloff = lamp.colour.w > 0 ? pow(lamp.colour.w / length(towards), 2) : 1;
    const double t = std::clamp((-dot(toLight, dvec3(lamp.axis)) - lamp.spot.y) / (lamp.spot.x - lamp.spot.y), 0.0, 1.0);
    const double share = falloff * t * t * (3 - 2 * t);
    return {toLight, dvec3(lamp.colour) * share * (1 - lamp.spot.z * (1 - seen[static_cast<glm::length_t>(i)]))};
}

/// In the surroundings, which are turned about the vertical.
dvec3 inSky(const dvec3& direction) {
    const double turn = kTurn * std::numbers::pi / 180;
    return {direction.x * cos(turn) - direction.z * sin(turn), direction.y, direction.x * sin(turn) + direction.z * cos(turn)};
}

/// Of the face that a direction leads to.
dvec3 skyAt(const dvec3& direction) {
    const dvec3 d = inSky(direction);
    const dvec3 a = abs(d);
    const glm::length_t axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return kSky * kFaces[static_cast<std::size_t>(2 * axis + (d[axis] < 0 ? 1 : 0))];
}

/// How far from where two faces meet.
double fromEdge(const dvec3& direction) {
    const dvec3 d = abs(inSky(direction));
    std::array<double, 3> a = {d.x, d.y, d.z};
    std::ranges::sort(a);
    return a[2] - a[1];
}

dvec4 openAt(const dvec3& meshNormal, double weight) {
    const dvec3 stored = dvec3(kOpen) * 2.0 - 1.0; // longer than a half: a direction
    return {mix(meshNormal, normalize(stored), weight), 1 - weight * (1 - kOpen.w)};
}

dvec3 skyDirection(const dvec3& normal, const dvec3& meshNormal) {
    return normalize(normal + dvec3(openAt(meshNormal, kOcclusion)) - meshNormal);
}

dvec4 skyLight(const dvec3& normal, const dvec3& meshNormal) {
    const double open = openAt(meshNormal, kOcclusion).w;
    return {open * skyAt(skyDirection(normal, meshNormal)), open};
}

constexpr const char* kPoint =
    "LitPoint p = (LitPoint)0; p.uv = float2((a0 + 0.5) / 4.0, 0.5); p.normal = a1; p.meshNormal = a2; p.world = a3; "
    "p.albedo = a4; p.scatters = a5; ";

Arguments pointArguments() {
    return {whole(0, 3), unit(), unit(), linear(-40, 40, 3), linear(0.05, 1, 3), linear(0, 1)};
}

bool isPoint(In x) {
    const dvec3 n = x.vec3(1);
    const dvec3 m = x.vec3(2);
    if (!isUnit(n) || !isUnit(m)) return false;
    if (length(n + dvec3(openAt(m, kOcclusion)) - m) < 0.05 || fromEdge(skyDirection(n, m)) < 1e-3) return false;
    const dvec3 toEye = normalize(kSkinCamera - x.vec3(3));
    return fromEdge(reflect(-toEye, n)) > 1e-3 && abs(dot(n, toEye)) > 1e-3;
}

dvec3 lampSum(In x, bool crossing) {
    dvec3 sum(0);
    for (std::size_t i = 0; i < kLamps.size(); ++i) {
        const Arriving a = arriving(i, x.vec3(3), seenAt(x[0]));
        sum += a.light * saturate(dot(x.vec3(1), a.toLight)) * (crossing ? kSkinLeft : 1);
    }
    return sum + dvec3(skyLight(x.vec3(1), x.vec3(2))) * (crossing ? kSkinLeft : 1);
}

double intensityOf(In x) {
    return mix(kPlainIntensity, kSkinIntensity, x[5]);
}
double roughnessOf(In x) {
    return mix(kPlainRoughness, kSkinRoughness, x[5]);
}

/// By a lobe's albedo, and the share of it that is open (Lagarde and de Rousiers 2014).
dvec3 skyMirrored(In x) {
    const dvec3 toEye = normalize(kSkinCamera - x.vec3(3));
    const double cosine = dot(x.vec3(1), toEye);
    const double open = openAt(x.vec3(2), kOcclusion).w;
    const double share = std::clamp(pow(saturate(cosine) + open, exp2(-16 * roughnessOf(x) - 1)) - 1 + open, 0.0, 1.0);
    return kMirrors * intensityOf(x) * kTableAlbedo * share * skyAt(reflect(-toEye, x.vec3(1)));
}

dvec3 lampMirrored(In x, std::size_t i) {
    const Arriving a = arriving(i, x.vec3(3), seenAt(x[0]));
    const dvec3 toEye = normalize(kSkinCamera - x.vec3(3));
    return a.light * kLamps[i].spot.w * mirrored(x.vec3(1), a.toLight, toEye, roughnessOf(x), intensityOf(x));
}

Cases sums() {
    Cases cases;
    cases += lampCase({"moreIrradiance", std::string(kPoint) + "return float4(moreIrradiance(p), 0);"}, pointArguments(),
                      [](In x) { return lampSum(x, false); });
    cases += lampCase({"moreEntering", std::string(kPoint) + "return float4(moreEntering(p), 0);"}, pointArguments(),
                      [](In x) { return skinColour(x.vec3(4), kSkinMix) * lampSum(x, true); });
    cases +=
        lampCase({"moreReflected", std::string(kPoint) + "return float4(moreReflected(p, tgSafeNormalize(gCameraPosition - p.world)), 0);"},
                 pointArguments(), [](In x) { return skyMirrored(x) + lampMirrored(x, 0) + lampMirrored(x, 1) + lampMirrored(x, 2); });
    // Of surroundings the skin is entered by as much as at the cosine that mirrors the mean of even light.
    std::vector<dvec4> albedo;
    for (int column = 0; column < 64; ++column)
        albedo.emplace_back(0.1 + 0.01 * column, 0.02, 0, 0);
    cases += lampCase(
        {"moreCrossing", std::string(kPoint) + "return float4(moreCrossing(p), 0);"}, pointArguments(), {{"TEGUMENT_SURROUNDINGS", "1"}},
        [at = albedo[64 * 495 / 1000]](In x) { return dvec3(skyLight(x.vec3(1), x.vec3(2))) * (1 - kSkinIntensity * (at.x + at.y)); });
    cases.back().maps["gEnergyAttenuationMap"] = rowOfTexels(albedo);
    const std::string share = std::string(kPoint) + "LitShare s = skinShare(p, float3(0.4, 0.5, 0.6)); ";
    const auto shown = [](In x) { // of light that falls on the point
        return x.vec3(4) * (1 - x[5]) + dvec3(0.4, 0.5, 0.6) * x.vec3(4) * x[5] * kSkinLeft * kSkinLeft;
    };
    cases += lampCase({"aloneSurroundings", share + "return aloneSurroundings(s);"}, pointArguments(),
                      [=](In x) { return dvec3(skyLight(x.vec3(1), x.vec3(2))) * shown(x) + skyMirrored(x); });
    for (std::size_t i = 0; i < 3; ++i)
        cases += lampCase({i == 0 ? "aloneLamp" : "ALONE_LAMP", share + "return aloneLamp" + std::to_string(i + 1) + "(s);"},
                          pointArguments(), [=](In x) {
                              const Arriving a = arriving(i, x.vec3(3), seenAt(x[0]));
                              const double cosine = saturate(dot(x.vec3(1), a.toLight));
                              return a.light * cosine * shown(x) + lampMirrored(x, i);
                          });
    for (FunctionCase& each : cases) {
        if (each.function.starts_with("alone") || each.function == "ALONE_LAMP") addLightByLight(each);
        each.domain = isPoint;
        each.tolerance.absolute = 4e-5;
        each.tolerance.backward = 16;
    }
    return cases;
}

void parts(Cases& cases) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string lamp = "Lamp l = lampAt(" + std::to_string(i) + ", a0, a1); ";
        cases += lampCase({"lampAt", lamp + "return float4(l.light, 0);"}, {linear(-40, 40, 3), linear(0, 1, 3)},
                          [=](In x) { return arriving(i, x.vec3(0), x.vec3(1)).light; });
        cases += lampCase({"lampAt", lamp + "return float4(l.toLight, 0);"}, {linear(-40, 40, 3), linear(0, 1, 3)},
                          [=](In x) { return arriving(i, x.vec3(0), x.vec3(1)).toLight; });
        // Those beyond the ones that throw shadows are seen everywhere.
        cases += lampCase({"lampAt", lamp + "return float4(l.light, 0);"}, {linear(-40, 40, 3), linear(0, 1, 3)},
                          {{"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_LAMP_SHADOWS", "1"}},
                          [=](In x) { return arriving(i, x.vec3(0), dvec3(i == 0 ? x[1] : 1, 1, 1)).light; });
    }
    cases += lampCase("lampsSeen(float2((a0 + 0.5) / 4.0, 0.5))", {whole(0, 3)}, [](In x) { return seenAt(x[0]); });
    cases += lampCase("openSky(float2(0.5, 0.5), a0, a1)", {unit(), linear(0, 1)}, [](In x) { return openAt(x.vec3(0), x[1]); });
    cases += lampCase("surroundingsAt(a0, a1)", {unit(), linear(0, 4)}, [](In x) { return skyAt(x.vec3(0)); });
    cases.back().domain = [](In x) { return isUnit(x.vec3(0)) && fromEdge(x.vec3(0)) > 1e-3; };
}

/// A square that is fitted to the body's sphere: where a lamp stands and what it calls right and up, half its width for each mm of depth.
struct View {
    dvec3 eye, axis, right, up;
    double spread;
    bool point;

    explicit View(std::size_t i) {
        const dvec4& place = kLamps[i].place;
        point = place.w > 0.5;
        axis = normalize(point ? kCentre - dvec3(place) : -dvec3(place));
        eye = point ? dvec3(place) : kCentre - 2 * kBody * axis;
        right = normalize(cross(axis, dvec3(0, 1, 0)));
        up = cross(right, axis);
        spread = point ? tan(asin(kBody / length(kCentre - eye))) : kBody;
    }
};

void seen(Cases& cases) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string n = std::to_string(i);
        const std::string vertex =
            "TgVertexInput v = (TgVertexInput)0; v.position = a0; v.normal = a1; v.uv = a2; LampsSeenVarying o = LampsSeenVS(v); ";
        const Arguments arguments = {linear(-20, 20, 3), unit(), linear(0, 1, 2)};
        cases += lampCase({"LampsSeenVS", vertex + "return o.place[" + n + "];"}, arguments, [=](In x) {
            const View view(i);
            const dvec3 from = kSkinScale * x.vec3(0) + kSkinOrigin - view.eye;
            const double depth = dot(from, view.axis);
            const double footprint = 2 * view.spread * kSkinUnit / kTestMapSize; // mm for each unit of w
            const dvec2 across = dvec2(dot(from, view.right), dot(from, view.up)) / view.spread;
            return dvec4(across * footprint, depth * kSkinUnit, (view.point ? depth : 1) * footprint);
        });
        cases.back().tolerance.absolute = 1e-4;
        cases += lampCase({"LampsSeenVS", vertex + "return float4(o.right[" + n + "], o.uv.x);"}, arguments,
                          [=](In x) { return dvec4(View(i).right, x[2]); });
        // the map's own place
        cases += lampCase({"LampsSeenVS", vertex + "return o.position;"}, arguments,
                          [](In x) { return values(2 * x[2] - 1, 1 - 2 * x.scalar(2, 1), 0, 1); });
    }
}

constexpr const char* kReceiver =
    "LampReceiver r = (LampReceiver)0; r.place = float4(a0 * 0.4, 0.0, 0.4); r.depth = a1; r.slope = a2; r.cosine = a3; "
    "r.texel = a4; r.way = float2(0.6, 0.8); ";

/// Squares of 16 texels at 600 mm, and nothing between them: what lets light through depends on how wide a penumbra is.
TestMap chequered() {
    return mapOf(kTestMapSize, kTestMapSize, [](int x, int y) { return texelOf((x / 16 + y / 16) % 2 == 0 ? 600 : 0); });
}

/// Regression checks: the same calls of functions of hlsl/shadow, which have cases of their own, with sizes worked out here.
Cases open() {
    Cases cases;
    const Arguments arguments = {linear(-0.8, 0.8, 2), linear(640, 1200), linear(-0.5, 0.5, 2), linear(0.1, 1), linear(0.5, 30)};
    for (std::size_t i = 0; i < 3; ++i) {
        const View view(i);
        const double radius = kLamps[i].axis.w;
        const double near = kSkinUnit * ((view.point ? length(kCentre - view.eye) : 2 * kBody) - kBody);
        // Parallel light: the tangent of the half angle whose sine is given.
        const double wide = view.point ? radius * kSkinUnit : tan(asin(radius));
        char size[200];
        std::snprintf(size, sizeof size, "float2(%.9g, %s), %.9g", wide, view.point ? "1.0" : "0.0",
                      view.point ? max(near, 2 * wide) : near);
        const std::string n = std::to_string(i);
        const std::string maps = "gTsmMap, gTsm, gShadowMap, gShadow, ";
        cases += lampCase({"lampOpen", std::string(kReceiver) + "return float4(lampOpen(" + maps + n + ", r) - tgShadowSoft(" + maps +
                                           "tgShadowCoordinate(r.place), r.depth, r.slope, 0.4, " + size + ", r.way), 0, 0, 0);"},
                          arguments, {{"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_SOFT_SHADOWS", "1"}}, [](In) { return 0; });
        cases += lampCase({"lampOpen", std::string(kReceiver) + "return float4(lampOpen(" + maps + n + ", r) - tgShadowDiscSpared(" + maps +
                                           "tgShadowCoordinate(r.place), r.depth, r.slope, float2(0.0, " + (view.point ? "1.0" : "0.0") +
                                           "), clamp(0.56 * a4 * a3 / 0.4, 1.7, 13.0), float2(1.0, 0.0)), 0, 0, 0);"},
                          arguments, {{"TEGUMENT_LAMPS", "3"}}, [](In) { return 0; });
    }
    // What hides a point from a lamp is held against its depth, less the tolerance, in setting seed a share of the body, and less what the
    // surface falls within a texel.
    for (int setting : {0, 2}) {
        const double tolerance = kSkinTolerance * (setting == 0 ? 2 * kBody * kSkinUnit : 1);
        const std::string body =
            "LampReceiver r = (LampReceiver)0; r.texel = 3.0; LampsSeenVarying v = (LampsSeenVarying)0; v.place[0] = float4(a0 * 0.4, a1, "
            "0.4); "
            "v.right[0] = float3(0.8, 0, 0.6); v.world = float3(10, 20, 30); float3 axis = tgLampAxis(gLampPlace[0], gLampBody); "
            "float3 toLight = tgSafeNormalize(gLampPlace[0].xyz - v.world); float seen = lampSeen(gTsmMap, gTsm, gShadowMap, gShadow, 0, "
            "v, a2, r); "
            "r.place = v.place[0]; r.cosine = dot(a2, toLight); "
            "r.slope = tgShadowPlanarSlope(a2, v.right[0], cross(v.right[0], axis), toLight, axis, 0.4); r.depth = a1 - abs(r.slope.x) - "
            "abs(r.slope.y) - " +
            std::to_string(tolerance) +
            "; float open = r.cosine > 0.0 ? saturate(100.0 * r.cosine) * lampOpen(gTsmMap, gTsm, gShadowMap, gShadow, 0, r) : 0.0; "
            "return float4(seen - open, 0, 0, 0);";
        cases += lampCase({"lampSeen", body}, {linear(-0.8, 0.8, 2), linear(setting == 0 ? 610 : 596, setting == 0 ? 640 : 606), unit()},
                          {{"TEGUMENT_LAMPS", "3"}}, [](In) { return 0; });
        cases.back().settings = {setting};
    }
    // Another way of the first tap from texel to texel of the skin: interleaved gradient noise.
    cases += lampCase({"LampsSeenPS",
                       "LampsSeenVarying v = (LampsSeenVarying)0; v.place[0] = float4(a0 * 0.4, a1, 0.4); v.right[0] = float3(0.8, 0, "
                       "0.6); v.world = float3(10, 20, 30); v.normal = a2; v.uv = a3; LampReceiver r = (LampReceiver)0; float2 texel = "
                       "floor(a3 * 256.0); float turn = 6.28318531 * frac(52.9829189 * frac(0.06711056 * texel.x + 0.00583715 * "
                       "texel.y)); sincos(turn, r.way.y, r.way.x); return float4(LampsSeenPS(v).x - lampSeen(gLampShadow1Map, "
                       "gLampShadow1, gLampBlocks1Map, gLampBlocks1, 0, v, normalize(a2), r), 0, 0, 0);"},
                      {linear(-0.8, 0.8, 2), linear(640, 1200), unit(), linear(0, 1, 2)},
                      {{"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_SOFT_SHADOWS", "1"}}, [](In) { return 0; });
    cases.back().domain = [](In x) { return length(x.vec3(2)) > 0.5; };
    cases.back().maps["gLampShadow1Map"] = chequered();
    cases.back().maps["gLampBlocks1Map"] = oneTexel(1, 0, 0, 1000);
    for (FunctionCase& each : cases) {
        if (each.function == "lampOpen") each.maps["gTsmMap"] = chequered();
        each.map = &shadowMap();
        each.maps["gShadowMap"] = oneTexel(1, 0, 0, 1000); // blocks that settle nothing
        // A radius that differs by its last digit may move a tap over the border of a texel.
        each.tolerance = {0, 0, 0.07, "the same taps, but for one"};
    }
    return cases;
}

} // namespace

Cases lampPassCases() {
    return together(sums(), parts, seen, open());
}

} // namespace tegument::test
