// Levels of the pyramid and the light that enters it (effects/passes/pyramid.fxh, pyramid_compute.fxh) against
// docs/design/modules/Pyramid.md.

#include "tests/hlsl/pyramid_pass_scene.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

constexpr const char* kQuad = "TgQuadVarying q = (TgQuadVarying)0; q.uv = float2((a0 + 0.5) / 8.0, 0.5); ";

Argument metricPlace() {
    return whole(0, kMetricTexels - 1);
}

std::vector<FunctionCase> weights() {
    std::vector<FunctionCase> cases;
    for (int size : {256, 512}) {
        cases.push_back(pyramidCase(
            "fifthByLevels", "return float4(fifthByLevels(a0), 0, 0, 0);", {logarithmic(0.01, 2)},
            [=](const Inputs& x) { return values(fifthBrought(x.scalar(0), size)); }, size));
        cases.push_back(pyramidCase(
            "linkedWeight", "return float4(linkedWeight(a0, a1), 0);", {whole(0, 7), logarithmic(0.02, 2)},
            [=](const Inputs& x) { return values(weightBesideLinks(x.scalar(0), std::max(x.scalar(1), 1e-6), size)); }, size));
    }
    cases.push_back(pyramidCase("levelLight", "return levelLight(gEntry0Map, gEntry0, float2((a0 + 0.5) / 8.0, 0.5), 256.0, a1, a2, a3);",
                                {metricPlace(), whole(0, 6), whole(0, 1), whole(0, 1)}, [](const Inputs& x) {
                                    const glm::dvec4 light =
                                        levelAlone(texelOfRow(entryRow(), x.scalar(0)), x.scalar(1), texelOfRow(metricRow(), x.scalar(0)).z,
                                                   x.scalar(2) > 0.5, x.scalar(3) > 0.5, kTestMapSize);
                                    return values(light);
                                }));
    cases.back().maps["gEntry0Map"] = entryRow();
    cases.back().tolerance.forward = 64;
    // Where no texel around knows its light there is none; around means the row's ends here.
    cases.back().domain = [](const Inputs& x) { return texelOfRow(entryRow(), x.scalar(0)).w > 0; };
    return cases;
}

/// A body that answers by the entry point of level a1.
std::string byLevel(const char* before, int first, int last) {
    std::string body = std::string(kQuad) + "float4 r = 0.0; ";
    for (int level = first; level <= last; ++level)
        body += "if (a1 > " + std::to_string(level) + " - 0.5) r = " + before + std::to_string(level) + "PS(q); ";
    return body + "return r;";
}

std::vector<FunctionCase> entryPoints() {
    std::vector<FunctionCase> cases;
    // Each reduces the map before it, of one texel here.
    cases.push_back(pyramidCase("PYRAMID_REDUCE", byLevel("Reduce", 1, 6), {metricPlace(), whole(1, 6)},
                                [](const Inputs& x) { return values(entryOf(static_cast<int>(std::round(x.scalar(1))) - 1)); }));
    for (int size : {256, 1000}) { // each map has half the texels of the one before along a side, rounded up
        std::string body = "float r = 0.0; ";
        for (int level = 0; level < 7; ++level)
            body += "if (a0 > " + std::to_string(level) + " - 0.5) r = kPyramidSize" + std::to_string(level) + "; ";
        cases.push_back(pyramidCase(
            "PYRAMID_MAPS", body + "return float4(r, 0, 0, 0);", {whole(0, 6)},
            [=](const Inputs& x) { return values(std::ceil(size / std::exp2(x.scalar(0)))); }, size));
    }
    // Each weighs its own map, and adds what the coarser ones have come to. Levels 0 to 2 are spared where no chart is near.
    for (const char* name : {"PYRAMID_LEVEL", "Light6PS"}) {
        cases.push_back(pyramidCase(name, byLevel("Light", 0, 6), {metricPlace(), whole(0, 6)}, [](const Inputs& x) {
            const auto level = static_cast<int>(std::round(x.scalar(1)));
            const glm::dvec4 metric = texelOfRow(metricRow(), x.scalar(0));
            if (level <= 2 && metric.w < 0.5) return values(0);
            glm::dvec4 light = levelAlone(entryOf(level), level, metric.z, false, false, kTestMapSize);
            if (level < 6) light += glm::dvec4(glm::dvec3(lightOf(level + 1)), 0);
            return values(light);
        }));
    }
    return cases;
}

