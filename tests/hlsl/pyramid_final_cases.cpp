// The last pass of the pyramid (effects/passes/pyramid_final.fxh, and what pyramid_compute.fxh knows of a pixel) in double precision.

#include "tests/hlsl/pyramid_pass_scene.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

const std::vector<glm::dvec4> kWide = {{0.1, 0.2, 0.3, 0.5}, {0.3, -0.4, 0.1, -0.09}, {-0.6, -0.7, -0.8, -3}, {0.05, 0.5, 0.2, 30}};

glm::dvec3 ownWeightOf(const glm::dvec4& wide) {
    return wide.w < 0 ? weightBesideLinks(0, -wide.w, kTestMapSize) : ladderAt(0, wide.w);
}

/// Arguments: the texel, colour, whether it scatters, the normal, world.
glm::dvec3 pictureOf(const Inputs& x) {
    const glm::dvec4 wide = kWide[static_cast<std::size_t>(std::round(x.scalar(0)))];
    const glm::dvec3 albedo = x.vec3(1);
    const double scatters = x.scalar(2);
    const glm::dvec3 normal = x.vec3(3);
    const glm::dvec3 toLight(0, 0, 1);
    const double shadow = normal.z > 0 ? 1 : 0; // nothing hides the light but the surface itself
    const glm::dvec3 toEye = glm::normalize(kSkinCamera - x.vec3(4));
    const glm::dvec3 entering = enteringSkin(albedo, normal.z, shadow);
    const glm::dvec3 leaving = glm::max(entering * ownWeightOf(wide) + glm::dvec3(wide), 0.0);
    const glm::dvec3 skin = leaving * skinColour(albedo, 1 - kSkinMix) * kSkinLeft;
    const glm::dvec3 plain = albedo * kSkinLight * std::clamp(normal.z, 0.0, 1.0) * shadow;
    const double roughness = kPlainRoughness + scatters * (kSkinRoughness - kPlainRoughness);
    const double intensity = kPlainIntensity + scatters * (kSkinIntensity - kPlainIntensity);
    return glm::mix(plain, skin, scatters) + kSkinLight * shadow * mirrored(normal, toLight, toEye, roughness, intensity);
}

std::vector<FunctionCase> pictures() {
    std::vector<FunctionCase> cases;
    cases.push_back(pyramidCase("ownWeight", "return float4(ownWeight(float4(0, 0, 0, a1 * (a0 > 0.5 ? -1.0 : 1.0))), 0);",
                                {whole(0, 1), logarithmic(0.02, 3)}, [](const Inputs& x) {
                                    const double density = std::max(x.scalar(1), 1e-6);
                                    const double linked = x.scalar(0) > 0.5 ? -1 : 1;
                                    return values(ownWeightOf({0, 0, 0, linked * density}));
                                }));
    cases.back().domain = [](const Inputs& x) { return x.scalar(1) > 1e-3; };
    cases.push_back(
        pyramidCase("finalColour",
                    "FinalVarying v = (FinalVarying)0; v.uv = float2((a0 + 0.5) / 4.0, 0.5); v.world = a4; LitPoint p = (LitPoint)0; "
                    "p.albedo = a1; p.scatters = a2; p.normal = a3; p.meshNormal = float3(0, 0, 1); p.toLight = float3(0, 0, 1); "
                    "p.cosine = a3.z; p.footprint = 0.2; p.axisX = float3(1, 0, 0); p.axisY = float3(0, 1, 0); p.lightUv = 0.5; "
                    "return finalColour(v, p);",
                    {whole(0, 3), linear(0.05, 1, 3), linear(0, 1), unit(), linear(-40, 40, 3)},
                    [](const Inputs& x) { return values(glm::dvec4(pictureOf(x), 1)); }));
    cases.back().maps["gLight0Map"] = rowOfTexels(kWide);
    cases.back().maps["gShadowMap"] = oneTexel(0);
    cases.back().tolerance.backward = 16;
    cases.back().tolerance.absolute = 1e-3; // a table's filter of 8 bits, of light that was brought back by the third of its colour
    cases.back().domain = [](const Inputs& x) { return isUnit(x.vec3(3)) && std::abs(x.scalar(3, 2)) > 1e-5; };
    return cases;
}

