// What d'Eon and Luebke's last passes make of their maps (effects/passes/final.fxh, skin_point.fxh, surface.fxh, light_by_light.fxh) and
// Gosselin's of his, in double precision: docs/design/skin.md.

#include "tests/hlsl/skin_scene.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

const Tolerance kProducts = {.forward = 32, .backward = 8, .absolute = 4e-6, .why = "products and sums of a dozen numbers up to 2, powers"};

FunctionCase mainCase(const char* function, std::string body, std::vector<Argument> arguments,
                      std::function<Values(const Inputs&)> expected) {
    return skinCase("Main.fx", function, std::move(body), std::move(arguments), std::move(expected), kProducts);
}

/// Maps 1 to 6 along U. Alpha: thickness, exp(-t / 5 mm); 1 where there is nothing.
const std::vector<std::vector<glm::dvec4>> kMaps = {
    {{0.3, 0.2, 0.1, 0.4}, {0.5, 0.6, 0.7, 1}, {0.9, 0.4, 0.2, 0.7}, {0.1, 0.3, 0.8, 1}},
    {{0.25, 0.35, 0.15, 0.5}, {0.55, 0.65, 0.35, 0.6}, {0.7, 0.1, 0.6, 1}, {0.2, 0.9, 0.3, 1}},
    {{0.45, 0.3, 0.25, 0.8}, {0.15, 0.85, 0.4, 1}, {0.6, 0.5, 0.1, 0.7}, {0.8, 0.2, 0.7, 1}},
    {{0.75, 0.4, 0.3, 0.9}, {0.35, 0.05, 0.9, 0.6}, {0.4, 0.7, 0.5, 1}, {0.5, 0.1, 0.2, 1}},
    {{0.2, 0.6, 0.55, 0.85}, {0.65, 0.25, 0.45, 1}, {0.3, 0.8, 0.15, 0.8}, {0.9, 0.5, 0.6, 1}},
    {{0.85, 0.15, 0.35, 0.75}, {0.05, 0.45, 0.95, 0.7}, {0.5, 0.9, 0.05, 1}, {0.4, 0.6, 0.1, 1}}};

void addMaps(FunctionCase& made) {
    for (std::size_t i = 0; i < kMaps.size(); ++i)
        made.maps[i == 0 ? "gIrradianceMap" : "gIrradiance" + std::to_string(i + 1) + "Map"] = rowOfTexels(kMaps[i]);
}

bool isValid(const glm::dvec4& texel) {
    return texel.w < 0.995;
}

double thicknessOf(double alpha) {
    return -std::log(std::max(alpha, 1e-6)) / 0.2;
}

/// Share of a Gaussian that comes through a body of this thickness, and of it what diffusion along the surface has not brought already.
double passedBy(double thickness, double variance, double apart) {
    return std::exp(-thickness * thickness / (2 * variance)) * std::clamp(apart / (6 * std::sqrt(variance)), 0.0, 1.0);
}

/// The table's own widths are not quite the roots of its variances; those of any other variance are.
FunctionCase widths() {
    FunctionCase made = mainCase("gaussianWidth", "return float4(gaussianWidth(2), gaussianWidth(3), gaussianWidth(4), gaussianWidth(5));",
                                 {linear(0, 1)}, [](const Inputs&) { return values(0.432, 0.753, std::sqrt(1.98), 0); });
    made.globals["gGaussianWeight"] = {0, 0, 0, 0.0064, 0, 0, 0, 0.0484, 0, 0, 0, 0.187, 0, 0, 0, 0.567, 0, 0, 0, 1.98, 0, 0, 0, -1};
    made.tolerance = {.forward = 4, .backward = 0, .why = "a root"};
    made.samples = 4;
    return made;
}

