// What vertices and pixels of a coat of locks come to (effects/passes/fur_locks.fxh, fur_opacity.fxh, fur_ribbons.fxh) in double precision.
// Where a whole vertex shader is asked, the coat has no thickness: strands stand upright on their roots, and only what is asked for is
// left.

#include "tests/hlsl/fur_light.h"
#include "tests/hlsl/lock_scene.h"
#include "tests/hlsl/maps.h"

namespace tegument::test {

namespace {

constexpr double kThick = kLockLength * kLockMesh;
const dvec3 kEye = {0, 0, 600};

FunctionCase lockCase(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    const Globals more = {{"gWorldInverseTranspose", kLockScene.at("gWorld")},
                          {"gCameraPosition", numbersOf(kEye)},
                          {"gFurDown", {0, -1, 0}},
                          {"gFurEdge", {0.4}},
                          {"gFurCut", {0.3}},
                          {"gRibbonThin", {0.7}},
                          {"gCoatShadowStrands", {2}}};
    return passCase("FurCoat.fx", with(with(kLockScene, kFurView), more), std::move(call), std::move(arguments), std::move(tolerance),
                    std::move(expected));
}

double sineBetween(const dvec3& a, const dvec3& b) {
    return abs(sin(atan2(length(cross(a, b)), dot(a, b))));
}

/// Of underfur, which is dull.
double dull(const dvec3& normal, const dvec3& tangent, const dvec3& light) {
    return sineBetween(tangent, light) * (0.2 + 0.8 * share((dot(normal, light) + 0.4) / 1.4));
}

FunctionCase lamps() {
    FunctionCase made =
        lockCase({"lockLamps", "LockPoint p = (LockPoint)0; p.normal = a0; p.tangent = a1; p.toEye = a0; p.albedo = a2; p.along = 0.5; "
                               "p.height = a3; return float4(lockLamps(p, float3(1, 2, 3), 1.0, (TgVertexInput)0), 0);"},
                 {unit(), unit(), linear(0, 1, 3), linear(0, 1)},
                 {16, 8, 1e-3, "sines are roots of differences that are 1e-7 off, of three lamps"}, [](In x) {
                     dvec3 sum(0);
                     for (std::size_t i = 0; i < kFurLampWays.size(); ++i) {
                         const double over = share(1 + dot(x.vec3(0), kFurLampWays[i]) / 0.4); // beyond the horizon it ends
                         const double open = exp(-0.9 * (1 - x[3])) * over;
                         sum += kFurLampColours[i] * open * dull(x.vec3(0), x.vec3(1), kFurLampWays[i]);
                     }
                     return sum * x.vec3(2);
                 });
    addLamps(made);
    made.domain = [](In x) { return isUnit(x.vec3(0)) && isUnit(x.vec3(1)); };
    return made;
}

constexpr const char* kColourBody =
    "LockLooks l = (LockLooks)0; l.strand.normal = a0; l.waves = -1.0; l.more = float3(a5.x, 0, 0); l.lock = float3(0, a5.y, 0); "
    "l.random = 0.5; TgRibbon r; r.along = a3.x; r.shortness = a3.y; r.color = 0.25; RibbonFrame f = (RibbonFrame)0; f.toEye = a4; "
    "f.toLight = a6; float3 color = lockColor(l, r, f, a2, a1, a7, false, (TgVertexInput)0); return float4(color, 0);";

/// Arguments as they stand in the body.
struct Coloured {
    dvec3 normal, tangent, offset, toEye, toLight;
    double far, along, height, albedo;

