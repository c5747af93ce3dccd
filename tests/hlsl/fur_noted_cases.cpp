// What compute shaders note of strands, and what vertices read of it (effects/passes/fur_compute.fxh), in double precision. What they store
// is a variable here: the last row that a thread notes.

#include "tests/hlsl/strand_roots.h"

namespace tegument::test {

namespace {

constexpr double kColumns = 1366; // roots in a row of their texture, three texels each
constexpr double kRootRows = 256;

constexpr double kFirst = 3 * 4096 + 5; // address of the first root

/// Column and row of a root in the maps.
dvec2 columnOf(double address) {
    const std::int64_t whole = std::llround(address);
    return {static_cast<double>(whole % 4096 / 3), static_cast<double>(whole / 4096 - 3)};
}

/// A header of which the address of the first root alone is read.
const TestMap& placesMap() {
    static const TestMap kMap = [] {
        TestMap map{.size = 4096, .texels = std::vector<std::array<float, 4>>(4096), .height = 1};
        map.texels[6] = {static_cast<float>(kFirst), 0, 0, 0};
        return map;
    }();
    return kMap;
}

Cases places() {
    const Tolerance exact{0, 0, 0, "whole numbers"};
    Cases cases;
    cases += strandRootCase("ribbonColumn(a0)", {whole(3 * 4096 + 5, 1000000)}, exact, [](In x) { return columnOf(x[0]); });
    // of the first row the texels before the first root are the header's
    cases += strandRootCase("ribbonAddress(float2(a0, a1))", {whole(0, 1364), whole(0, 255)}, exact, [](In x) {
        const double column = 3 * round(x[0]) + (x[1] < 0.5 ? 2 : 0);
        return 4096 * (3 + round(x[1])) + column;
    });
    // rows of a strand below each other, strands of a lock too, locks too
    cases += strandRootCase({"lockTexel", "return float4(lockTexel(float2(a0, a1), a2, a3), lockStrands(), lockRows());"},
                            {whole(0, 1365), whole(0, 255), whole(0, 6), whole(0, 3)}, exact, [](In x) {
                                const double strand = 7 * round(x[1]) + round(x[2]);
                                return values(round(x[0]), 4 * strand + round(x[3]), 7, 4);
                            });
    cases.back().globals["gCoatChildren"] = {4};
    cases.back().globals["gCoatUnderfur"] = {3};
    cases += strandRootCase("strandTexel(float2(a0, a1), a2)", {whole(0, 1365), whole(0, 255), whole(0, 6)}, exact,
                            [](In x) { return values(round(x[0]), 7 * round(x[1]) + round(x[2])); });
    const char* vertex = "TgVertexInput i = (TgVertexInput)0; i.position = a3; i.tangent = float4(a3.yzx, a2 > 0.5 ? 1 : -1); "
                         "i.uv = float2(70.0 + a1 / 32.0, a0); RootVarying v = RibbonRootsVS(i); ";
    const auto add = [&](const char* returned, Reference expected) {
        cases += strandRootCase({"RibbonRootsVS", std::string(vertex) + "return " + returned + ";"},
                                {whole(4000, 1000000), whole(0, 31), whole(0, 1), linear(-1, 1, 3)},
                                {4, 0, 1e-6, "a quotient and a sum of up to 2"}, std::move(expected));
    };
    // A regression check: the ribbon's corners within its root's texel, none of whose edges meets the centre.
    add("v.position", [](In x) {
        if (x[0] < 4095.5) return values(2, 2, 2, 1);
        const double side = x[2] > 0.5 ? 0.85 : 0.05;
        const dvec2 at = columnOf(x[0]) + dvec2(side, 0.15 + 0.8 * round(x[1]) / 31);
        return values(2 * at.x / kColumns - 1, 1 - 2 * at.y / kRootRows, 0.5, 1);
    });
    cases.back().domain = [](In x) { return x[0] < 4095.5 || x[0] > kFirst - 0.5; };
    add("float4(v.place.xyz, v.place.w)", [](In x) { return dvec4(x.vec3(3), 70.5); });
    add("v.flow", [](In x) { return values(x.scalar(3, 1), x.scalar(3, 2), x.scalar(3, 0), 1); });
    for (FunctionCase& each : cases)
        each.maps["gFurRootsMap"] = &placesMap();
    return cases;
}

/// Arguments: place of the root in the world, way to the eye, offset, tangent (of the mesh at rest), radius, afar.
struct Noted {
    double pixel, half;
    dvec3 aside, place;