std::vector<FunctionCase> fetches() {
    std::vector<FunctionCase> cases = {widths()};
    cases.push_back(mainCase("fetchHere", "return fetchHere(gIrradiance2Map, gFinal2, float2((a0 + 0.5) / 4.0, 0.5), a1);",
                             {whole(0, 3), linear(0, 1, 3)}, [](const Inputs& x) {
                                 const glm::dvec4 texel = kMaps[1][static_cast<std::size_t>(std::round(x.scalar(0)))];
                                 return values(isValid(texel) ? texel : glm::dvec4(x.vec3(1), std::exp(-0.2 * 5000)));
                             }));
    addMaps(cases.back());
    cases.push_back(mainCase(
        "fetchThere", "return float4(fetchThere(gIrradiance4Map, gFinal4, float2((a0 + 0.5) / 4.0, 0.5), float4(0, 0, 0, a1), a2, a3), 0);",
        {whole(0, 3), linear(0.05, 0.95), linear(0.1, 2, 4), linear(0, 12)}, [](const Inputs& x) {
            const glm::dvec4 texel = kMaps[3][static_cast<std::size_t>(std::round(x.scalar(0)))];
            const double passed = passedBy(thicknessOf(x.scalar(1)), x.scalar(2, 3), x.scalar(3));
            return values(x.vec3(2) * glm::dvec3(texel) * (isValid(texel) ? passed : 0));
        }));
    addMaps(cases.back());
    cases.back().domain = [](const Inputs& x) { return x.scalar(2, 3) > 0.05 && x.scalar(1) > 0.01; };
    // Beside what the slab lets through by hlsl/scatter/slab.fxh, which has a case of its own.
    cases.push_back(
        mainCase("fetchThrough",
                 "float3 passed = tgSlabPassed(tgTransmissionDecode(a1, 300.0)); return float4(fetchThrough(gIrradiance6Map, gFinal6, "
                 "float2((a0 + 0.5) / 4.0, 0.5), float4(0, 0, 0, a1), a2) / passed, 0);",
                 {whole(0, 3), linear(0.05, 0.95), linear(0, 30)}, [](const Inputs& x) {
                     const glm::dvec4 texel = kMaps[5][static_cast<std::size_t>(std::round(x.scalar(0)))];
                     const double fade = std::clamp(x.scalar(2) / (6 * std::sqrt(kSkinGaussians[5].w)), 0.0, 1.0);
                     return values(isValid(texel) ? fade * glm::dvec3(texel) : glm::dvec3(0));
                 }));
    addMaps(cases.back());
    cases.back().defines = {{"TEGUMENT_SLAB", "1"}};
    cases.push_back(mainCase("lightEntry", "LitPoint p = (LitPoint)0; p.lightUv = 0.5; p.depth = a0; return lightEntry(p);",
                             {linear(148, 152)}, [](const Inputs& x) {
                                 const double path = x.scalar(0) - 150;
                                 return values(0.7, 0.3, std::max(path, 0.0), path > -kSkinTolerance ? 1 : 0);
                             }));
    cases.back().maps["gTsmMap"] = oneTexel(150, 0.7, 0.3, 1);
    cases.back().tolerance.backward = 1;
    return cases;
}

/// 200 mm of surface for a unit of uv: a pixel is 0.001 of the map and 0.2 mm wide.
constexpr const char* kStep =
    "float2 step = frac(0.5 * pixel) * 2.0; SurfaceVarying s = (SurfaceVarying)0; s.world = float3(step * 0.4, 0); "
    "s.uv = float2((a0 + 0.5) / 4.0, 0.5) + step * 0.001; ";