/// A texel of the base. Arguments: colour and whether it scatters, the map's normal, the mesh's cosine, and the texel.
const std::vector<glm::dvec4> kPlaces = {{3, -4, 5, 1}, {-6, 7, -8, 0.5}, {1, 1, 1, 0.25}, {0, 0, 0, 0}};
const std::vector<glm::dvec4> kColours = {{0.8, 0.6, 0.5, 1}, {0.3, 0.7, 0.2, 1}, {0.1, 0.9, 0.4, 0}, {1, 1, 1, 1}};
const std::vector<glm::dvec4> kNormals = {{0, 0.6, 0.8, 1}, {0, 0.8, 0.6, 0.5}, {0.28, 0, 0.96, 0.75}, {0, 0, 1, 1}};
/// N.L of the mesh: above its horizon of .01, half of the way to it, and as far.
const std::vector<glm::dvec4> kMeshNormals = {{0, 0, 1, 1}, {0.99998749992187402, 0, 0.005, 1}, {0.99997, 0, 0.00774, 1}, {0, 0, 1, 1}};

double horizonOf(double cosine) {
    return std::clamp(cosine / 0.01, 0.0, 1.0);
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
        taken += (kHairSums[i] - kHairSums[i - 1]) * std::clamp(part, 0.0, 1.0);
    }
    return std::exp(-kHairShadow * taken);
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
    made.expected = [open = bare.expected](const Inputs& x) {
        const auto at = static_cast<std::size_t>(std::round(x.scalar(0)));
        const Values light = open(x);
        const double left = leftByHair(kSkinScale * kPlaces[at].z + kSkinOrigin.z);
        return values(light[0] * left, light[1] * left, light[2] * left, light[3]);
    };
    return made;
}

std::vector<FunctionCase> entering() {
    std::vector<FunctionCase> cases;
    cases.push_back(pyramidCase("skinOpen", "return float4(skinOpen(a0), 0, 0, 0);", {linear(-100, 100, 3)},
                                [](const Inputs&) { return values(1); })); // nothing grows on it
    cases.back().tolerance = {.forward = 0, .backward = 0, .why = "a constant"};
    // A shadow map without a surface: what the texel says itself is all.
    cases.push_back(pyramidCase("entryLight", "return entryLight(float2((a0 + 0.5) / 4.0, 0.5));", {whole(0, 3)}, [](const Inputs& x) {
        const auto at = static_cast<std::size_t>(std::round(x.scalar(0)));
        const double covered = kPlaces[at].w * kNormals[at].w;
        const double shadow = horizonOf(glm::normalize(glm::dvec3(kMeshNormals[at])).z);
        if (covered <= 0) return values(0);
        return values(glm::dvec4(enteringSkin(kColours[at], kNormals[at].z, shadow) * covered, covered));
    }));
    FunctionCase& light = cases.back();
    light.maps["gAtlasPositionMap"] = rowOfTexels(kPlaces);
    light.maps["gSkinMap"] = rowOfTexels(kColours);
    light.maps["gAtlasNormalMap"] = rowOfTexels(kNormals);
    light.maps["gAtlasMeshNormalMap"] = rowOfTexels(kMeshNormals);
    light.maps["gShadowMap"] = oneTexel(0);
    light.samples = 64;
    light.tolerance.absolute = 2e-4; // a horizon a hundredth high, from a cosine to 1e-7, times its rounding in the map's texel
    cases.push_back(belowHair(light));
    cases.push_back(pyramidCase("skinOpen", "return float4(skinOpen(float3(a0, a1)), 0, 0, 0);", {linear(-30, 30, 2), linear(-40, 60)},
                                [](const Inputs& x) { return values(leftByHair(x.scalar(1))); }));
    hair(cases.back());
    return cases;
}