/// As wide as the first Gaussian of skin where the map resolves that, else as sharp as the map; of plain material three quarters of a texel
/// at least. The surface faces the light.
double shadowAt(const Inputs& x) {
    const glm::dvec2 uv = x.vec2(0);
    const double depth = x.scalar(1) - kSkinTolerance;
    const double footprint = x.scalar(2);
    const bool plain = x.scalar(3) < 0.5;
    if (plain || footprint < 0.15) {
        const double narrow = std::sqrt(0.0064 / 1.25); // four taps in a row have 5/4 of their distance squared as their variance
        return tapsLit(uv, depth, footprint, plain ? std::max(0.75 * footprint, narrow) : narrow);
    }
    const double texel = 1.0 / kTestMapSize;
    const glm::dvec2 corner = glm::floor(uv / texel - 0.5);
    const glm::dvec2 f = uv / texel - 0.5 - corner;
    double lit = 0;
    for (int i = 0; i < 4; ++i)
        lit += (i % 2 == 0 ? 1 - f.x : f.x) * (i < 2 ? 1 - f.y : f.y) * litAt((corner + glm::dvec2(i % 2, i / 2) + 0.5) * texel, depth);
    return lit;
}

std::vector<FunctionCase> shadows() {
    FunctionCase made = pyramidCase(
        "finalShadow",
        std::string(kFacing) + "p.lightUv = a0; p.depth = a1; p.footprint = a2; p.scatters = a3; return float4(finalShadow(p), 0, 0, 0);",
        {linear(0.1, 0.9, 2), linear(596, 604), linear(0.05, 0.4), whole(0, 1)}, [](const Inputs& x) { return values(shadowAt(x)); });
    made.map = &shadowMap();
    made.filtered = false;
    made.samples = 2048;
    made.tolerance = kTapTolerance;
    made.domain = [](const Inputs& x) { return x.scalar(2) > 0.05 && std::abs(x.scalar(2) - 0.15) > 1e-4; };
    return {made};
}

/// Eight by eight pixels of a picture: u, v, and whether there is a surface.
glm::dvec4 pixelOf(int x, int y) {
    return {0.3 + 0.02 * x + 0.003 * y * y + (x > 4 ? 0.4 : 0), 0.5 + 0.015 * y - 0.002 * x * x + (y > 5 ? 0.3 : 0),
            (x * 3 + y * 5) % 11 == 0 ? 1 : 0.5, 0};
}

/// Of two neighbours that are seen the mean step; where one is missing, or its step is longer by the root of two, the other one's.
double stepAt(int x, int y, int dx, int dy) {
    const glm::dvec2 here(pixelOf(x, y));
    std::vector<glm::dvec2> steps;
    for (int sign : {1, -1}) {
        const int i = x + sign * dx;
        const int j = y + sign * dy;
        if (i < 0 || j < 0 || i > 7 || j > 7 || pixelOf(i, j).z >= 1) continue;
        steps.push_back(double(sign) * (glm::dvec2(pixelOf(i, j)) - here)); // along the way
    }
    if (steps.empty()) return 0;
    if (steps.size() == 1) return glm::length(steps[0]);
    const double a = glm::length(steps[0]);
    const double b = glm::length(steps[1]);
    return std::max(a, b) < std::sqrt(2) * std::min(a, b) ? glm::length(0.5 * (steps[0] + steps[1])) : std::min(a, b);
}

std::vector<FunctionCase> pixels() {
    FunctionCase made =
        pyramidCase("placeFootprint", "int2 at = int2(a0, a1); return float4(placeFootprint(at, gPlaceMap.Load(int3(at, 0)).xy), 0, 0, 0);",
                    {whole(0, 7), whole(0, 7)}, [](const Inputs& x) {
                        const auto i = static_cast<int>(std::round(x.scalar(0)));
                        const auto j = static_cast<int>(std::round(x.scalar(1)));
                        return values(std::max({stepAt(i, j, 1, 0), stepAt(i, j, 0, 1), 1e-10}));
                    });
    made.maps["gPlaceMap"] = mapOf(8, 8, [](int x, int y) { return texelOf(pixelOf(x, y).x, pixelOf(x, y).y); });
    made.maps["gPlaceDepthMap"] = mapOf(8, 8, [](int x, int y) { return texelOf(pixelOf(x, y).z); });
    made.tolerance = {.forward = 16, .backward = 0, .absolute = 4e-7, .why = "differences of places up to 1"};
    return {made};
}

} // namespace

std::vector<FunctionCase> pyramidFinalCases() {
    return together(pictures(), shadows(), pixels());
}

} // namespace tegument::test