/// As the seed prints it light of five maps comes through: exp(-t^2 / v), whatever lies between along the surface. A body of .1 to 2 mm;
/// alpha is a share of the 300 mm between the light's planes.
FunctionCase printedTransmission() {
    const auto light = [](std::size_t map) { return glm::dvec3(0.9 - 0.1 * double(map), 0.2 + 0.1 * double(map), 0.5); };
    const auto thickness = [](std::size_t map) { return 0.8 * std::sqrt(kSkinGaussians.at(map).w); }; // of what comes through the next map
    FunctionCase made =
        mainCase("diffusedLight",
                 "SurfaceVarying s = (SurfaceVarying)0; s.uv = 0.5; LitPoint p = (LitPoint)0; p.lightUv = 0.5; p.depth = a0; "
                 "return float4(diffusedLight(s, p), 0);",
                 {linear(160, 170)}, [=](const Inputs&) {
                     glm::dvec3 sum(0);
                     for (std::size_t i = 0; i < 6; ++i) {
                         sum += glm::dvec3(kSkinGaussians.at(i)) * light(i);
                         const double t = i > 0 ? thickness(i) : 0;
                         const double passed = i > 0 ? std::exp(-t * t / kSkinGaussians.at(i).w) : 0;
                         sum += kSkinTransmission * passed * glm::dvec3(kSkinGaussians.at(i)) * light(i);
                     }
                     return values(sum);
                 });
    for (std::size_t map = 0; map < 6; ++map) { // each holds the thickness for the next
        const glm::dvec3 l = light(map);
        const double alpha = map < 5 ? thickness(map + 1) / 300 : 0.5;
        made.maps["gIrradiance" + (map == 0 ? std::string() : std::to_string(map + 1)) + "Map"] = oneTexel(l.x, l.y, l.z, alpha);
    }
    made.maps["gTsmMap"] = oneTexel(150, 0.5, 0.5, 1);
    made.settings = {0};
    made.samples = 64;
    made.tolerance = {.forward = 16, .backward = 0, .absolute = 1e-5, .why = "a sum of eleven lights; alpha keeps 1e-7 of a 300th"};
    return made;
}

std::vector<FunctionCase> diffused() {
    std::vector<FunctionCase> cases;
    cases.push_back(mainCase("diffusedLight",
                             std::string(kStep) + "LitPoint p = (LitPoint)0; p.light = gLightColor; p.albedo = a1; p.cosine = a2; p.shadow "
                                                  "= a3; p.lightUv = 0.5; p.depth = 160.0; "
                                                  "return float4(diffusedLight(s, p), 0);",
                             {whole(0, 3), linear(0.05, 1, 3), linear(-1, 1), linear(0, 1)}, [](const Inputs& x) {
                                 const auto at = static_cast<std::size_t>(std::round(x.scalar(0)));
                                 const glm::dvec3 unblurred = enteringSkin(x.vec3(1), x.scalar(2), x.scalar(3));
                                 glm::dvec3 here = unblurred * glm::dvec3(kSkinGaussians[0]);
                                 for (std::size_t i = 1; i < 6; ++i)
                                     here += glm::dvec3(kSkinGaussians[i]) * (isValid(kMaps[i][at]) ? glm::dvec3(kMaps[i][at]) : unblurred);
                                 // The light entered at u = 1/8, where all maps are valid; each one's thickness is in the map before it.
                                 const double apart = 200 * std::abs((static_cast<double>(at) + 0.5) / 4 - 0.125);
                                 glm::dvec3 there(0);
                                 for (std::size_t i = 3; i < 6; ++i) {
                                     const glm::dvec4& before = kMaps[i - 1][at];
                                     if (!isValid(before)) continue; // opaque
                                     there += glm::dvec3(kSkinGaussians[i]) * glm::dvec3(kMaps[i][0]) *
                                              passedBy(thicknessOf(before.w), kSkinGaussians[i].w, apart);
                                 }
                                 return values(here + kSkinTransmission * there);
                             }));
    addMaps(cases.back());
    cases.back().maps["gTsmMap"] = oneTexel(150, 0.125, 0.5, 1);
    cases.back().perQuad = true;
    cases.back().tolerance.absolute = 2e-5; // a step of 0.001 of the map is known to 6e-8
    cases.push_back(printedTransmission());
    return cases;
}

const std::vector<glm::dvec4> kColours = {{0.8, 0.6, 0.5, 1}, {0.3, 0.7, 0.2, 0.6}, {0.1, 0.9, 0.4, 0}, {1, 0.5, 0.25, 1}};