std::vector<FunctionCase> shadows() {
    std::vector<FunctionCase> cases;
    // Taps a quarter of a texel of the base from each other, three quarters to six texels of the shadow map.
    cases.push_back(pyramidCase(
        "entryShadow",
        std::string(kFacing) + "p.lightUv = a0; p.depth = a1; p.footprint = a3; return float4(entryShadow(p, p.meshNormal, a2), 0, 0, 0);",
        {linear(0.1, 0.9, 2), linear(596, 604), logarithmic(0.002, 4), linear(0.1, 2)}, [](const Inputs& x) {
            const double f = x.scalar(3);
            const double apart = std::clamp(0.25 / std::sqrt(x.scalar(2)), 0.75 * f, 6 * f);
            return values(tapsLit(x.vec2(0), x.scalar(1) - kSkinTolerance, f, apart));
        }));
    cases.back().map = &shadowMap();
    cases.back().filtered = false;
    cases.back().tolerance = kTapTolerance;
    cases.back().samples = 2048;
    cases.back().domain = [](const Inputs& x) { return x.scalar(2) > 1e-5 && x.scalar(3) > 0.05; };
    // Where it turns away by its own mesh or its normal map nothing arrives; near the mesh's horizon part of it.
    const auto own = [](const Inputs& x) {
        const double mesh = x.scalar(0);
        return values(std::min(mesh, x.scalar(1)) > 0 ? horizonOf(mesh) : 0);
    };
    const std::string low = std::string(kFacing) + "p.meshNormal = float3(sqrt(1.0 - a0 * a0), 0, a0); p.cosine = a1; p.footprint = 0.2; ";
    cases.push_back(pyramidCase("entryShadow", low + "return float4(entryShadow(p, p.meshNormal, 1.0), 0, 0, 0);",
                                {linear(-0.01, 0.02), linear(-0.1, 1)}, own));
    cases.push_back(pyramidCase("finalShadow", low + "p.scatters = a2; return float4(finalShadow(p, p.meshNormal), 0, 0, 0);",
                                {linear(-0.01, 0.02), linear(-0.1, 1), whole(0, 1)}, own));
    cases.push_back(pyramidCase("facesLight", low + "return float4(facesLight(p) ? 1.0 : 0.0, 0, 0, 0);",
                                {linear(-0.01, 0.02), linear(-0.1, 1)},
                                [](const Inputs& x) { return values(std::min(x.scalar(0), x.scalar(1)) > 0 ? 1 : 0); }));
    for (std::size_t i = cases.size() - 3; i < cases.size(); ++i)
        cases[i].maps["gShadowMap"] = oneTexel(0);
    // Where the surface is oblique the taps would print the map's steps: its nearest texels, from a facet whatever the mesh's normal.
    cases.push_back(
        pyramidCase("entryShadow",
                    std::string(kFacing) +
                        "float3 facet = float3(sqrt(1.0 - a3 * a3), 0, a3); p.lightUv = a0; p.depth = a1; p.footprint = a2; "
                        "float lit = entryShadow(p, facet, 100.0); p.meshNormal = facet; "
                        "float2 slope = tgShadowPlanarSlope(facet, p.axisX, p.axisY, p.toLight, tgLightRays(), p.footprint); "
                        "PlanarPlace at = planarPlace(p, slope, 0.7072); "
                        "return float4(lit - tgShadowSharp(gShadowMap, gShadow, at.uv, at.depth - dot(abs(slope), 1.0), slope), 0, 0, 0);",
                    {linear(0.1, 0.9, 2), linear(596, 604), linear(0.16, 1), linear(0.05, 0.95)}, [](const Inputs&) { return values(0); }));
    cases.back().map = &shadowMap();
    cases.back().filtered = false;
    cases.back().tolerance = {.forward = 0, .backward = 0, .absolute = 1e-6, .why = "the same call"};
    cases.back().domain = [](const Inputs& x) { return x.scalar(2) > 0.155 && x.scalar(3) > 0.04 && x.scalar(3) < 0.96; };
    return cases;
}

