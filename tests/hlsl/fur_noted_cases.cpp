// What compute shaders note of strands, and what vertices read of it (effects/passes/fur_compute.fxh), in double precision. What they store
// is a variable here: the last row that a thread notes.

#include "tests/hlsl/strand_roots.h"

#include <algorithm>

namespace tegument::test {

namespace {

constexpr double kColumns = 1366; // roots in a row of their texture, three texels each
constexpr double kRootRows = 256;

constexpr double kFirst = 3 * 4096 + 5; // address of the first root

/// Column and row of a root in the maps.
glm::dvec2 columnOf(double address) {
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

std::vector<FunctionCase> places() {
    const Tolerance exact{.forward = 0, .backward = 0, .why = "whole numbers"};
    std::vector<FunctionCase> cases;
    cases.push_back(strandRootCase(
        "ribbonColumn", "return float4(ribbonColumn(a0), 0, 0);", {whole(3 * 4096 + 5, 1000000)},
        [](const Inputs& x) { return values(columnOf(x.scalar(0))); }, exact));
    cases.push_back(strandRootCase(
        "ribbonAddress", "return float4(ribbonAddress(float2(a0, a1)), 0, 0, 0);", {whole(0, 1364), whole(0, 255)},
        [](const Inputs& x) { // of the first row the texels before the first root are the header's
            const double column = 3 * std::round(x.scalar(0)) + (x.scalar(1) < 0.5 ? 2 : 0);
            return values(4096 * (3 + std::round(x.scalar(1))) + column);
        },
        exact));
    cases.push_back(strandRootCase(
        "lockTexel", "return float4(lockTexel(float2(a0, a1), a2, a3), lockStrands(), lockRows());",
        {whole(0, 1365), whole(0, 255), whole(0, 6), whole(0, 3)},
        [](const Inputs& x) { // rows of a strand below each other, strands of a lock too, locks too
            const double strand = 7 * std::round(x.scalar(1)) + std::round(x.scalar(2));
            return values(std::round(x.scalar(0)), 4 * strand + std::round(x.scalar(3)), 7, 4);
        },
        exact));
    cases.back().globals["gCoatChildren"] = {4};
    cases.back().globals["gCoatUnderfur"] = {3};
    cases.push_back(strandRootCase(
        "strandTexel", "return float4(strandTexel(float2(a0, a1), a2), 0, 0);", {whole(0, 1365), whole(0, 255), whole(0, 6)},
        [](const Inputs& x) { return values(std::round(x.scalar(0)), 7 * std::round(x.scalar(1)) + std::round(x.scalar(2))); }, exact));
    const char* vertex = "TgVertexInput i = (TgVertexInput)0; i.position = a3; i.tangent = float4(a3.yzx, a2 > 0.5 ? 1 : -1); "
                         "i.uv = float2(70.0 + a1 / 32.0, a0); RootVarying v = RibbonRootsVS(i); ";
    const auto add = [&](const char* returned, std::function<Values(const Inputs&)> expected) {
        cases.push_back(strandRootCase("RibbonRootsVS", std::string(vertex) + "return " + returned + ";",
                                       {whole(4000, 1000000), whole(0, 31), whole(0, 1), linear(-1, 1, 3)}, std::move(expected),
                                       {.forward = 4, .backward = 0, .absolute = 1e-6, .why = "a quotient and a sum of up to 2"}));
    };
    // A regression check: the ribbon's corners within its root's texel, none of whose edges meets the centre.
    add("v.position", [](const Inputs& x) {
        if (x.scalar(0) < 4095.5) return values(2, 2, 2, 1);
        const double side = x.scalar(2) > 0.5 ? 0.85 : 0.05;
        const glm::dvec2 at = columnOf(x.scalar(0)) + glm::dvec2(side, 0.15 + 0.8 * std::round(x.scalar(1)) / 31);
        return values(2 * at.x / kColumns - 1, 1 - 2 * at.y / kRootRows, 0.5, 1);
    });
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) < 4095.5 || x.scalar(0) > kFirst - 0.5; };
    add("float4(v.place.xyz, v.place.w)", [](const Inputs& x) { return values(glm::dvec4(x.vec3(3), 70.5)); });
    add("v.flow", [](const Inputs& x) { return values(x.scalar(3, 1), x.scalar(3, 2), x.scalar(3, 0), 1); });
    for (FunctionCase& each : cases)
        each.maps["gFurRootsMap"] = &placesMap();
    return cases;
}

/// Arguments: place of the root in the world, way to the eye, offset, tangent (of the mesh at rest), radius, afar.
struct Noted {
    double pixel, half;
    glm::dvec3 aside, place;