constexpr const char* kSurface = "SurfaceVarying s = (SurfaceVarying)0; s.uv = float2((a0 + 0.5) / 4.0, 0.5); s.normal = a1; s.world = a2; "
                                 "s.tangent = float4(1, 0, 0, 1); s.lightClip = float4(0, 0, 0.5, 1); ";

std::vector<Argument> surfaceArguments() {
    return {whole(0, 3), unit(), linear(-40, 40, 3)};
}

/// Of a surface that nothing else hides from the light: it is lit from N.L of .05 on.
struct Lit {
    glm::dvec3 albedo, normal, toEye, entering;
    double scatters, shadow, cosine;

    explicit Lit(const Inputs& x) : normal(glm::normalize(x.vec3(1))) {
        const glm::dvec4 colour = kColours[static_cast<std::size_t>(std::round(x.scalar(0)))];
        albedo = colour;
        scatters = colour.w;
        cosine = normal.z;
        shadow = std::clamp(cosine / 0.05, 0.0, 1.0);
        toEye = glm::normalize(kSkinCamera - x.vec3(2));
        entering = enteringSkin(albedo, cosine, shadow);
    }
    [[nodiscard]] glm::dvec3 plain() const { return albedo * kSkinLight * std::clamp(cosine, 0.0, 1.0) * shadow; }
    [[nodiscard]] glm::dvec3 shine() const {
        const double roughness = glm::mix(kPlainRoughness, kSkinRoughness, scatters);
        const double intensity = glm::mix(kPlainIntensity, kSkinIntensity, scatters);
        return kSkinLight * shadow * mirrored(normal, {0, 0, 1}, toEye, roughness, intensity);
    }
    [[nodiscard]] glm::dvec4 shown(const glm::dvec3& diffused) const {
        const glm::dvec3 skin = diffused * skinColour(albedo, 1 - kSkinMix) * kSkinLeft;
        return {glm::mix(plain(), skin, scatters) + shine(), 1};
    }
};

bool isNormal(const Inputs& x) {
    return isUnit(x.vec3(1));
}

void addSurface(FunctionCase& made) {
    made.maps["gSkinMap"] = rowOfTexels(kColours);
    made.maps["gShadowMap"] = oneTexel(0);
    made.maps["gTsmMap"] = oneTexel(0);
    made.domain = isNormal;
    made.tolerance.backward = 16;
    made.tolerance.absolute = 1e-5;
}