/// Places along a row of 256 texels; of every fifth one nothing is known.
glm::dvec4 wayPlace(int x) {
    return {0.1 * x, 0.001 * x * x, 5 - 0.05 * x, x % 5 == 0 ? 0 : 1};
}

std::vector<FunctionCase> facets() {
    std::vector<FunctionCase> cases;
    cases.push_back(pyramidCase("facetBend",
                                std::string(kFacing) + "p.meshNormal = float3(sqrt(1.0 - a0 * a0), 0, a0); p.footprint = a1; return "
                                                       "float4(facetBend(p, a2), 0, 0, 0);",
                                {linear(0.2, 0.95), linear(0.1, 1), linear(-2, 2, 2)}, [](const Inputs& x) {
                                    const double rise = x.scalar(1) * std::sqrt(1 - x.scalar(0) * x.scalar(0)) / x.scalar(0);
                                    return values(std::abs(x.scalar(2) - rise) + std::abs(x.scalar(2, 1)));
                                }));
    cases.back().domain = [](const Inputs& x) { return x.scalar(0) > 0.16 && x.scalar(0) < 0.999 && x.scalar(1) > 0; };
    cases.push_back(pyramidCase("atlasWay",
                                "float3 place = gAtlasPositionMap.Load(int3(a0, 0, 0)).xyz; "
                                "return float4(atlasWay(float2((a0 + 0.5) / 256.0, 0.5), place, float2(1.0, 0.0)), 0);",
                                {whole(0, 254)}, [](const Inputs& x) {
                                    const auto at = static_cast<int>(std::lround(x.scalar(0)));
                                    if (wayPlace(at + 1).w <= 0) return values(0);
                                    const glm::dvec3 way = kSkinScale * glm::dvec3(wayPlace(at + 1) - wayPlace(at));
                                    return values(way.x, way.y, way.z);
                                }));
    cases.back().maps["gAtlasPositionMap"] = mapOf(256, 1, [](int x, int) {
        const glm::dvec4 place = wayPlace(x);
        return texelOf(place.x, place.y, place.z, place.w);
    });
    cases.back().filtered = false;
    cases.back().tolerance = {.forward = 16, .backward = 0, .absolute = 3e-5, .why = "differences of places up to 140"};
    cases.push_back(pyramidCase("facetNormal",
                                "LitPoint p = (LitPoint)0; p.meshNormal = a2; p.toLight = a3; return float4(facetNormal(p, a0, a1), 0);",
                                {linear(-1, 1, 3), linear(-1, 1, 3), unit(), unit()}, [](const Inputs& x) {
                                    glm::dvec3 facet = glm::normalize(glm::cross(x.vec3(0), x.vec3(1)));
                                    if (glm::dot(facet, x.vec3(2)) < 0) facet = -facet;
                                    const bool one = glm::dot(facet, x.vec3(2)) > 0.7 && glm::dot(facet, x.vec3(3)) > 0;
                                    const glm::dvec3 normal = one ? facet : x.vec3(2);
                                    return values(normal.x, normal.y, normal.z);
                                }));
    cases.back().tolerance = {.forward = 16, .backward = 4, .absolute = 1e-4, .why = "a cross product that may cancel to 0.01"};
    cases.back().domain = [](const Inputs& x) {
        const glm::dvec3 across = glm::cross(x.vec3(0), x.vec3(1));
        if (glm::length(across) < 0.01 || !isUnit(x.vec3(2)) || !isUnit(x.vec3(3))) return false;
        const double mesh = glm::dot(glm::normalize(across), x.vec3(2));
        return std::abs(std::abs(mesh) - 0.7) > 1e-4 && std::abs(glm::dot(glm::normalize(across), x.vec3(3))) > 1e-4;
    };
    return cases;
}