    explicit Coloured(In x)
        : normal(x.vec3(0)), tangent(x.vec3(1)), offset(x.vec3(2)), toEye(x.vec3(4)), toLight(x.vec3(6)),
          far(share((kFurPixel * length(toEye) / kThick - 0.05) / 0.2)), along(mix(x[3], 0.5, far)),
          height(0.8 * kThick * (1 - 0.55 * x.scalar(3, 1))) {
        const double vary = 0.4 * (1 - far); // no place of a strand shows from afar, but what many are on average
        albedo = (0.5 + 0.5 * 0.25 * (0.35 + 0.65 * along)) * (1 + vary * (x[5] - 0.5)) * (1 + vary * (x.scalar(5, 1) - 0.5));
    }
    /// Between the bottom and the top of the coat.
    [[nodiscard]] double up() const { return share(mix(dot(offset, normal) / height, 0.5, far)); }
    [[nodiscard]] bool plain() const { return isUnit(normal) && isUnit(tangent) && length(toEye) > 10 && length(toLight - offset) > 1; }
};

/// There is light, but skin before all strands: what surroundings throw back is left.
void hide(FunctionCase& made) {
    made.globals["gLightColor"] = numbersOf(kFurColour);
    made.maps["gCoatSkinMap"] = oneTexel(1e-3F);
}

void colours(Cases& cases) {
    const Arguments arguments = {unit(),          unit(),           linear(-3, 3, 3), linear(0, 1, 2), vector(3, 100, 1500),
                                 linear(0, 1, 2), vector(3, 8, 20), whole(0, 1)};
    const auto add = [&](Reference expected) {
        cases += lockCase({"lockColor", kColourBody}, arguments, {32, 8, 1e-3, "sines are roots of differences; gaps of a coat squared"},
                          std::move(expected));
        whiten(cases.back());
        cases.back().domain = [](In x) { return Coloured(x).plain(); };
    };
    add([](In x) { // light alone, on strands without highlights
        const Coloured c(x);
        return kFurColour * c.albedo * dull(c.normal, c.tangent, normalize(c.toLight - c.offset));
    });
    cases.back().globals["gLightColor"] = numbersOf(kFurColour);
    setAll(cases.back(), {"gCoatShine", "gCoatSheen", "gCoatThrough"}, {0});
    add([](In x) { // of parallel light, which comes from the same direction wherever the strand is
        const Coloured c(x);
        return kFurColour * c.albedo * dull(c.normal, c.tangent, normalize(c.toLight));
    });
    cases.back().globals["gLightColor"] = numbersOf(kFurColour);
    cases.back().globals["gLightViewProjection"] = {0.01, 0, 0, 0, 0, 0.01, 0, 0, 0, 0, -0.002, 0, 0, 0, 0.9, 1};
    setAll(cases.back(), {"gCoatShine", "gCoatSheen", "gCoatThrough"}, {0});
    cases.back().domain = [](In x) { return Coloured(x).plain() && length(x.vec3(6)) > 1; };
    add([](In x) { // sky and ground alike: what the coat around leaves of them
        const Coloured c(x);
        const double gap = (0.2 + 0.8 * share(1.1 * c.up())) * (0.55 + 0.45 * share(1.4 * c.along));
        return kFurColour * dvec3(0.5, 0.6, 0.7) * c.albedo * gap * gap;
    });
    hide(cases.back());
    cases.back().globals["gCoatSky"] = cases.back().globals["gCoatGround"] = {0.5, 0.6, 0.7};
    add([](In x) { // the rim, which underfur has none of
        const Coloured c(x);
        const double edge = 1 - share(dot(c.normal, normalize(c.toEye - c.offset)));
        const double above = share(0.6 + 0.4 * c.normal.y);
        return x[7] > 0.5 ? dvec3(0) : kFurColour * kLockRim * (0.05 + c.albedo) * edge * edge * c.along * above;
    });
    hide(cases.back());
    cases.back().globals["gCoatRim"] = numbersOf(kLockRim);
}

/// Strands of no length, and no shadow.
void flatten(FunctionCase& made) {
    straighten(made);
    for (const char* name : {"gCoatSkinMap", "gCoatFrontMap", "gCoatOpacityMap", "gShadowMap"})
        made.maps[name] = oneTexel(0);
    made.globals["gCoatWind"] = {0, 0, 0};
    made.globals["gCoatGuard"] = {0.5};
    made.globals["gFurLength"] = {1e-6};
}

constexpr const char* kVertexBody =
    "TgVertexInput i = (TgVertexInput)0; i.normal = float3(0, 0, 1); i.position = a0; i.tangent.w = a2 > 0.5 ? 1 : "
    "-1; i.uv = float2(a3 / 32.0, a1); ";

/// Arguments: position, address, side, row of 31, child.
struct Strand {
    dvec3 position;
    double address, side, along, child;

