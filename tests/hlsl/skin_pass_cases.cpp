// What d'Eon and Luebke's last passes make of their maps (effects/passes/final.fxh, skin_point.fxh, surface.fxh, light_by_light.fxh) and
// Gosselin's of his, in double precision: docs/design/skin.md.

#include "tests/hlsl/skin_scene.h"

namespace tegument::test {

namespace {

const Tolerance kProducts = {32, 8, 4e-6, "products and sums of a dozen numbers up to 2, powers"};

FunctionCase mainCase(Call call, Arguments arguments, Reference expected) {
    return skinCase("Main.fx", std::move(call), std::move(arguments), kProducts, std::move(expected));
}

/// Maps 1 to 6 along U. Alpha: thickness, exp(-t / 5 mm); 1 where there is nothing.
const std::vector<std::vector<dvec4>> kMaps = {
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

bool isValid(const dvec4& texel) {
    return texel.w < 0.995;
}

double thicknessOf(double alpha) {
    return -log(max(alpha, 1e-6)) / 0.2;
}

/// Share of a Gaussian that comes through a body of this thickness, and of it what diffusion along the surface has not brought already.
double passedBy(double thickness, double variance, double apart) {
    return exp(-thickness * thickness / (2 * variance)) * saturate(apart / (6 * sqrt(variance)));
}

/// The table's own widths are not quite the roots of its variances; those of any other variance are.
FunctionCase widths() {
    FunctionCase made =
        mainCase({"gaussianWidth", "return float4(gaussianWidth(2), gaussianWidth(3), gaussianWidth(4), gaussianWidth(5));"},
                 {linear(0, 1)}, [](In) { return values(0.432, 0.753, sqrt(1.98), 0); });
    made.globals["gGaussianWeight"] = {0, 0, 0, 0.0064, 0, 0, 0, 0.0484, 0, 0, 0, 0.187, 0, 0, 0, 0.567, 0, 0, 0, 1.98, 0, 0, 0, -1};
    made.tolerance = {4, 0, 0, "a root"};
    made.samples = 4;
    return made;
}

Cases fetches() {
    Cases cases = {widths()};
    cases += mainCase("fetchHere(gIrradiance2Map, gFinal2, float2((a0 + 0.5) / 4.0, 0.5), a1)", {whole(0, 3), linear(0, 1, 3)}, [](In x) {
        const dvec4 texel = kMaps[1][static_cast<std::size_t>(round(x[0]))];
        return isValid(texel) ? texel : dvec4(x.vec3(1), exp(-0.2 * 5000));
    });
    addMaps(cases.back());
    cases += mainCase("fetchThere(gIrradiance4Map, gFinal4, float2((a0 + 0.5) / 4.0, 0.5), float4(0, 0, 0, a1), a2, a3)",
                      {whole(0, 3), linear(0.05, 0.95), linear(0.1, 2, 4), linear(0, 12)}, [](In x) {
                          const dvec4 texel = kMaps[3][static_cast<std::size_t>(round(x[0]))];
                          const double passed = passedBy(thicknessOf(x[1]), x.scalar(2, 3), x[3]);
                          return x.vec3(2) * dvec3(texel) * (isValid(texel) ? passed : 0);
                      });
    addMaps(cases.back());
    cases.back().domain = [](In x) { return x.scalar(2, 3) > 0.05 && x[1] > 0.01; };
    // Beside what the slab lets through by hlsl/scatter/slab.fxh, which has a case of its own.
    cases += mainCase({"fetchThrough",
                       "float3 passed = tgSlabPassed(tgTransmissionDecode(a1, 300.0)); return float4(fetchThrough(gIrradiance6Map, "
                       "gFinal6, float2((a0 + 0.5) / 4.0, 0.5), float4(0, 0, 0, a1), a2) / passed, 0);"},
                      {whole(0, 3), linear(0.05, 0.95), linear(0, 30)}, [](In x) {
                          const dvec4 texel = kMaps[5][static_cast<std::size_t>(round(x[0]))];
                          const double fade = saturate(x[2] / (6 * sqrt(kSkinGaussians[5].w)));
                          return isValid(texel) ? fade * dvec3(texel) : dvec3(0);
                      });
    addMaps(cases.back());
    cases.back().defines = {{"TEGUMENT_SLAB", "1"}};
    cases += mainCase({"lightEntry", "LitPoint p = (LitPoint)0; p.lightUv = 0.5; p.depth = a0; return lightEntry(p);"}, {linear(148, 152)},
                      [](In x) {
                          const double path = x[0] - 150;
                          return values(0.7, 0.3, max(path, 0.0), path > -kSkinTolerance ? 1 : 0);
                      });
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
    const auto light = [](std::size_t map) { return dvec3(0.9 - 0.1 * double(map), 0.2 + 0.1 * double(map), 0.5); };
    const auto thickness = [](std::size_t map) { return 0.8 * sqrt(kSkinGaussians.at(map).w); }; // of what comes through the next map
    FunctionCase made = mainCase({"diffusedLight", "SurfaceVarying s = (SurfaceVarying)0; s.uv = 0.5; LitPoint p = (LitPoint)0; p.lightUv "
                                                   "= 0.5; p.depth = a0; return float4(diffusedLight(s, p), 0);"},
                                 {linear(160, 170)}, [=](In) {
                                     dvec3 sum(0);
                                     for (std::size_t i = 0; i < 6; ++i) {
                                         sum += dvec3(kSkinGaussians.at(i)) * light(i);
                                         const double t = i > 0 ? thickness(i) : 0;
                                         const double passed = i > 0 ? exp(-t * t / kSkinGaussians.at(i).w) : 0;
                                         sum += kSkinTransmission * passed * dvec3(kSkinGaussians.at(i)) * light(i);
                                     }
                                     return sum;
                                 });
    for (std::size_t map = 0; map < 6; ++map) { // each holds the thickness for the next
        const dvec3 l = light(map);
        const double alpha = map < 5 ? thickness(map + 1) / 300 : 0.5;
        made.maps["gIrradiance" + (map == 0 ? std::string() : std::to_string(map + 1)) + "Map"] = oneTexel(l.x, l.y, l.z, alpha);
    }
    made.maps["gTsmMap"] = oneTexel(150, 0.5, 0.5, 1);
    made.settings = {0};
    made.samples = 64;
    made.tolerance = {16, 0, 1e-5, "a sum of eleven lights; alpha keeps 1e-7 of a 300th"};
    return made;
}

void diffused(Cases& cases) {

    cases += mainCase(
        {"diffusedLight", std::string(kStep) + "LitPoint p = (LitPoint)0; p.light = gLightColor; p.albedo = a1; p.cosine = a2; p.shadow "
                                               "= a3; p.lightUv = 0.5; p.depth = 160.0; "
                                               "return float4(diffusedLight(s, p), 0);"},
        {whole(0, 3), linear(0.05, 1, 3), linear(-1, 1), linear(0, 1)}, [](In x) {
            const auto at = static_cast<std::size_t>(round(x[0]));
            const dvec3 unblurred = enteringSkin(x.vec3(1), x[2], x[3]);
            dvec3 here = unblurred * dvec3(kSkinGaussians[0]);
            for (std::size_t i = 1; i < 6; ++i)
                here += dvec3(kSkinGaussians[i]) * (isValid(kMaps[i][at]) ? dvec3(kMaps[i][at]) : unblurred);

            // The light entered at u = 1/8, where all maps are valid; each one's thickness is in the map before it.
            const double apart = 200 * abs((static_cast<double>(at) + 0.5) / 4 - 0.125);
            dvec3 there(0);
            for (std::size_t i = 3; i < 6; ++i) {
                const dvec4& before = kMaps[i - 1][at];
                if (!isValid(before)) continue; // opaque
                there += dvec3(kSkinGaussians[i]) * dvec3(kMaps[i][0]) * passedBy(thicknessOf(before.w), kSkinGaussians[i].w, apart);
            }
            return here + kSkinTransmission * there;
        });
    addMaps(cases.back());
    cases.back().maps["gTsmMap"] = oneTexel(150, 0.125, 0.5, 1);
    cases.back().perQuad = true;
    cases.back().tolerance.absolute = 2e-5; // a step of 0.001 of the map is known to 6e-8
    cases += printedTransmission();
}

const std::vector<dvec4> kColours = {{0.8, 0.6, 0.5, 1}, {0.3, 0.7, 0.2, 0.6}, {0.1, 0.9, 0.4, 0}, {1, 0.5, 0.25, 1}};

constexpr const char* kSurface = "SurfaceVarying s = (SurfaceVarying)0; s.uv = float2((a0 + 0.5) / 4.0, 0.5); s.normal = a1; s.world = a2; "
                                 "s.tangent = float4(1, 0, 0, 1); s.lightClip = float4(0, 0, 0.5, 1); ";

Arguments surfaceArguments() {
    return {whole(0, 3), unit(), linear(-40, 40, 3)};
}

/// Of a surface that nothing else hides from the light: it is lit from N.L of .05 on.
struct Lit {
    dvec3 albedo, normal, toEye, entering;
    double scatters, shadow, cosine;

    explicit Lit(In x) : normal(normalize(x.vec3(1))) {
        const dvec4 colour = kColours[static_cast<std::size_t>(round(x[0]))];
        albedo = colour;
        scatters = colour.w;
        cosine = normal.z;
        shadow = saturate(cosine / 0.05);
        toEye = normalize(kSkinCamera - x.vec3(2));
        entering = enteringSkin(albedo, cosine, shadow);
    }
    [[nodiscard]] dvec3 plain() const { return albedo * kSkinLight * saturate(cosine) * shadow; }
    [[nodiscard]] dvec3 shine() const {
        const double roughness = mix(kPlainRoughness, kSkinRoughness, scatters);
        const double intensity = mix(kPlainIntensity, kSkinIntensity, scatters);
        return kSkinLight * shadow * mirrored(normal, {0, 0, 1}, toEye, roughness, intensity);
    }
    [[nodiscard]] dvec4 shown(const dvec3& diffused) const {
        const dvec3 skin = diffused * skinColour(albedo, 1 - kSkinMix) * kSkinLeft;
        return {mix(plain(), skin, scatters) + shine(), 1};
    }
};

bool isNormal(In x) {
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

void pictures(Cases& cases) {
    cases += mainCase({"LambertPS", std::string(kSurface) + "return LambertPS(s);"}, surfaceArguments(), [](In x) {
        const Lit lit(x);
        return lit.shown(lit.entering);
    });
    addSurface(cases.back());
    cases += mainCase({"FinalPS", std::string(kSurface) + "return FinalPS(s);"}, surfaceArguments(), [](In x) {
        const Lit lit(x);
        const auto at = static_cast<std::size_t>(round(x[0]));
        dvec3 light = lit.entering * dvec3(kSkinGaussians[0]);
        for (std::size_t i = 1; i < 6; ++i)
            light += dvec3(kSkinGaussians[i]) * (isValid(kMaps[i][at]) ? dvec3(kMaps[i][at]) : lit.entering);
        return lit.shown(light);
    });
    addSurface(cases.back());
    addMaps(cases.back());
    cases += mainCase({"GosselinIrradiancePS", std::string(kSurface) + "return GosselinIrradiancePS(s);"}, surfaceArguments(), [](In x) {
        const Lit lit(x);
        const double kernel = kColours[static_cast<std::size_t>(round(x[0]))].x;
        const double arriving = saturate(lit.cosine) * lit.shadow;
        return dvec4(kSkinLight * arriving, min(kernel, 0.99));
    });
    addSurface(cases.back());
    cases.back().maps["gKernelSizeMap"] = rowOfTexels(kColours);
    cases += mainCase(
        {"diffuseHere", "LitPoint p = (LitPoint)0; p.light = gLightColor; p.cosine = a0; p.shadow = a1; return float4(diffuseHere(p), 0);"},
        {linear(-1, 1), linear(0, 1)}, [](In x) { return kSkinLight * saturate(x[0]) * x[1]; });
    cases += mainCase({"surfacePoint", std::string(kSurface) + "LitPoint p = surfacePoint(s, a1); return float4(p.albedo, p.cosine);"},
                      surfaceArguments(), [](In x) { return values(1, 1, 1, x.vec3(1).z); });
    for (const char* effect : {"Main.fx", "Pyramid.fx"}) { // a flat texel of a normal map has lost nothing
        const bool skin = effect[0] == 'M';
        cases += skinCase(
            effect,
            {skin ? "surfacePoint" : "entryPoint",
             skin ? std::string(kSurface) + "return float4(surfacePoint(s, a1).meanNormal, surfacePoint(s, a1).shine, 0);"
                  : "LitPoint p = entryPoint(float2((a0 + 0.5) / 4.0, 0.5), 1.0, a2, a1); return float4(p.meanNormal, p.shine, 0);"},
            surfaceArguments(), kProducts, [](In x) {
                const dvec4 shine = kColours[static_cast<std::size_t>(round(x[0]))];
                return values(1, shine.x * 255 / 128, shine.y * 255 / 128);
            });
        cases.back().defines = {{"TEGUMENT_LOBES", "1"}};
        cases.back().maps["gShineMap"] = rowOfTexels(kColours);
    }
}

Cases shares() {
    Cases cases;
    const Defines alone = {{"TEGUMENT_LAMPS", "3"}};
    cases += mainCase("ownShare(float4(0, 0, 0, a0), a1)", {linear(0.9, 1), linear(0, 1, 4)},
                      [](In x) { return x[0] < 0.995 ? dvec3(0) : x.vec3(1); });
    cases.back().domain = [](In x) { return abs(x[0] - 0.995) > 1e-5; };
    const auto skin = [](In x) { // what no map holds of the light that enters at the point
        const Lit lit(x);
        const auto at = static_cast<std::size_t>(round(x[0]));
        dvec3 own(kSkinGaussians[0]);
        for (std::size_t i = 1; i < 6; ++i)
            own += isValid(kMaps[i][at]) ? dvec3(0) : dvec3(kSkinGaussians[i]);
        return own * lit.albedo * lit.scatters * kSkinLeft;
    };
    cases += mainCase({"SkinShare", std::string(kSurface) + "return float4(SkinShare(s).skin, 0);"}, surfaceArguments(), skin);
    cases += mainCase({"skinShare", std::string(kSurface) + "return float4(SkinShare(s).plain, 0);"}, surfaceArguments(), [](In x) {
        const Lit lit(x);
        return lit.albedo * (1 - lit.scatters);
    });
    cases += mainCase({"skinShare", std::string(kSurface) + "return float4(LambertShare(s).skin, 0);"}, surfaceArguments(), [](In x) {
        const Lit lit(x);
        return lit.albedo * lit.scatters * kSkinLeft;
    });
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

Cases skinPassCases() {
    return together(fetches(), diffused, pictures, shares());
}

} // namespace tegument::test