/// A map of half the texels along a side: of each four by four of the finer one, weighted 1, 3, 3, 1 both ways; the border goes on.
TestMap halved(const TestMap& finer) {
    TestMap map{.size = finer.size / 2};
    constexpr std::array<double, 4> kWeights = {1.0 / 8, 3.0 / 8, 3.0 / 8, 1.0 / 8};
    for (int y = 0; y < map.size; ++y)
        for (int x = 0; x < map.size; ++x) {
            glm::dvec4 sum(0);
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
            finest.texels.push_back({0.5F + 0.4F * std::sin(0.9F * static_cast<float>(x)), 0.01F * static_cast<float>(y * y % 97),
                                     static_cast<float>((x * 7 + y * 3) % 11), x % 5 == 0 ? 0.0F : 1.0F});
    const TestMap last = halved(halved(halved(finest)));
    FunctionCase made = pyramidCase(
        "PYRAMID_REDUCE_CS",
        "[loop] for (uint i = 0; i < 3 * 64; i++) " + entry + "CS(uint3(a0, a1, 0), i % 64); return gEntry" + std::to_string(from + 3) +
            "Store;",
        {whole(0, last.size / 4 - 1), whole(0, last.size / 4 - 1)},
        [=](const Inputs& x) { return values(last.texel(4 * static_cast<int>(x.scalar(0)) + 3, 4 * static_cast<int>(x.scalar(1)) + 3)); },
        size);
    made.maps["gEntry" + std::to_string(from) + "Map"] = finest;
    made.tolerance = {
        .forward = 16, .backward = 0, .absolute = 2e-6, .why = "sums of 16, thrice; a linear filter has the quarters exactly"};
    made.samples = 64;
    return made;
}

std::vector<FunctionCase> computed() {
    const Tolerance exact{.forward = 2, .backward = 0, .why = "quotients of whole numbers"};
    std::vector<FunctionCase> cases = {reducedByGroup("ReduceFine", 0, 256), reducedByGroup("ReduceCoarse", 3, 512)};
    cases.push_back(pyramidCase("texelAt", "return float4(texelAt(uint3(a0, a1, 3), 100.0).uv, 0, 0);", {whole(0, 99), whole(0, 99)},
                                [](const Inputs& x) { return values((x.scalar(0) + 0.5) / 100, (x.scalar(1) + 0.5) / 100); }));
    cases.back().tolerance = exact;
    // The nearest of the four texels of a finer map, whose middles lie 1.25 before and behind where the texel's middle is.
    cases.push_back(pyramidCase("reducedFrom", "return float4(reducedFrom(int2(a0, a1), 16.0, 32.0), 0, 0);", {whole(0, 15), whole(0, 15)},
                                [](const Inputs& x) { return values((x.scalar(0) + 0.5) * 2 - 1.25, (x.scalar(1) + 0.5) * 2 - 1.25); }));
    cases.back().tolerance = exact;
    cases.push_back(pyramidCase("reducesTexel", "return float4(reducesTexel(int2(a0, a1), int2(a2, a3), 4) ? 1.0 : 0.0, 0, 0, 0);",
                                {whole(0, 15), whole(0, 15), whole(0, 3), whole(0, 3)}, [](const Inputs& x) {
                                    const bool mine =
                                        std::floor(x.scalar(0) / 4) == x.scalar(2) && std::floor(x.scalar(1) / 4) == x.scalar(3);
                                    return values(mine ? 1 : 0);
                                }));
    cases.back().tolerance = exact;
    return cases;
}

} // namespace

std::vector<FunctionCase> pyramidPassCases() {
    return together(weights(), entryPoints(), entering(), shadows(), facets(), computed());
}

} // namespace tegument::test