    explicit Noted(In x) {
        const dvec3 toEye = x.vec3(1) - x.vec3(2);
        pixel = kFurPixel * length(toEye);
        half = max(x[4], pixel / 2);
        aside = furTurned(normalize(cross(x.vec3(3), toEye)));
        place = x.vec3(0) + furTurned(x.vec3(2));
    }
};

void notes(Cases& cases) {
    const char* body = "RibbonFrame f = (RibbonFrame)0; f.world = a0; f.toEye = a1; RibbonPlace p; p.offset = a2; p.tangent = a3; "
                       "ribbonNote(uint2(0, 0), (TgVertexInput)0, f, p, a4, float3(0.1, 0.2, 0.3), a5); ";
    const auto add = [&](const char* returned, Reference expected) {
        cases += strandRootCase({"ribbonNote", std::string(body) + "return " + returned + ";"},
                                {linear(-80, 80, 3), vector(3, 150, 400), linear(-50, 50, 3), unit(), logarithmic(0.02, 2), linear(-1, 1)},
                                {16, 4, 1e-5, "lengths, quotients, sums of up to 130"}, std::move(expected));
        cases.back().domain = [](In x) {
            const dvec3 toEye = x.vec3(1) - x.vec3(2);
            return isUnit(x.vec3(3)) && length(toEye) > 50 && x[4] > 0.01 && length(cross(x.vec3(3), toEye)) > 0.05 * length(toEye);
        };
    };
    add("gRibbonPlaceStore", [](In x) { return dvec4(Noted(x).place, Noted(x).half + 0.4 * Noted(x).pixel); });
    add("gRibbonAsideStore", [](In x) { return dvec4(Noted(x).aside, Noted(x).half / Noted(x).pixel); });
    add("gRibbonLightStore", [](In x) { return values(0.1, 0.2, 0.3, (x[5] < 0 ? -1 : 1) * x[4] / Noted(x).half); });
}

/// Maps of one texel: the axis in the world and how far the ribbon's sides are; the way there and half the width; colour and faintness.
void readings(Cases& cases) {
    const char* body =
        "TgVertexInput i = (TgVertexInput)0; i.tangent.w = a0 > 0.5 ? 1 : -1; RibbonVarying v = ribbonNoted(i, float2(3, 5)); ";
    const auto add = [&](const char* returned, Reference expected) {
        cases += strandRootCase({"ribbonNoted", std::string(body) + "return " + returned + ";"}, {whole(0, 1), linear(0, 1)},
                                {8, 0, 1e-4, "sums of up to 400"}, std::move(expected));
        cases.back().maps["gRibbonPlaceMap"] = oneTexel(30, -20, 10, 1.5);
        cases.back().maps["gRibbonAsideMap"] = oneTexel(0.6, 0, 0.8, 2.5);
        cases.back().maps["gRibbonLightMap"] = oneTexel(0.1, 0.2, 0.3, -0.7);
    };
    add("v.position", [](In x) {
        const double side = x[0] > 0.5 ? 1.5 : -1.5;
        return furClip(dvec3(30, -20, 10) + side * dvec3(0.6, 0, 0.8));
    });
    add("float4(v.edge, v.color.xw)", [](In x) { return values(x[0] > 0.5 ? 2.9 : -2.9, 2.5, 0.1, -0.7); });
}

/// A root in the middle of the mesh, or anywhere in its map; combed to (0.2, 0.3, 0.4).
void withRoot(FunctionCase& made, const TestMap& place, const TestMap& flow) {
    made.maps["gRibbonRootMap"] = &place;
    made.maps["gRibbonFlowMap"] = &flow;
}

const TestMap& filled(bool rooted) {
    static const auto make = [](std::array<float, 4> texel) {
        return TestMap{.size = 64, .texels = std::vector<std::array<float, 4>>(64 * 64, texel)};
    };
    static const TestMap kPlace = make({12, -7, 5, 70.5F});
    static const TestMap kFlow = make({0.2F, 0.3F, 0.4F, 1});
    return rooted ? kPlace : kFlow;
}

double addressOf(double column, double row) {
    return 4096 * (1 + row) + 3 * column + (row < 0.5 ? 1 : 0);
}

Cases threads() {
    Cases cases;
    cases += strandRootCase({"ribbonRootAt", "TgVertexInput i = ribbonRootAt(uint2(a0, 0)); return float4(i.tangent.xyz, i.tangent.w);"},
                            {whole(0, 63)}, {1, 0, 0, "what the map holds"}, [](In) { return values(0.2, 0.3, 0.4, 1); });
    cases +=
        strandRootCase({"ribbonRootAt", "TgVertexInput i = ribbonRootAt(uint2(a0, 0)); return float4(i.position.xy, i.uv);"},
                       {whole(0, 63)}, {1, 0, 0, "what the map holds"}, [](In x) { return values(12, -7, 70, addressOf(round(x[0]), 0)); });
    for (FunctionCase& each : cases)
        withRoot(each, filled(true), filled(false));
    const double distance = length(kFurEye - furWorld({12, -7, 5}));
    cases += strandRootCase(
        {"StrandsCS", "StrandsCS(uint3(a0, 0, a1)); return float4(gRibbonAsideStore.w, gRibbonLightStore.w, gRibbonPlaceStore.w, 0);"},
        {whole(0, 63), whole(0, 7)}, {32, 0, 2e-5, "a distance of 500 to 3e-5"}, [=](In x) { // a thread for each row of a strand of seven
            const double address = addressOf(round(x[0]), 0);
            const double row = round(x[1]);
            if (rootRank(address) >= kStrandShare || row > 6) return values(0);
            const double t = row / 6;
            const double along = round(31 * (1.25 * t - 0.25 * t * t)) / 31;
            const double pixel = kFurPixel * distance;
            const double radius = strandRadius(address, along);
            const double half = max(radius, pixel / 2);
            return values(half / pixel, radius / half, half + 0.4 * pixel);
        });
    flattenStrands(cases.back());
    withRoot(cases.back(), filled(true), filled(false));
    cases.back().domain = [](In x) { return abs(rootRank(addressOf(round(x[0]), 0)) - kStrandShare) > 2e-3; };
    cases += strandRootCase({"StrandsCS", "StrandsCS(uint3(a0, 0, a1)); return gRibbonPlaceStore;"}, {whole(0, 63), whole(0, 7)},
                            {0, 0, 0, "there is no root"}, [](In) { return 0; });
    return cases;
}

/// A lock's strand at its tip, white, in even light. Arguments: address, number in the lock, and the normal's z.
struct NotedLock {
    double address, number;
    bool under;
    double child, rank;