    explicit Noted(const Inputs& x) {
        const glm::dvec3 toEye = x.vec3(1) - x.vec3(2);
        pixel = kFurPixel * glm::length(toEye);
        half = std::max(x.scalar(4), pixel / 2);
        aside = furTurned(glm::normalize(glm::cross(x.vec3(3), toEye)));
        place = x.vec3(0) + furTurned(x.vec3(2));
    }
};

std::vector<FunctionCase> notes() {
    const char* body = "RibbonFrame f = (RibbonFrame)0; f.world = a0; f.toEye = a1; RibbonPlace p; p.offset = a2; p.tangent = a3; "
                       "ribbonNote(uint2(0, 0), (TgVertexInput)0, f, p, a4, float3(0.1, 0.2, 0.3), a5); ";
    std::vector<FunctionCase> cases;
    const auto add = [&](const char* returned, std::function<Values(const Inputs&)> expected) {
        cases.push_back(strandRootCase(
            "ribbonNote", std::string(body) + "return " + returned + ";",
            {linear(-80, 80, 3), vector(3, 150, 400), linear(-50, 50, 3), unit(), logarithmic(0.02, 2), linear(-1, 1)}, std::move(expected),
            {.forward = 16, .backward = 4, .absolute = 1e-5, .why = "lengths, quotients, sums of up to 130"}));
        cases.back().domain = [](const Inputs& x) {
            const glm::dvec3 toEye = x.vec3(1) - x.vec3(2);
            return isUnit(x.vec3(3)) && glm::length(toEye) > 50 && x.scalar(4) > 0.01 &&
                   glm::length(glm::cross(x.vec3(3), toEye)) > 0.05 * glm::length(toEye);
        };
    };
    add("gRibbonPlaceStore", [](const Inputs& x) { return values(glm::dvec4(Noted(x).place, Noted(x).half + 0.4 * Noted(x).pixel)); });
    add("gRibbonAsideStore", [](const Inputs& x) { return values(glm::dvec4(Noted(x).aside, Noted(x).half / Noted(x).pixel)); });
    add("gRibbonLightStore",
        [](const Inputs& x) { return values(0.1, 0.2, 0.3, (x.scalar(5) < 0 ? -1 : 1) * x.scalar(4) / Noted(x).half); });
    return cases;
}

/// Maps of one texel: the axis in the world and how far the ribbon's sides are; the way there and half the width; colour and faintness.
std::vector<FunctionCase> readings() {
    const char* body =
        "TgVertexInput i = (TgVertexInput)0; i.tangent.w = a0 > 0.5 ? 1 : -1; RibbonVarying v = ribbonNoted(i, float2(3, 5)); ";
    std::vector<FunctionCase> cases;
    const auto add = [&](const char* returned, std::function<Values(const Inputs&)> expected) {
        cases.push_back(strandRootCase("ribbonNoted", std::string(body) + "return " + returned + ";", {whole(0, 1), linear(0, 1)},
                                       std::move(expected), {.forward = 8, .backward = 0, .absolute = 1e-4, .why = "sums of up to 400"}));
        cases.back().maps["gRibbonPlaceMap"] = oneTexel(30, -20, 10, 1.5);
        cases.back().maps["gRibbonAsideMap"] = oneTexel(0.6, 0, 0.8, 2.5);
        cases.back().maps["gRibbonLightMap"] = oneTexel(0.1, 0.2, 0.3, -0.7);
    };
    add("v.position", [](const Inputs& x) {
        const double side = x.scalar(0) > 0.5 ? 1.5 : -1.5;
        return values(furClip(glm::dvec3(30, -20, 10) + side * glm::dvec3(0.6, 0, 0.8)));
    });
    add("float4(v.edge, v.color.xw)", [](const Inputs& x) { return values(x.scalar(0) > 0.5 ? 2.9 : -2.9, 2.5, 0.1, -0.7); });
    return cases;
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

std::vector<FunctionCase> threads() {
    std::vector<FunctionCase> cases;
    cases.push_back(strandRootCase(
        "ribbonRootAt", "TgVertexInput i = ribbonRootAt(uint2(a0, 0)); return float4(i.tangent.xyz, i.tangent.w);", {whole(0, 63)},
        [](const Inputs&) { return values(0.2, 0.3, 0.4, 1); }, {.forward = 1, .backward = 0, .why = "what the map holds"}));
    cases.push_back(strandRootCase("ribbonRootAt", "TgVertexInput i = ribbonRootAt(uint2(a0, 0)); return float4(i.position.xy, i.uv);",
                                   {whole(0, 63)},
                                   [](const Inputs& x) { return values(12, -7, 70, addressOf(std::round(x.scalar(0)), 0)); },
                                   {.forward = 1, .backward = 0, .why = "what the map holds"}));
    for (FunctionCase& each : cases)
        withRoot(each, filled(true), filled(false));
    const double distance = glm::length(kFurEye - furWorld({12, -7, 5}));
    cases.push_back(strandRootCase(
        "StrandsCS", "StrandsCS(uint3(a0, 0, a1)); return float4(gRibbonAsideStore.w, gRibbonLightStore.w, gRibbonPlaceStore.w, 0);",
        {whole(0, 63), whole(0, 7)},
        [=](const Inputs& x) { // a thread for each row of a strand of seven
            const double address = addressOf(std::round(x.scalar(0)), 0);
            const double row = std::round(x.scalar(1));
            if (rootRank(address) >= kStrandShare || row > 6) return values(0);
            const double t = row / 6;
            const double along = std::round(31 * (1.25 * t - 0.25 * t * t)) / 31;
            const double pixel = kFurPixel * distance;
            const double radius = strandRadius(address, along);
            const double half = std::max(radius, pixel / 2);
            return values(half / pixel, radius / half, half + 0.4 * pixel);
        },
        {.forward = 32, .backward = 0, .absolute = 2e-5, .why = "a distance of 500 to 3e-5"}));
    flattenStrands(cases.back());
    withRoot(cases.back(), filled(true), filled(false));
    cases.back().domain = [](const Inputs& x) { return std::abs(rootRank(addressOf(std::round(x.scalar(0)), 0)) - kStrandShare) > 2e-3; };
    cases.push_back(strandRootCase("StrandsCS", "StrandsCS(uint3(a0, 0, a1)); return gRibbonPlaceStore;", {whole(0, 63), whole(0, 7)},
                                   [](const Inputs&) { return values(0); }, {.forward = 0, .backward = 0, .why = "there is no root"}));
    return cases;
}

/// A lock's strand at its tip, white, in even light. Arguments: address, number in the lock, and the normal's z.
struct NotedLock {
    double address, number;
    bool under;
    double child, rank;

    explicit NotedLock(const Inputs& x)
        : address(std::round(x.scalar(0))), number(std::round(x.scalar(1))), under(number > 3.5), child(under ? number - 4 : number),
          rank((child + rootRank(address)) / (under ? 3 : 4)) {}
    /// What looks away by more than strands reach is left out.
    [[nodiscard]] bool drawn(double facing) const { return rank < kStrandShare && facing > -0.71; }
    [[nodiscard]] glm::dvec3 albedo() const {
        const glm::dvec3 random = lockNumbers(address, under ? child + 64 : child);
        const glm::dvec3 more = lockMore(random);
        const double bright = (1 + 0.4 * (more.x - 0.5)) * (1 - 0.2);
        const double warm = 0.08 * (random.z - 0.5);
        // Waves at the mesh's centre, of waves that are 1 there: patches, half as much towards 1.2; underfur has a tenth of three of that.
        const double patches = std::clamp(0.5 + 0.8 * (wave(0.65) + 0.5 * wave(0.6)), 0.0, 1.0);
        const double tip = (1 + 0.1 * patches - 1) * (under ? 0.3 : 1) + 1;
        return 0.5 * tip * bright * glm::dvec3(1, 1 + 0.5 * warm, 1 + warm); // half of it painted black
    }
};

FunctionCase lockNotes() {
    FunctionCase made = strandRootCase(
        "lockNote",
        "TgVertexInput i = (TgVertexInput)0; i.normal = float3(sqrt(saturate(1.0 - a2 * a2)), 0, a2); i.tangent.w = 1; i.uv = float2(0, "
        "a0); "
        "RibbonFrame f = (RibbonFrame)0; f.toEye = float3(0, 0, 200); f.perMm = 8e-5; lockNote(uint2(0, 0), i, f, float4(0, 0, 0, 1e6), "
        "a1); "
        "return float4(gRibbonLightStore.rgb, gRibbonAsideStore.w);",
        {whole(4096, 4000000), whole(0, 6), linear(-1, 1)},
        [](const Inputs& x) {
            const NotedLock lock(x);
            return lock.drawn(x.scalar(2)) ? values(glm::dvec4(lock.albedo(), 0.5)) : values(0); // half a pixel: a point, drawn as wide
        },
        {.forward = 16, .backward = 0, .absolute = 1e-4, .why = "fractions of numbers up to 21"});
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
    made.domain = [](const Inputs& x) {
        const NotedLock lock(x);
        const double fraction = rootRank(lock.address);
        const glm::dvec3 random = lockNumbers(lock.address, lock.under ? lock.child + 64 : lock.child);
        const double leap = 13.37 * random.z + 7.91 * random.y;
        return std::abs(lock.rank - kStrandShare) > 2e-3 && std::min(fraction, 1 - fraction) > 2e-3 &&
               std::abs(x.scalar(2) + 0.71) > 0.01 && std::abs(leap - std::round(leap)) > 1e-4;
    };
    return made;
}

} // namespace

std::vector<FunctionCase> furNotedCases() {
    return together(lockNotes(), places(), notes(), readings(), threads());
}

} // namespace tegument::test
