// Passes that fill or spare maps (effects/passes/convolution.fxh, poisson.fxh, cull.fxh) and those seen from the light (shadow_map.fxh,
// planar_shadow.fxh).

#include "tests/hlsl/skin_scene.h"

namespace tegument::test {

namespace {

const Tolerance kPlaces = {16, 4, 2e-5, "sums of up to 500 that may cancel, over 64"};

FunctionCase mapCase(const char* effect, Call call, Arguments arguments, Reference expected) {
    return skinCase(effect, std::move(call), std::move(arguments), kPlaces, std::move(expected));
}

dvec3 inWorld(const dvec3& p) {
    return kSkinScale * p + kSkinOrigin;
}

/// By the light's matrix, of parallel light: w is 1 everywhere.
dvec4 inLight(const dvec3& world) {
    return {world.x / kSkinLightHalf + kSkinLightShift.x, world.y / kSkinLightHalf + kSkinLightShift.y, (kSkinLightAt - world.z) / 600, 1};
}

dvec4 inView(const dvec3& w) {
    return {1.5 * w.x + 0.25 * w.z + 3, 0.1 * w.x + 2 * w.y - 5, 0.3 * w.y + 0.5 * w.z + 7, 0.2 * w.x - 0.01 * w.z + 40};
}

constexpr const char* kVertex =
    "TgVertexInput v = (TgVertexInput)0; v.position = a0; v.normal = float3(0, 0, 1); v.tangent = float4(1, 0, 0, 1); ";

void fromTheLight(Cases& cases) {
    cases += mapCase("Main.fx", {"ShadowMapVS", std::string(kVertex) + "return ShadowMapVS(v).lightClip;"}, {linear(-50, 50, 3)},
                     [](In x) { return inLight(inWorld(x.vec3(0))); });
    cases += mapCase("Main.fx", {"TsmVS", std::string(kVertex) + "return TsmVS(v).position;"}, {linear(-50, 50, 3)},
                     [](In x) { return inLight(inWorld(x.vec3(0))); });
    cases += mapCase("Pyramid.fx", {"PlanarShadowVS", std::string(kVertex) + "return PlanarShadowVS(v).position;"}, {linear(-50, 50, 3)},
                     [](In x) { return inLight(inWorld(x.vec3(0))); });
    cases += mapCase("Pyramid.fx", {"PlanarShadowVS", std::string(kVertex) + "return float4(PlanarShadowVS(v).depth, 0, 0, 0);"},
                     {linear(-50, 50, 3)}, [](In x) { return kSkinUnit * (kSkinLightAt - inWorld(x.vec3(0)).z); });
    // Where the surface is steeper than it is followed, the look-up moves up its slope by `texels`, all of it from N.L of 0.075 down.
    cases += mapCase("Pyramid.fx",
                     {"planarPlace",
                      "LitPoint p = (LitPoint)0; p.meshNormal = float3(sqrt(1.0 - a0 * a0), 0, a0); p.toLight = float3(0, 0, 1); "
                      "p.lightUv = a1; p.depth = a2; PlanarPlace at = planarPlace(p, a3, 0.7); return float4(at.uv, at.depth, 0);"},
                     {linear(0.02, 0.3), linear(0, 1, 2), linear(100, 200), linear(-2, 2, 2)}, [](In x) {
                         const dvec2 slope = x.vec2(3);
                         const dvec2 aside = 0.7 * saturate((0.15 - x[0]) / 0.075) * normalize(slope);
                         const dvec2 uv = x.vec2(1) + aside / double{kTestMapSize};
                         const double facets = 0.25 * (abs(slope.x) + abs(slope.y));
                         return values(uv.x, uv.y, x[2] + dot(slope, aside) - kSkinTolerance - facets);
                     });
    cases.back().domain = [](In x) { return length(x.vec2(3)) > 1e-3; };
}

/// Mostly black; here and there a colour.
TestMap blackMap() {
    return mapOf(kTestMapSize, kTestMapSize,
                 [](int x, int y) { return texelOf((x * 7 + y * 13) % 23 == 0 ? 0.2 : 0, (x * 5 + y * 3) % 29 == 0 ? 0.1 : 0, 0, 1); });
}

void culling(Cases& cases) {
    cases +=
        mapCase("Main.fx",
                {"cullVarying", "TgMeshInput m = (TgMeshInput)0; m.position = a0; m.normal = float3(0, 1, 0); return cullVarying(m).clip;"},
                {linear(-50, 50, 3)}, [](In x) { return inView(inWorld(x.vec3(0))); });
    cases.back().tolerance.absolute = 1e-4;
    cases += mapCase("Main.fx", "blackAround((float2(a0, a1) + 0.5) / 256.0) ? 1.0 : 0.0", {whole(0, 255), whole(0, 255)}, [](In x) {
        static const TestMap kMap = blackMap();
        bool black = true; // the texel, and those two texels away
        for (int j = -2; j <= 2; j += 2)
            for (int i = -2; i <= 2; i += 2) {
                const dvec4 t = kMap.texel(static_cast<int>(x[0]) + i, static_cast<int>(x[1]) + j);
                black = black && t.x == 0 && t.y == 0;
            }
        return black ? 1 : 0;
    });
    cases.back().maps["gSkinMap"] = blackMap();
    // Fragments are culled by corrected, whole vertices as printed: by depth 1, or 0 where they may show.
    cases += mapCase("Main.fx", {"PrePass2VS", std::string(kVertex) + "return float4(PrePass2VS(v).position.z, 0, 0, 0);"},
                     {linear(-50, 50, 3)}, [](In x) {
                         const dvec4 clip = inView(inWorld(x.vec3(0)));
                         const bool outside = clip.x / clip.w > 1 || clip.y / clip.w > 1;
                         const bool away = kSkinCamera.z < inWorld(x.vec3(0)).z;
                         return x.corrected() || outside || away ? 1 : 0;
                     });
    cases.back().settings = {0, 2};
    cases += mapCase("Main.fx", {"IrradianceVS", "TgVertexInput v = (TgVertexInput)0; v.uv = a0; return IrradianceVS(v).position;"},
                     {linear(0, 1, 2)}, [](In x) { return values(2 * x[0] - 1, 1 - 2 * x.scalar(0, 1), 0, 1); }); // where the map has it
    cases +=
        mapCase("Main.fx", {"PrePass1VS", "TgQuadInput v = (TgQuadInput)0; v.position = float3(a0, 0.5); return PrePass1VS(v).position;"},
                {linear(-1, 1, 2)}, [](In x) { return values(x[0], x.scalar(0, 1), 1, 1); });
}

/// Of light, another one for each map: what reads the wrong one is seen.
TestMap lightOfMap(int number) {
    TestMap map = irradianceMap();
    for (auto& texel : map.texels)
        for (std::size_t c = 0; c < 3; ++c)
            texel[c] *= 1 + 0.3F * static_cast<float>(number);
    return map;
}

/// Regression checks: an entry point less the call of hlsl/ that it stands for, with numbers written out; what is called has cases of its
/// own.
Cases entryPoints() {
    Cases cases;
    const Arguments places = {whole(0, 255), whole(0, 255)};
    const auto add = [&](const char* function, const std::string& entry, const std::string& call, const TestMap& map) {
        cases += mapCase("Main.fx",
                         {function, "TgQuadVarying q = (TgQuadVarying)0; q.uv = (float2(a0, a1) + 0.5) / 256.0; return " + entry +
                                        "(q) - " + call + ";"},
                         places, [](In) { return 0; });
        cases.back().map = &map;
        cases.back().globals["gBlurSize"] = {1.7};
        cases.back().globals["gBlurTurn"] = {0.9};
        cases.back().maps["gStretchMap"] = oneTexel(1.1, 1.6, 0, 0); // 2.75 and 4 texels for each mm
        cases.back().tolerance = {0, 0, 1e-5, "the same calls; numbers rounded once more"};
    };
    const std::vector<std::string> sigma = {"0.0", "0.22", "0.432", "0.753", "1.411", "2.722"};
    for (int step = 1; step <= 5; ++step) {
        const std::string n = std::to_string(step);
        const std::string map = step == 1 ? "gIrradiance" : "gIrradiance" + n;
        const auto call = [&](const std::string& of, const std::string& density, const std::string& axis) {
            const auto at = static_cast<std::size_t>(step);
            return "tgGaussianConvolve(" + of + "Map, " + of + ", q.uv, " + axis +
                   ", tgGaussianReach(tgGaussianSpacing(tgGaussianIncrement(" + sigma[at - 1] + ", " + sigma[at] + ", " + density +
                   ", tgGaussianPresent(0.25, " + density + "))), float4(1.1, 1.6, 0, 0)))";
        };
        add(step == 2 ? "convolveU" : "CASCADE_STEP", "ConvolutionU" + n + "PS", call(map, "2.75", "float2(1.0 / 256.0, 0.0)"),
            irradianceMap());
        add(step == 4 ? "convolveV" : "CASCADE_STEP", "ConvolutionUV" + n + "PS", call("gIrradianceU", "4.0", "float2(0.0, 1.0 / 256.0)"),
            irradianceMap());
        cases[cases.size() - 2].maps[map + "Map"] = lightOfMap(step);
    }
    for (int blur = 1; blur <= 6; ++blur) {
        const std::string map = blur == 1 ? "gIrradiance" : blur % 2 == 0 ? "gBlurOdd" : "gBlurEven";
        const std::string turn = std::to_string(0.9 * (blur - 1));
        add("BLUR_STEP", "Blur" + std::to_string(blur) + "PS",
            "tgPoissonBlur(" + map + "Map, " + map + ", q.uv, " + map + "Map.SampleLevel(" + map + ", q.uv, 0), tgPoissonRadius(1.7, " +
                map + "Map.SampleLevel(" + map + ", q.uv, 0), float2(2.75, 4.0)), float2(cos(" + turn + "), sin(" + turn + ")))",
            irradianceMap());
        cases.back().tolerance.absolute = 0.05;
        cases.back().tolerance.why = "a tap of thirteen on the border of a texel may see either";
        cases.back().maps[map + "Map"] = lightOfMap(blur);
    }
    return cases;
}

} // namespace

Cases skinMapCases() {
    return together(fromTheLight, culling, entryPoints());
}

} // namespace tegument::test