    explicit NotedLock(In x)
        : address(round(x[0])), number(round(x[1])), under(number > 3.5), child(under ? number - 4 : number),
          rank((child + rootRank(address)) / (under ? 3 : 4)) {}
    /// What looks away by more than strands reach is left out.
    [[nodiscard]] bool drawn(double facing) const { return rank < kStrandShare && facing > -0.71; }
    [[nodiscard]] dvec3 albedo() const {
        const dvec3 random = lockNumbers(address, under ? child + 64 : child);
        const dvec3 more = lockMore(random);
        const double bright = (1 + 0.4 * (more.x - 0.5)) * (1 - 0.2);
        const double warm = 0.08 * (random.z - 0.5);
        // Waves at the mesh's centre, of waves that are 1 there: patches, half as much towards 1.2; underfur has a tenth of three of that.
        const double patches = saturate(0.5 + 0.8 * (wave(0.65) + 0.5 * wave(0.6)));
        const double tip = (1 + 0.1 * patches - 1) * (under ? 0.3 : 1) + 1;
        return 0.5 * tip * bright * dvec3(1, 1 + 0.5 * warm, 1 + warm); // half of it painted black
    }
};

FunctionCase lockNotes() {
    FunctionCase made = strandRootCase(
        {"lockNote", "TgVertexInput i = (TgVertexInput)0; i.normal = float3(sqrt(saturate(1.0 - a2 * a2)), 0, a2); i.tangent.w = 1; i.uv = "
                     "float2(0, a0); RibbonFrame f = (RibbonFrame)0; f.toEye = float3(0, 0, 200); f.perMm = 8e-5; lockNote(uint2(0, 0), i, "
                     "f, float4(0, 0, 0, 1e6), a1); return float4(gRibbonLightStore.rgb, gRibbonAsideStore.w);"},
        {whole(4096, 4000000), whole(0, 6), linear(-1, 1)}, {16, 0, 1e-4, "fractions of numbers up to 21"}, [](In x) {
            const NotedLock lock(x);
            return lock.drawn(x[2]) ? values(dvec4(lock.albedo(), 0.5)) : values(0); // half a pixel: a point, drawn as wide
        });
    made.maps.clear();
    for (const char* name : {"gCoatSkinMap", "gCoatFrontMap", "gCoatOpacityMap"})
        made.maps[name] = oneTexel(0);
    for (const auto& [name, value] : kLockScene)
        made.globals[name] = value;
    straighten(made);
    whiten(made);
    setAll(made, {"gCoatSky", "gCoatGround", "gLightColor"}, {1, 1, 1});
    made.globals["gLightPosition"] = {0, 0, 1000};
    made.maps["gCoatSkinMap"] = oneTexel(1e-3F); // before all strands: light from all sides is left
    setAll(made, {"gCoatWind", "gBoundingCenter"}, {0, 0, 0});
    made.globals["gCoatGuard"] = {0};
    made.globals["gCoatUnderLength"] = {1.2}; // as high as the others
    made.domain = [](In x) {
        const NotedLock lock(x);
        const double fraction = rootRank(lock.address);
        const dvec3 random = lockNumbers(lock.address, lock.under ? lock.child + 64 : lock.child);
        const double leap = 13.37 * random.z + 7.91 * random.y;
        return abs(lock.rank - kStrandShare) > 2e-3 && min(fraction, 1 - fraction) > 2e-3 && abs(x[2] + 0.71) > 0.01 &&
               abs(leap - round(leap)) > 1e-4;
    };
    return made;
}

} // namespace

Cases furNotedCases() {
    return together(lockNotes(), places(), notes, readings, threads());
}

} // namespace tegument::test