std::vector<FunctionCase> pictures() {
    std::vector<FunctionCase> cases;
    cases.push_back(mainCase("LambertPS", std::string(kSurface) + "return LambertPS(s);", surfaceArguments(), [](const Inputs& x) {
        const Lit lit(x);
        return values(lit.shown(lit.entering));
    }));
    addSurface(cases.back());
    cases.push_back(mainCase("FinalPS", std::string(kSurface) + "return FinalPS(s);", surfaceArguments(), [](const Inputs& x) {
        const Lit lit(x);
        const auto at = static_cast<std::size_t>(std::round(x.scalar(0)));
        glm::dvec3 light = lit.entering * glm::dvec3(kSkinGaussians[0]);
        for (std::size_t i = 1; i < 6; ++i)
            light += glm::dvec3(kSkinGaussians[i]) * (isValid(kMaps[i][at]) ? glm::dvec3(kMaps[i][at]) : lit.entering);
        return values(lit.shown(light));
    }));
    addSurface(cases.back());
    addMaps(cases.back());
    cases.push_back(mainCase("GosselinIrradiancePS", std::string(kSurface) + "return GosselinIrradiancePS(s);", surfaceArguments(),
                             [](const Inputs& x) {
                                 const Lit lit(x);
                                 const double kernel = kColours[static_cast<std::size_t>(std::round(x.scalar(0)))].x;
                                 const double arriving = std::clamp(lit.cosine, 0.0, 1.0) * lit.shadow;
                                 return values(glm::dvec4(kSkinLight * arriving, std::min(kernel, 0.99)));
                             }));
    addSurface(cases.back());
    cases.back().maps["gKernelSizeMap"] = rowOfTexels(kColours);
    cases.push_back(mainCase(
        "diffuseHere", "LitPoint p = (LitPoint)0; p.light = gLightColor; p.cosine = a0; p.shadow = a1; return float4(diffuseHere(p), 0);",
        {linear(-1, 1), linear(0, 1)},
        [](const Inputs& x) { return values(kSkinLight * std::clamp(x.scalar(0), 0.0, 1.0) * x.scalar(1)); }));
    cases.push_back(mainCase("surfacePoint", std::string(kSurface) + "LitPoint p = surfacePoint(s, a1); return float4(p.albedo, p.cosine);",
                             surfaceArguments(), [](const Inputs& x) { return values(1, 1, 1, x.vec3(1).z); }));
    for (const char* effect : {"Main.fx", "Pyramid.fx"}) { // a flat texel of a normal map has lost nothing
        const bool skin = effect[0] == 'M';
        cases.push_back(skinCase(
            effect, skin ? "surfacePoint" : "entryPoint",
            skin ? std::string(kSurface) + "return float4(surfacePoint(s, a1).meanNormal, surfacePoint(s, a1).shine, 0);"
                 : "LitPoint p = entryPoint(float2((a0 + 0.5) / 4.0, 0.5), 1.0, a2, a1); return float4(p.meanNormal, p.shine, 0);",
            surfaceArguments(),
            [](const Inputs& x) {
                const glm::dvec4 shine = kColours[static_cast<std::size_t>(std::round(x.scalar(0)))];
                return values(1, shine.x * 255 / 128, shine.y * 255 / 128);
            },
            kProducts));
        cases.back().defines = {{"TEGUMENT_LOBES", "1"}};
        cases.back().maps["gShineMap"] = rowOfTexels(kColours);
    }
    return cases;
}

std::vector<FunctionCase> shares() {
    std::vector<FunctionCase> cases;
    const std::vector<std::pair<std::string, std::string>> alone = {{"TEGUMENT_LAMPS", "3"}};
    cases.push_back(mainCase("ownShare", "return float4(ownShare(float4(0, 0, 0, a0), a1), 0);", {linear(0.9, 1), linear(0, 1, 4)},
                             [](const Inputs& x) { return values(x.scalar(0) < 0.995 ? glm::dvec3(0) : x.vec3(1)); }));
    cases.back().domain = [](const Inputs& x) { return std::abs(x.scalar(0) - 0.995) > 1e-5; };
    const auto skin = [](const Inputs& x) { // what no map holds of the light that enters at the point
        const Lit lit(x);
        const auto at = static_cast<std::size_t>(std::round(x.scalar(0)));
        glm::dvec3 own(kSkinGaussians[0]);
        for (std::size_t i = 1; i < 6; ++i)
            own += isValid(kMaps[i][at]) ? glm::dvec3(0) : glm::dvec3(kSkinGaussians[i]);
        return values(own * lit.albedo * lit.scatters * kSkinLeft);
    };
    cases.push_back(mainCase("SkinShare", std::string(kSurface) + "return float4(SkinShare(s).skin, 0);", surfaceArguments(), skin));
    cases.push_back(
        mainCase("skinShare", std::string(kSurface) + "return float4(SkinShare(s).plain, 0);", surfaceArguments(), [](const Inputs& x) {
            const Lit lit(x);
            return values(lit.albedo * (1 - lit.scatters));
        }));
    cases.push_back(
        mainCase("skinShare", std::string(kSurface) + "return float4(LambertShare(s).skin, 0);", surfaceArguments(), [](const Inputs& x) {
            const Lit lit(x);
            return values(lit.albedo * lit.scatters * kSkinLeft);
        }));
    for (FunctionCase& each : cases) {
        each.defines = alone;
        addLightByLight(each);
        if (each.domain) continue;
        addMaps(each);
        addSurface(each);
    }
    return cases;
}

} // namespace

std::vector<FunctionCase> skinPassCases() {
    return together(fetches(), diffused(), pictures(), shares());
}

} // namespace tegument::test
