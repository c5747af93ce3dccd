// Levels of the pyramid and the light that enters it (effects/passes/pyramid.fxh, pyramid_compute.fxh) against
// docs/design/modules/Pyramid.md.

#include "tests/hlsl/pyramid_pass_scene.h"

#include <algorithm>

namespace tegument::test {

namespace {

constexpr const char* kQuad = "TgQuadVarying q = (TgQuadVarying)0; q.uv = float2((a0 + 0.5) / 8.0, 0.5); ";

Argument metricPlace() {
    return whole(0, kMetricTexels - 1);
}

void weights(Cases& cases) {
    for (int size : {256, 512}) {
        cases += pyramidCase("fifthByLevels(a0)", {logarithmic(0.01, 2)}, size, [=](In x) { return fifthBrought(x[0], size); });
        cases += pyramidCase("linkedWeight(a0, a1)", {whole(0, 7), logarithmic(0.02, 2)}, size,
                             [=](In x) { return weightBesideLinks(x[0], max(x[1], 1e-6), size); });
    }
    cases += pyramidCase("levelLight(gEntry0Map, gEntry0, float2((a0 + 0.5) / 8.0, 0.5), 256.0, a1, a2, a3)",
                         {metricPlace(), whole(0, 6), whole(0, 1), whole(0, 1)}, [](In x) {
                             const dvec4 light = levelAlone(texelOfRow(entryRow(), x[0]), x[1], texelOfRow(metricRow(), x[0]).z, x[2] > 0.5,
                                                            x[3] > 0.5, kTestMapSize);
                             return light;
                         });
    cases.back().maps["gEntry0Map"] = entryRow();
    cases.back().tolerance.forward = 64;
    // Where no texel around knows its light there is none; around means the row's ends here.
    cases.back().domain = [](In x) { return texelOfRow(entryRow(), x[0]).w > 0; };
}

/// A body that answers by the entry point of level a1.
std::string byLevel(const char* before, int first, int last) {
    std::string body = std::string(kQuad) + "float4 r = 0.0; ";
    for (int level = first; level <= last; ++level)
        body += "if (a1 > " + std::to_string(level) + " - 0.5) r = " + before + std::to_string(level) + "PS(q); ";
    return body + "return r;";
}

void entryPoints(Cases& cases) {
    // Each reduces the map before it, of one texel here.
    cases += pyramidCase({"PYRAMID_REDUCE", byLevel("Reduce", 1, 6)}, {metricPlace(), whole(1, 6)},
                         [](In x) { return entryOf(static_cast<int>(round(x[1])) - 1); });
    for (int size : {256, 1000}) { // each map has half the texels of the one before along a side, rounded up
        std::string body = "float r = 0.0; ";
        for (int level = 0; level < 7; ++level)
            body += "if (a0 > " + std::to_string(level) + " - 0.5) r = kPyramidSize" + std::to_string(level) + "; ";
        cases += pyramidCase({"PYRAMID_MAPS", body + "return float4(r, 0, 0, 0);"}, {whole(0, 6)}, size,
                             [=](In x) { return ceil(size / exp2(x[0])); });
    }
    // Each weighs its own map, and adds what the coarser ones have come to. Levels 0 to 2 are spared where no chart is near.
    for (const char* name : {"PYRAMID_LEVEL", "Light6PS"}) {
        cases += pyramidCase({name, byLevel("Light", 0, 6)}, {metricPlace(), whole(0, 6)}, [](In x) {
            const auto level = static_cast<int>(round(x[1]));
            const dvec4 metric = texelOfRow(metricRow(), x[0]);
            if (level <= 2 && metric.w < 0.5) return dvec4(0);
            dvec4 light = levelAlone(entryOf(level), level, metric.z, false, false, kTestMapSize);
            if (level < 6) light += dvec4(dvec3(lightOf(level + 1)), 0);
            return light;
        });
    }
}

/// A texel of the base. Arguments: colour and whether it scatters, the map's normal, the mesh's cosine, and the texel.
const std::vector<dvec4> kPlaces = {{3, -4, 5, 1}, {-6, 7, -8, 0.5}, {1, 1, 1, 0.25}, {0, 0, 0, 0}};
const std::vector<dvec4> kColours = {{0.8, 0.6, 0.5, 1}, {0.3, 0.7, 0.2, 1}, {0.1, 0.9, 0.4, 0}, {1, 1, 1, 1}};
const std::vector<dvec4> kNormals = {{0, 0.6, 0.8, 1}, {0, 0.8, 0.6, 0.5}, {0.28, 0, 0.96, 0.75}, {0, 0, 1, 1}};
/// N.L of the mesh: above its horizon of .01, half of the way to it, and as far.
const std::vector<dvec4> kMeshNormals = {{0, 0, 1, 1}, {0.99998749992187402, 0, 0.005, 1}, {0.99997, 0, 0.00774, 1}, {0, 0, 1, 1}};

double horizonOf(double cosine) {
    return saturate(cosine / 0.01);
}

/// Hair from 180 mm before the light on, 4 mm thick: what its strands take from there to a quarter, .6, 1.2 and 2.4 of that.
constexpr double kHairFront = 180;
constexpr double kHairThickness = 4;
constexpr double kHairShadow = 0.9;
constexpr std::array<double, 5> kHairDepths = {0, 0.25, 0.6, 1.2, 2.4};
constexpr std::array<double, 5> kHairSums = {0, 0.2, 0.5, 0.6, 1.4};

/// At this height above the origin of the world, less what a strand, a twentieth of the thickness, would shadow of itself.
double leftByHair(double z) {
    const double depth = ((kSkinLightAt - z) * kSkinUnit - kHairFront) / kHairThickness - 0.05;
    double taken = 0;
    for (std::size_t i = 1; i < kHairSums.size(); ++i) {
        const double part = (depth - kHairDepths[i - 1]) / (kHairDepths[i] - kHairDepths[i - 1]);
        taken += (kHairSums[i] - kHairSums[i - 1]) * saturate(part);
    }
    return exp(-kHairShadow * taken);
}

void hair(FunctionCase& made) {
    made.effect = "FurSkin.fx";
    made.globals["gCoatShadow"] = {kHairShadow};
    made.globals["gFurLength"] = {0.1};
    made.globals["gMeshRadius"] = {kHairThickness / kSkinUnit / 0.1};
    made.maps["gCoatFrontMap"] = oneTexel(kHairFront);
    made.maps["gCoatOpacityMap"] = oneTexel(kHairSums[1], kHairSums[2], kHairSums[3], kHairSums[4]);
}

/// What strands leave of the light to skin enters.
FunctionCase belowHair(const FunctionCase& bare) {
    FunctionCase made = bare;
    hair(made);
    made.expected = [open = bare.expected](In x) {
        const auto at = static_cast<std::size_t>(round(x[0]));
        const Values light = open(x);
        const double left = leftByHair(kSkinScale * kPlaces[at].z + kSkinOrigin.z);
        return values(light[0] * left, light[1] * left, light[2] * left, light[3]);
    };
    return made;
}

void entering(Cases& cases) {
    cases += pyramidCase("skinOpen(a0)", {linear(-100, 100, 3)}, [](In) { return 1; }); // nothing grows on it
    cases.back().tolerance = {0, 0, 0, "a constant"};
    // A shadow map without a surface: what the texel says itself is all.
    cases += pyramidCase("entryLight(float2((a0 + 0.5) / 4.0, 0.5))", {whole(0, 3)}, [](In x) {
        const auto at = static_cast<std::size_t>(round(x[0]));
        const double covered = kPlaces[at].w * kNormals[at].w;
        const double shadow = horizonOf(normalize(dvec3(kMeshNormals[at])).z);
        if (covered <= 0) return dvec4(0);
        return dvec4(enteringSkin(kColours[at], kNormals[at].z, shadow) * covered, covered);
    });
    FunctionCase& light = cases.back();
    light.maps["gAtlasPositionMap"] = rowOfTexels(kPlaces);
    light.maps["gSkinMap"] = rowOfTexels(kColours);
    light.maps["gAtlasNormalMap"] = rowOfTexels(kNormals);
    light.maps["gAtlasMeshNormalMap"] = rowOfTexels(kMeshNormals);
    light.maps["gShadowMap"] = oneTexel(0);
    light.samples = 64;
    light.tolerance.absolute = 2e-4; // a horizon a hundredth high, from a cosine to 1e-7, times its rounding in the map's texel
    cases += belowHair(light);
    cases += pyramidCase("skinOpen(float3(a0, a1))", {linear(-30, 30, 2), linear(-40, 60)}, [](In x) { return leftByHair(x[1]); });
    hair(cases.back());
}

Cases shadows() {
    Cases cases;
    // Taps a quarter of a texel of the base from each other, three quarters to six texels of the shadow map.
    cases += pyramidCase(
        {"entryShadow", std::string(kFacing) +
                            "p.lightUv = a0; p.depth = a1; p.footprint = a3; return float4(entryShadow(p, p.meshNormal, a2), 0, 0, 0);"},
        {linear(0.1, 0.9, 2), linear(596, 604), logarithmic(0.002, 4), linear(0.1, 2)}, [](In x) {
            const double f = x[3];
            const double apart = std::clamp(0.25 / sqrt(x[2]), 0.75 * f, 6 * f);
            return tapsLit(x.vec2(0), x[1] - kSkinTolerance, f, apart);
        });
    cases.back().map = &shadowMap();
    cases.back().filtered = false;
    cases.back().tolerance = kTapTolerance;
    cases.back().samples = 2048;
    cases.back().domain = [](In x) { return x[2] > 1e-5 && x[3] > 0.05; };
    // Where it turns away by its own mesh or its normal map nothing arrives; near the mesh's horizon part of it.
    const auto own = [](In x) {
        const double mesh = x[0];
        return min(mesh, x[1]) > 0 ? horizonOf(mesh) : 0;
    };
    const std::string low = std::string(kFacing) + "p.meshNormal = float3(sqrt(1.0 - a0 * a0), 0, a0); p.cosine = a1; p.footprint = 0.2; ";
    cases += pyramidCase({"entryShadow", low + "return float4(entryShadow(p, p.meshNormal, 1.0), 0, 0, 0);"},
                         {linear(-0.01, 0.02), linear(-0.1, 1)}, own);
    cases += pyramidCase({"finalShadow", low + "p.scatters = a2; return float4(finalShadow(p, p.meshNormal), 0, 0, 0);"},
                         {linear(-0.01, 0.02), linear(-0.1, 1), whole(0, 1)}, own);
    cases += pyramidCase({"facesLight", low + "return float4(facesLight(p) ? 1.0 : 0.0, 0, 0, 0);"}, {linear(-0.01, 0.02), linear(-0.1, 1)},
                         [](In x) { return min(x[0], x[1]) > 0 ? 1 : 0; });
    for (std::size_t i = cases.size() - 3; i < cases.size(); ++i)
        cases[i].maps["gShadowMap"] = oneTexel(0);
    // Where the surface is oblique the taps would print the map's steps: its nearest texels, from a facet whatever the mesh's normal.
    cases += pyramidCase(
        {"entryShadow",
         std::string(kFacing) +
             "float3 facet = float3(sqrt(1.0 - a3 * a3), 0, a3); p.lightUv = a0; p.depth = a1; p.footprint = a2; "
             "float lit = entryShadow(p, facet, 100.0); p.meshNormal = facet; "
             "float2 slope = tgShadowPlanarSlope(facet, p.axisX, p.axisY, p.toLight, tgLightRays(), p.footprint); "
             "PlanarPlace at = planarPlace(p, slope, 0.7072); "
             "return float4(lit - tgShadowSharp(gShadowMap, gShadow, at.uv, at.depth - dot(abs(slope), 1.0), slope), 0, 0, 0);"},
        {linear(0.1, 0.9, 2), linear(596, 604), linear(0.16, 1), linear(0.05, 0.95)}, [](In) { return 0; });
    cases.back().map = &shadowMap();
    cases.back().filtered = false;
    cases.back().tolerance = {0, 0, 1e-6, "the same call"};
    cases.back().domain = [](In x) { return x[2] > 0.155 && x[3] > 0.04 && x[3] < 0.96; };
    return cases;
}

/// Places along a row of 256 texels; of every fifth one nothing is known.
dvec4 wayPlace(int x) {
    return {0.1 * x, 0.001 * x * x, 5 - 0.05 * x, x % 5 == 0 ? 0 : 1};
}

void facets(Cases& cases) {
    cases += pyramidCase({"facetBend", std::string(kFacing) + "p.meshNormal = float3(sqrt(1.0 - a0 * a0), 0, a0); p.footprint = a1; return "
                                                              "float4(facetBend(p, a2), 0, 0, 0);"},
                         {linear(0.2, 0.95), linear(0.1, 1), linear(-2, 2, 2)}, [](In x) {
                             const double rise = x[1] * sqrt(1 - x[0] * x[0]) / x[0];
                             return abs(x[2] - rise) + abs(x.scalar(2, 1));
                         });
    cases.back().domain = [](In x) { return x[0] > 0.16 && x[0] < 0.999 && x[1] > 0; };
    cases += pyramidCase({"atlasWay", "float3 place = gAtlasPositionMap.Load(int3(a0, 0, 0)).xyz; return float4(atlasWay(float2((a0 "
                                      "+ 0.5) / 256.0, 0.5), place, float2(1.0, 0.0)), 0);"},
                         {whole(0, 254)}, [](In x) {
                             const auto at = static_cast<int>(std::lround(x[0]));
                             if (wayPlace(at + 1).w <= 0) return values(0);
                             const dvec3 way = kSkinScale * dvec3(wayPlace(at + 1) - wayPlace(at));
                             return values(way.x, way.y, way.z);
                         });
    cases.back().maps["gAtlasPositionMap"] = mapOf(256, 1, [](int x, int) {
        const dvec4 place = wayPlace(x);
        return texelOf(place.x, place.y, place.z, place.w);
    });
    cases.back().filtered = false;
    cases.back().tolerance = {16, 0, 3e-5, "differences of places up to 140"};
    cases += pyramidCase(
        {"facetNormal", "LitPoint p = (LitPoint)0; p.meshNormal = a2; p.toLight = a3; return float4(facetNormal(p, a0, a1), 0);"},
        {linear(-1, 1, 3), linear(-1, 1, 3), unit(), unit()}, [](In x) {
            dvec3 facet = normalize(cross(x.vec3(0), x.vec3(1)));
            if (dot(facet, x.vec3(2)) < 0) facet = -facet;
            const bool one = dot(facet, x.vec3(2)) > 0.7 && dot(facet, x.vec3(3)) > 0;
            const dvec3 normal = one ? facet : x.vec3(2);
            return values(normal.x, normal.y, normal.z);
        });
    cases.back().tolerance = {16, 4, 1e-4, "a cross product that may cancel to 0.01"};
    cases.back().domain = [](In x) {
        const dvec3 across = cross(x.vec3(0), x.vec3(1));
        if (length(across) < 0.01 || !isUnit(x.vec3(2)) || !isUnit(x.vec3(3))) return false;
        const double mesh = dot(normalize(across), x.vec3(2));
        return abs(abs(mesh) - 0.7) > 1e-4 && abs(dot(normalize(across), x.vec3(3))) > 1e-4;
    };
}

/// A map of half the texels along a side: of each four by four of the finer one, weighted 1, 3, 3, 1 both ways; the border goes on.
TestMap halved(const TestMap& finer) {
    TestMap map{.size = finer.size / 2};
    constexpr std::array<double, 4> kWeights = {1.0 / 8, 3.0 / 8, 3.0 / 8, 1.0 / 8};
    for (int y = 0; y < map.size; ++y)
        for (int x = 0; x < map.size; ++x) {
            dvec4 sum(0);
            for (int i = 0; i < 16; ++i)
                sum += kWeights.at(static_cast<std::size_t>(i % 4)) * kWeights.at(static_cast<std::size_t>(i / 4)) *
                       finer.texel(2 * x - 1 + i % 4, 2 * y - 1 + i / 4);
            map.texels.push_back(
                {static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z), static_cast<float>(sum.w)});
        }
    return map;
}

/// Three reductions by a group of 64 threads, which wait for each other twice. The last texel of the last map that it writes.
FunctionCase reducedByGroup(const std::string& entry, int from, int size) {
    TestMap finest{.size = size >> from};
    for (int y = 0; y < finest.size; ++y)
        for (int x = 0; x < finest.size; ++x)
            finest.texels.push_back({0.5F + 0.4F * sin(0.9F * static_cast<float>(x)), 0.01F * static_cast<float>(y * y % 97),
                                     static_cast<float>((x * 7 + y * 3) % 11), x % 5 == 0 ? 0.0F : 1.0F});
    const TestMap last = halved(halved(halved(finest)));
    FunctionCase made =
        pyramidCase({"PYRAMID_REDUCE_CS", "[loop] for (uint i = 0; i < 3 * 64; i++) " + entry +
                                              "CS(uint3(a0, a1, 0), i % 64); return gEntry" + std::to_string(from + 3) + "Store;"},
                    {whole(0, last.size / 4 - 1), whole(0, last.size / 4 - 1)}, size,
                    [=](In x) { return last.texel(4 * static_cast<int>(x[0]) + 3, 4 * static_cast<int>(x[1]) + 3); });
    made.maps["gEntry" + std::to_string(from) + "Map"] = finest;
    made.tolerance = {16, 0, 2e-6, "sums of 16, thrice; a linear filter has the quarters exactly"};
    made.samples = 64;
    return made;
}

Cases computed() {
    const Tolerance exact{2, 0, 0, "quotients of whole numbers"};
    Cases cases = {reducedByGroup("ReduceFine", 0, 256), reducedByGroup("ReduceCoarse", 3, 512)};
    cases += pyramidCase("texelAt(uint3(a0, a1, 3), 100.0).uv", {whole(0, 99), whole(0, 99)},
                         [](In x) { return values((x[0] + 0.5) / 100, (x[1] + 0.5) / 100); });
    cases.back().tolerance = exact;
    // The nearest of the four texels of a finer map, whose middles lie 1.25 before and behind where the texel's middle is.
    cases += pyramidCase("reducedFrom(int2(a0, a1), 16.0, 32.0)", {whole(0, 15), whole(0, 15)},
                         [](In x) { return values((x[0] + 0.5) * 2 - 1.25, (x[1] + 0.5) * 2 - 1.25); });
    cases.back().tolerance = exact;
    cases += pyramidCase("reducesTexel(int2(a0, a1), int2(a2, a3), 4) ? 1.0 : 0.0", {whole(0, 15), whole(0, 15), whole(0, 3), whole(0, 3)},
                         [](In x) {
                             const bool mine = floor(x[0] / 4) == x[2] && floor(x[1] / 4) == x[3];
                             return mine ? 1 : 0;
                         });
    cases.back().tolerance = exact;
    return cases;
}

} // namespace

Cases pyramidPassCases() {
    return together(weights, entryPoints, entering, shadows(), facets, computed());
}

} // namespace tegument::test