    explicit Strand(In x)
        : position(x.vec3(0)), address(round(x[1])), side(x[2] > 0.5 ? 1 : -1), along(round(x[3]) / 31), child(round(x[4])) {}
};

Arguments strandArguments(int children) {
    return {linear(-300, 300, 3), whole(4096, 4000000), whole(0, 1), whole(0, 31), whole(0, children)};
}

bool seen(const Strand& s) { // what looks away by more than a strand reaches is left out; the coat is at least 0.28 / 4 long for that
    const dvec3 toEye = kEye - s.position;
    return toEye.z > -sin(acos(1 / 1.42)) * length(toEye);
}

void vertices(Cases& cases) {
    for (const int under : {0, 1}) {
        const auto sharedOf = [=](In x) {
            const Strand s(x);
            const double pixel = kFurPixel * length(kEye - s.position);
            return under ? LockShare(pixel, 1.05, 3, s.child + rootRank(s.address))
                         : LockShare(pixel, 0.7, 4, s.child + rootRank(s.address));
        };
        cases += lockCase({"lockVarying", std::string(kVertexBody) + "RibbonVarying v = lockVarying(i, a4, " + (under ? "1.0" : "0.0") +
                                              ", false" + "); return float4(v.edge, v.color.w, 0);"},
                          strandArguments(under ? 2 : 3), {32, 2, 2e-3, "ranks of addresses to 1e-3, eight times"}, [=](In x) {
                              const Strand s(x);
                              const LockShare shared = sharedOf(x);
                              if (shared.rank >= shared.share || !seen(s)) return values(0);
                              const double place = under ? s.along : max(s.along, shared.begin);
                              const double pixel = kFurPixel * length(kEye - s.position);
                              const double radius = shared.width * lockRadius(s.address, s.child, under == 1, place) / pixel;
                              const double half = max(radius, 0.5);
                              const double thin = 2 * kLockRadius * kLockMesh / pixel;
                              const bool afar = !under && thin / 0.7 < kLockAfar / 0.7 * shared.share;
                              return values(s.side * (half + 0.4), half, (afar ? -1 : 1) * radius / half);
                          });
        flatten(cases.back());
        cases.back().domain = [=](In x) {
            const Strand s(x);
            const LockShare shared = sharedOf(x);
            const double fraction = rootRank(s.address);
            const double pixel = kFurPixel * length(kEye - s.position);
            const dvec3 toEye = kEye - s.position;
            return abs(shared.rank - shared.share) > 2e-3 && min(fraction, 1 - fraction) > 2e-3 && length(toEye) > 50 &&
                   abs(toEye.z / length(toEye) + 0.71) > 0.01 && abs(2 * kLockRadius * kLockMesh / pixel - kLockAfar * shared.share) > 1e-3;
        };
    }
}

/// From the light; a texel of the map of 1,024 is a pixel, or one of the picture where that is coarser.
void opacities(Cases& cases) {
    const auto pixelOf = [](const Strand& s) {
        const double texel = 2 * (300 - s.position.z) / 2.5 / 256;
        return max(texel, 0.0);
    };
    const auto sharedOf = [=](In x) {
        const Strand s(x);
        const double rank = rootRank(s.address) + 0.5;
        const double coarser = max(pixelOf(s), kFurPixel * length(kEye - s.position));
        return LockShare(coarser, 0.7, 2, s.child + rank - floor(rank));
    };
    const auto drawn = [=](In x) { return sharedOf(x).rank < sharedOf(x).share; };
    const auto domain = [=](In x) {
        const double rank = rootRank(Strand(x).address) + 0.5;
        const double fraction = rank - floor(rank);
        return abs(sharedOf(x).rank - sharedOf(x).share) > 2e-3 && min(fraction, 1 - fraction) > 2e-3 && pixelOf(Strand(x)) > 0.01;
    };
    const auto add = [&](const char* returned, Reference expected, Tolerance tolerance) {
        cases += lockCase({"OpacityVS", std::string(kVertexBody) + "OpacityVarying v = OpacityVS(i, (uint)a4); return " + returned + ";"},
                          {linear(-90, 90, 3), whole(4096, 4000000), whole(0, 1), whole(0, 31), whole(0, 1)}, std::move(tolerance),
                          std::move(expected));
        flatten(cases.back());
        cases.back().defines.emplace_back("TEGUMENT_SHADOW_SIZE", "256");
        cases.back().globals["gCoatRadius"] = {kLockRadius};
        cases.back().domain = domain;
    };
    const auto radiusOf = [=](In x) { // pixels
        const Strand s(x);
        return sharedOf(x).width * lockRadius(s.address, s.child, false, s.along) / pixelOf(s);
    };
    const auto halfOf = [=](In x) { return max(radiusOf(x), 0.5); };
    add("float4(v.edge, v.place.w)",
        [=](In x) {
            if (!drawn(x)) return values(0);
            const Strand s(x);
            const double faint = radiusOf(x) / halfOf(x) * (4 + 0.3 * 3) / 2; // as opaque as all of the lock
            return values(s.side * (halfOf(x) + 0.4), halfOf(x), faint, length(kFurLamp - s.position));
        },
        {32, 2, 1e-2, "ranks to 5e-4, of two strands, by a share of 0.3, eight times, of 2.45"});
    add("float4(v.place.xyz, 0)",
        [=](In x) {
            if (!drawn(x)) return values(0, 0, 1);
            const Strand s(x);
            const dvec3 aside = normalize(cross(dvec3(0, 0, 1), kFurLamp - s.position));
            const dvec3 world = s.position + s.side * (halfOf(x) + 0.4) * pixelOf(s) * aside;
            return values(2.5 * (world.x - kFurLamp.x), 2.5 * (world.y - kFurLamp.y), 300 - world.z);
        },
        {16, 2, 0.02, "as above, in mm of up to 1.6, times 2.5"});
}

/// A map of depths that differ from texel to texel.
const TestMap& steppedMap() {
    static const TestMap kMap = mapOf(256, 256, [](int x, int y) { return texelOf(y % 3 == 0 ? 0 : 285 + (7 * y + 3 * x) % 23); });
    return kMap;
}

bool insideTexel(double coordinate) {
    const double t = 256 * coordinate - floor(256 * coordinate);
    return min(t, 1 - t) > 0.01;
}

void pixels(Cases& cases) {
    const auto coverage = [](In x) { return abs(x[2]) * share(x[1] + 0.5 - abs(x[0])); };
    const char* made = "RibbonVarying r = (RibbonVarying)0; r.color = float4(0.1, 0.2, 0.3, a2); r.edge = float2(a0, a1); ";
    const Arguments edges = {linear(-2, 2), linear(0.5, 1), linear(-1, 1)};
    const auto add = [&](const char* function, auto kept) {
        cases += lockCase({function, std::string(made) + "return " + function + "(r);"}, edges, {8, 4, 1e-6, "sums of numbers up to 2"},
                          [=](In x) {
                              const double alpha = kept(coverage(x), x[2]);
                              return alpha < 0 ? kDiscarded : values(0.1, 0.2, 0.3, alpha);
                          });
        cases.back().discards = true;
        cases.back().domain = [=](In x) { // from where something is left out or not
            const double c = coverage(x);
            return min({abs(c - 0.5), abs(c - 0.3), abs(c - 0.004), abs(x[2] - 0.7)}) > 1e-5;
        };
    };
    add("UnderfurPS", [](double c, double) { return c < 0.5 ? -1.0 : 1.0; });
    add("UnderfurSoftPS", [](double c, double) { return c < 0.3 ? -1 : c; });
    add("RibbonCorePS", [](double c, double faint) { return c < 0.5 || faint < 0.7 ? -1.0 : 1.0; });
    add("RibbonSoftCorePS", [](double c, double faint) { return c < 0.3 || faint < 0.7 ? -1 : c; });
    add("RibbonFringePS", [](double c, double faint) { return (c < 0.5 || faint < 0.7) && c > 0.004 ? c : -1; });
    add("RibbonSoftFringePS", [](double c, double faint) { return (c < 0.3 || faint < 0.7) && c > 0.004 ? c : -1; });

    cases += lockCase(
        {"OpacityPS",
         "OpacityVarying o; o.position = 0; o.edge = float3(0, 1, 1); o.place = float4(a0 * a1, a2 * a1, a1, a3); return OpacityPS(o);"},
        {linear(-1, 1), linear(1, 300), linear(-1, 1), linear(280, 310)}, {8, 4, 2e-4, "a depth to 1e-5, 16 times"}, [](In x) {
            const double front = steppedMap().at({0.5 + 0.5 * x[0], 0.5 - 0.5 * x[2]}).x;
            const double depth = front > 0 ? (x[3] - front) / kThick : 0;
            const auto layer = [&](double end) { return share(16 * (end - depth) + 0.5); };
            return values(layer(0.25), layer(0.6), layer(1.2), layer(2.4));
        });
    cases.back().maps["gCoatFrontMap"] = &steppedMap();
    cases.back().domain = [](In x) { return insideTexel(0.5 + 0.5 * x[0]) && insideTexel(0.5 - 0.5 * x[2]); };
    // two taps, 1.05 texels above and below: the skin's shadow alone
    cases += lockCase("coatOpen(a0, 0.01)", {linear(-60, 60, 3)}, {8, 2, 1e-4, "distances of 300 mm to 3e-5, by 2.4"}, [](In x) {
        const dvec3 from = x.vec3(0) - kFurLamp;
        const dvec2 place(0.5 + 1.25 * from.x / -from.z, 0.5 - 1.25 * from.y / -from.z);
        double open = 1;
        for (const double side : {-1.05, 1.05}) {
            const double skin = steppedMap().at(place + dvec2(0, side / 256)).x;
            if (skin > 0) open -= 0.5 * share((length(from) - skin) / (0.5 * kThick));
        }
        return open;
    });
    for (const char* name : {"gCoatFrontMap", "gCoatOpacityMap"})
        cases.back().maps[name] = oneTexel(0);
    cases.back().maps["gCoatSkinMap"] = &steppedMap();
    cases.back().domain = [](In x) {
        const dvec3 from = x.vec3(0) - kFurLamp;
        const dvec2 place(0.5 + 1.25 * from.x / -from.z, 0.5 - 1.25 * from.y / -from.z);
        return insideTexel(place.x) && insideTexel(place.y + 1.05 / 256) && insideTexel(place.y - 1.05 / 256);
    };
    cases += lockCase({"CoatFrontVS", "TgVertexInput i = (TgVertexInput)0; i.normal = a0; i.position = a1; return "
                                      "float4(CoatFrontVS(i).light, CoatSkinVS(i).light.x, 0);"},
                      {unit(), linear(-80, 80, 3)}, {8, 2, 1e-4, "lengths of 400"}, [](In x) { // moved out by the coat, whose tips hang
                          const dvec3 tip = x.vec3(1) + kThick * (x.vec3(0) + dvec3(0, -0.25, 0));
                          const dvec3 toLight = kFurLamp - tip;
                          return values(length(toLight), dot(x.vec3(0), toLight) / length(toLight), length(kFurLamp - x.vec3(1)));
                      });
    cases.back().globals["gFurLean"] = {0.25};
    cases.back().domain = [](In x) { return isUnit(x.vec3(0)); };
    // Behind the skin, and from inside where there is no skin, the front gapes.
    const std::string front =
        "CoatFrontVarying i = (CoatFrontVarying)0; i.light = float2(a0, a1); i.place = float3(0, 0, 1); return CoatFrontPS(i);";
    for (const double skin : {400.0, 0.0}) {
        cases += lockCase({"CoatFrontPS", front}, {linear(100, 800), linear(-1, 1)}, {8, 2, 1e-4, "a difference of lengths of 400"},
                          [skin](In x) {
                              const bool gapes = skin > 0 ? x.scalar(0) > skin : x.scalar(1) < 0;
                              return values(!gapes ? x.scalar(0) : skin > 0 ? skin - kThick : -0.1, 0, 0, 1);
                          });
        cases.back().maps["gCoatSkinMap"] = oneTexel(static_cast<float>(skin));
        cases.back().domain = [](In x) { return x.scalar(0) > 1 && std::abs(x.scalar(0) - 400) > 1e-3 && std::abs(x.scalar(1)) > 1e-4; };
    }
}

/// Sums of opacity that tell the level that they were read from.
const TestMap& opacityLevels() {
    static const TestMap kMap = leveledMap(false, [](int mip) { return texelOf(dvec4(mip + 1)); });
    return kMap;
}

/// Light is blurred across 1.25 pixels of the picture, and at least 1.4 texels of the map. Here the nearest level is read.
void levels(Cases& cases) {
    for (const bool parallel : {false, true}) {
        const double texel = parallel ? 2.0 / 256 * 100 : 2.0 / 256 * 300 / 2.5; // mm, amid the mesh
        const auto levelOf = [=](In x) { return log2(max(1.25 * x[0] / texel, 1.4)); };
        cases += lockCase("coatOpen(0.0, a0)", {linear(0.1, 8)}, {8, 0, 0, "an exponential"},
                          [=](In x) { return exp(-0.1 * (1 + round(levelOf(x)))); });
        cases.back().maps = {{"gCoatSkinMap", oneTexel(0)}, {"gCoatFrontMap", oneTexel(1)}, {"gCoatOpacityMap", &opacityLevels()}};
        cases.back().globals["gCoatShadow"] = {0.1};
        if (parallel) cases.back().globals["gLightViewProjection"] = {0.01, 0, 0, 0, 0, 0.01, 0, 0, 0, 0, -0.002, 0, 0, 0, 0.9, 1};
        cases.back().domain = [=](In x) { return abs(levelOf(x) - floor(levelOf(x)) - 0.5) > 0.01; };
    }
}

} // namespace

Cases lockPassCases() {
    return together(lamps(), colours, vertices, opacities, pixels, levels);
}

} // namespace tegument::test
