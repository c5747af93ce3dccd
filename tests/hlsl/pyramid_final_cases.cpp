// The last pass of the pyramid (effects/passes/pyramid_final.fxh, and what pyramid_compute.fxh knows of a pixel) in double precision.

#include "tests/hlsl/pyramid_pass_scene.h"

namespace tegument::test {

namespace {

const std::vector<dvec4> kWide = {{0.1, 0.2, 0.3, 0.5}, {0.3, -0.4, 0.1, -0.09}, {-0.6, -0.7, -0.8, -3}, {0.05, 0.5, 0.2, 30}};

dvec3 ownWeightOf(const dvec4& wide) {
    return wide.w < 0 ? weightBesideLinks(0, -wide.w, kTestMapSize) : ladderAt(0, wide.w);
}

/// wide: texel of what the levels have added up to. colour.w: whether it scatters.
dvec3 pictureOf(const dvec4& wide, const dvec4& colour, const dvec3& normal, const dvec3& world) {
    const dvec3 albedo(colour);
    const double scatters = colour.w;
    const dvec3 toLight(0, 0, 1);
    const double shadow = normal.z > 0 ? 1 : 0; // nothing hides the light but the surface itself
    const dvec3 toEye = normalize(kSkinCamera - world);
    const dvec3 entering = enteringSkin(albedo, normal.z, shadow);
    const dvec3 leaving = max(entering * ownWeightOf(wide) + dvec3(wide), 0.0);
    const dvec3 skin = leaving * skinColour(albedo, 1 - kSkinMix) * kSkinLeft;
    const dvec3 plain = albedo * kSkinLight * saturate(normal.z) * shadow;
    const double roughness = kPlainRoughness + scatters * (kSkinRoughness - kPlainRoughness);
    const double intensity = kPlainIntensity + scatters * (kSkinIntensity - kPlainIntensity);
    return mix(plain, skin, scatters) + kSkinLight * shadow * mirrored(normal, toLight, toEye, roughness, intensity);
}

void pictures(Cases& cases) {
    cases += pyramidCase("ownWeight(float4(0, 0, 0, a1 * (a0 > 0.5 ? -1.0 : 1.0)))", {whole(0, 1), logarithmic(0.02, 3)}, [](In x) {
        const double density = max(x[1], 1e-6);
        const double linked = x[0] > 0.5 ? -1 : 1;
        return ownWeightOf({0, 0, 0, linked * density});
    });
    cases.back().domain = [](In x) { return x[1] > 1e-3; };
    cases +=
        pyramidCase({"finalColour", "FinalVarying v = (FinalVarying)0; v.uv = float2((a0 + 0.5) / 4.0, 0.5); v.world = a4; LitPoint p = "
                                    "(LitPoint)0; p.albedo = a1; p.scatters = a2; p.normal = a3; p.meshNormal = float3(0, 0, 1); p.toLight "
                                    "= float3(0, 0, 1); p.cosine = a3.z; p.footprint = 0.2; p.axisX = float3(1, 0, 0); p.axisY = float3(0, "
                                    "1, 0); p.lightUv = 0.5; p.light = gLightColor; return finalColour(v, p, p.meshNormal);"},
                    {whole(0, 3), linear(0.05, 1, 3), linear(0, 1), unit(), linear(-40, 40, 3)}, [](In x) {
                        const dvec4& wide = kWide[static_cast<std::size_t>(round(x[0]))];
                        return dvec4(pictureOf(wide, dvec4(x.vec3(1), x[2]), x.vec3(3), x.vec3(4)), 1);
                    });
    cases.back().maps["gLight0Map"] = rowOfTexels(kWide);
    cases.back().maps["gShadowMap"] = oneTexel(0);
    cases.back().tolerance.backward = 16;
    cases.back().tolerance.absolute = 1e-3; // a table's filter of 8 bits, of light that was brought back by the third of its colour
    cases.back().domain = [](In x) { return isUnit(x.vec3(3)) && abs(x.scalar(3, 2)) > 1e-5; };
}

/// As wide as the first Gaussian of skin where the map resolves that, else as sharp as the map; of plain material three quarters of a texel
/// at least. The surface faces the light.
double shadowAt(In x) {
    const dvec2 uv = x.vec2(0);
    const double depth = x[1] - kSkinTolerance;
    const double footprint = x[2];
    const bool plain = x[3] < 0.5;
    if (plain || footprint < 0.15) {
        const double narrow = sqrt(0.0064 / 1.25); // four taps in a row have 5/4 of their distance squared as their variance
        return tapsLit(uv, depth, footprint, plain ? max(0.75 * footprint, narrow) : narrow);
    }
    const double texel = 1.0 / kTestMapSize;
    const dvec2 corner = floor(uv / texel - 0.5);
    const dvec2 f = uv / texel - 0.5 - corner;
    const auto weight = [](int i, double part) { return (i == 0 ? 1 - part : i == 3 ? part : 1) / 3; }; // a box of three over one of one
    double lit = 0;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            lit += weight(i, f.x) * weight(j, f.y) * litAt((corner + dvec2(i, j) - 0.5) * texel, depth);
    return saturate(3 * (lit - 0.5) + 0.5);
}

Cases shadows() {
    FunctionCase made = pyramidCase(
        {"finalShadow",
         std::string(kFacing) +
             "p.lightUv = a0; p.depth = a1; p.footprint = a2; p.scatters = a3; return float4(finalShadow(p, p.meshNormal), 0, 0, 0);"},
        {linear(0.1, 0.9, 2), linear(596, 604), linear(0.05, 0.4), whole(0, 1)}, [](In x) { return shadowAt(x); });
    made.map = &shadowMap();
    made.filtered = false;
    made.samples = 2048;
    made.tolerance = kTapTolerance;
    made.domain = [](In x) { return x[2] > 0.05 && abs(x[2] - 0.15) > 1e-4; };
    // Regression check: seen edge-on the look-up moves aside by half of a texel's diagonal where the nearest texels are smoothed. The plane
    // is the facet's, whatever the mesh's normal.
    FunctionCase steep = made;
    steep.body =
        "LitPoint p = (LitPoint)0; p.toLight = float3(0, 0, 1); p.axisX = float3(1, 0, 0); p.axisY = float3(0, 1, 0); "
        "p.meshNormal = float3(sqrt(1.0 - a3 * a3), 0, a3); float3 facet = p.meshNormal; p.cosine = a3; p.lightUv = a0; p.depth = a1; "
        "p.footprint = a2; p.scatters = 1.0; "
        "float2 slope = tgShadowPlanarSlope(p.meshNormal, p.axisX, p.axisY, p.toLight, tgLightRays(), p.footprint); "
        "PlanarPlace at = planarPlace(p, slope, 0.7072); p.meshNormal = float3(0, 0, 1); "
        "return float4(finalShadow(p, facet) - tgShadowSharp(gShadowMap, gShadow, at.uv, at.depth - dot(abs(slope), 1.0), slope), 0, 0, "
        "0);";
    steep.arguments = {linear(0.1, 0.9, 2), linear(596, 604), linear(0.16, 0.4), linear(0.02, 0.12)};
    steep.expected = [](In) { return 0; };
    steep.tolerance = {0, 0, 1e-6, "the same call, above the mesh's horizon"};
    steep.domain = [](In x) { return x[2] > 0.155 && x[3] > 0.015; };
    return {made, steep};
}

/// Eight by eight pixels of a picture: u, v, and whether there is a surface.
dvec4 pixelOf(int x, int y) {
    return {0.3 + 0.02 * x + 0.003 * y * y + (x > 4 ? 0.4 : 0), 0.5 + 0.015 * y - 0.002 * x * x + (y > 5 ? 0.3 : 0),
            (x * 3 + y * 5) % 11 == 0 ? 1 : 0.5, 0};
}

/// Of two neighbours that are seen the mean step; where one is missing, or its step is longer by the root of two, the other one's.
double stepAt(int x, int y, int dx, int dy) {
    const dvec2 here(pixelOf(x, y));
    std::vector<dvec2> steps;
    for (int sign : {1, -1}) {
        const int i = x + sign * dx;
        const int j = y + sign * dy;
        if (i < 0 || j < 0 || i > 7 || j > 7 || pixelOf(i, j).z >= 1) continue;
        steps.push_back(double(sign) * (dvec2(pixelOf(i, j)) - here)); // along the way
    }
    if (steps.empty()) return 0;
    if (steps.size() == 1) return length(steps[0]);
    const double a = length(steps[0]);
    const double b = length(steps[1]);
    return max(a, b) < sqrt(2) * min(a, b) ? length(0.5 * (steps[0] + steps[1])) : min(a, b);
}

double wayDepth(int x, int y) {
    return 0.2 + 0.01 * x + 0.02 * y + (x > 4 ? 0.3 : 0) + (y > 2 ? 0.1 : 0);
}

/// To the neighbour along a row or a column whose depth is nearer; there is none beyond the border, and the way there is 0.
FunctionCase ways() {
    FunctionCase made =
        pyramidCase({"placeWay", "int2 at = int2(a0, a1); float depth = gPlaceDepthMap.Load(int3(at, 0)).x; int2 way = a2 > 0.5 ? int2(0, "
                                 "1) : int2(1, 0); return float4(placeWay(at, placeWorld(at, depth), depth, way), 0);"},
                    {whole(0, 7), whole(0, 7), whole(0, 1)}, [](In x) {
                        const glm::ivec2 at(std::lround(x[0]), std::lround(x[1]));
                        const glm::ivec2 way = x[2] > 0.5 ? glm::ivec2(0, 1) : glm::ivec2(1, 0);
                        const auto depth = [](const glm::ivec2& p) { return wayDepth(p.x, p.y); };
                        const glm::ivec2 after = min(at + way, 7);
                        const glm::ivec2 before = max(at - way, 0);
                        const bool forwards = abs(depth(after) - depth(at)) < abs(depth(before) - depth(at)) - 1e-6;
                        const dvec2 step = dvec2(forwards ? after - at : at - before) * dvec2(5, -4);
                        return values(step.x, step.y, 30 * (forwards ? depth(after) - depth(at) : depth(at) - depth(before)));
                    });
    made.globals["gViewProjectionInverse"] = {20, 0, 0, 0, 0, 16, 0, 0, 0, 0, 30, 0, 0, 0, -8, 1};
    made.maps["gPlaceDepthMap"] = mapOf(8, 8, [](int x, int y) { return texelOf(wayDepth(x, y)); });
    // Where both are as near, which is nearer is a matter of rounding, and the two ways are the same.
    made.tolerance = {16, 0, 2e-5, "differences of places up to 30"};
    return made;
}

Cases pixels() {
    FunctionCase made = pyramidCase(
        {"placeFootprint", "int2 at = int2(a0, a1); return float4(placeFootprint(at, gPlaceMap.Load(int3(at, 0)).xy), 0, 0, 0);"},
        {whole(0, 7), whole(0, 7)}, [](In x) {
            const auto i = static_cast<int>(round(x[0]));
            const auto j = static_cast<int>(round(x[1]));
            return max({stepAt(i, j, 1, 0), stepAt(i, j, 0, 1), 1e-10});
        });
    made.maps["gPlaceMap"] = mapOf(8, 8, [](int x, int y) { return texelOf(pixelOf(x, y).x, pixelOf(x, y).y); });
    made.maps["gPlaceDepthMap"] = mapOf(8, 8, [](int x, int y) { return texelOf(pixelOf(x, y).z); });
    made.tolerance = {16, 0, 4e-7, "differences of places up to 1"};
    return {made, ways()};
}

const dvec4 kSeenColour = {0.3, 0.7, 0.2, 0.6};

dvec3 seenNormal(int x, int y) {
    return normalize(dvec3(0.3 * x - 1, 0.8 - 0.25 * y, (x + y) % 3 == 0 ? -0.4 : 0.5));
}

/// A point of the square that the octahedron of |x| + |y| + |z| = 1 is folded to, brought to 0..1.
dvec2 storedNormal(const dvec3& n) {
    const dvec3 p = n / (abs(n.x) + abs(n.y) + abs(n.z));
    const dvec2 outside(std::copysign(1 - abs(p.y), p.x), std::copysign(1 - abs(p.x), p.y));
    return 0.5 + 0.5 * (p.z < 0 ? outside : dvec2(p));
}

double seenDepth(int x, int y) {
    return (x * 3 + y * 5) % 11 == 0 ? 1 : 0.05 * x + 0.03 * y + 0.1;
}

/// A picture of 8 x 8 pixels by the compute shader. A pixel is half a texel of the colour map wide, whose next level has another colour.
FunctionCase lighting() {
    TestMap places{.size = 8};
    TestMap depths{.size = 8};
    TestMap colours{.size = 8, .mips = 2};
    for (int i = 0; i < 64; ++i) {
        const dvec2 n = storedNormal(seenNormal(i % 8, i / 8));
        places.texels.push_back({static_cast<float>(0.2 + 0.0625 * (i % 8)), static_cast<float>(0.3 + 0.0625 * (i / 8)),
                                 static_cast<float>(n.x), static_cast<float>(n.y)});
        depths.texels.push_back({static_cast<float>(seenDepth(i % 8, i / 8)), 0, 0, 0});
        colours.texels.push_back({0.3F, 0.7F, 0.2F, 0.6F});
    }
    colours.texels.resize(64 + 16, {0.9F, 0.1F, 0.5F, 0.1F});
    // nothing is seen, and nothing stored
    FunctionCase made = pyramidCase({"FinalCS", "FinalCS(uint3(a0, a1, 0)); return gPictureStore;"}, {whole(0, 7), whole(0, 7)}, [](In x) {
        const auto i = static_cast<int>(round(x[0]));
        const auto j = static_cast<int>(round(x[1]));
        const double depth = seenDepth(i, j);
        if (depth >= 1) return dvec4(0);
        const dvec3 world(5 * (i + 0.5) - 20, 16 - 4 * (j + 0.5), 30 * depth - 8);
        return dvec4(pictureOf(kWide[0], kSeenColour, seenNormal(i, j), world), 1);
    });
    made.globals["gViewProjectionInverse"] = {20, 0, 0, 0, 0, 16, 0, 0, 0, 0, 30, 0, 0, 0, -8, 1};
    made.maps["gPlaceMap"] = places;
    made.maps["gPlaceDepthMap"] = depths;
    made.maps["gSkinMap"] = colours;
    made.maps["gAtlasTangentMap"] = oneTexel(1, 0, 0, 1);
    made.maps["gLight0Map"] = oneTexel(kWide[0].x, kWide[0].y, kWide[0].z, kWide[0].w);
    made.maps["gShadowMap"] = oneTexel(0);
    made.samples = 256;
    made.tolerance.absolute = 1e-3; // as finalColour
    return made;
}

Cases lightings() {
    return {lighting()};
}

} // namespace

Cases pyramidFinalCases() {
    return together(pictures, shadows(), pixels(), lightings());
}

} // namespace tegument::test
