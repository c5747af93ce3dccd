#include "tests/hlsl/skin_scene.h"

#include "lab/reference/specular.h"

namespace tegument::test {

namespace {

std::vector<double> rowsOf(const std::vector<dvec4>& vectors) {
    std::vector<double> numbers;
    for (const dvec4& v : vectors)
        numbers.insert(numbers.end(), {v.x, v.y, v.z, v.w});
    return numbers;
}

Globals scene() {
    const double s = kSkinScale;
    const double w = 1 / kSkinLightHalf;
    return {{"gWorld", {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, kSkinOrigin.x, kSkinOrigin.y, kSkinOrigin.z, 1}},
            {"gWorldInverseTranspose", {1 / s, 0, 0, 0, 0, 1 / s, 0, 0, 0, 0, 1 / s, 0, 0, 0, 0, 1}},
            {"gViewProjection", {1.5, 0.1, 0, 0.2, 0, 2, 0.3, 0, 0.25, 0, 0.5, -0.01, 3, -5, 7, 40}},
            {"gLightViewProjection",
             {w, 0, 0, 0, 0, w, 0, 0, 0, 0, -1.0 / 600, 0, kSkinLightShift.x, kSkinLightShift.y, kSkinLightAt / 600, 1}},
            {"gLightPosition", {0, 0, kSkinLightAt}},
            {"gLightNear", {100}},
            {"gLightFar", {700}},
            {"gLightColor", numbersOf(kSkinLight)},
            {"gCameraPosition", numbersOf(kSkinCamera)},
            {"gUnitMm", {kSkinUnit}},
            {"gViewportSize", {8, 8}},
            {"gMix", {kSkinMix}},
            {"gShadowTolerance", {kSkinTolerance}},
            {"gTransmission", {kSkinTransmission}},
            {"gRoughness", {kSkinRoughness}},
            {"gSpecularIntensity", {kSkinIntensity}},
            {"gPlainRoughness", {kPlainRoughness}},
            {"gPlainIntensity", {kPlainIntensity}},
            {"gGaussianWeight", rowsOf({kSkinGaussians.begin(), kSkinGaussians.end()})}};
}

} // namespace

TestMap rowOfTexels(const std::vector<dvec4>& texels) {
    TestMap row{.size = static_cast<int>(texels.size()), .height = 1};
    for (const dvec4& t : texels)
        row.texels.push_back(texelOf(t));
    return row;
}

dvec4 texelOfRow(const TestMap& row, double place) {
    return row.texel(static_cast<int>(round(place)), 0);
}

FunctionCase skinCase(const char* effect, Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    FunctionCase made = passCase(effect, scene(), std::move(call), std::move(arguments), std::move(tolerance), std::move(expected));
    made.samples = 512;
    made.maps["gEnergyAttenuationMap"] = oneTexel(kTableAlbedo - 0.05, 0.05);
    made.maps["gNormalMap"] = oneTexel(0.5, 0.5, 1, 1);
    return made;
}

void addLightByLight(FunctionCase& made) {
    made.defines.emplace_back("TEGUMENT_LIGHT_BY_LIGHT", "1");
    for (const char* number : {"2", "3", "4", "5", "6"})
        made.defines.emplace_back("gFinal" + std::string(number) + "Map", "gIrradiance" + std::string(number) + "Map");
}

dvec3 skinColour(const dvec3& albedo, double exponent) {
    return pow(max(albedo, 1e-5), dvec3(exponent));
}

dvec3 enteringSkin(const dvec3& albedo, double cosine, double shadow) {
    return skinColour(albedo, kSkinMix) * kSkinLight * (saturate(cosine) * shadow * kSkinLeft);
}

double mirrored(const dvec3& normal, const dvec3& toLight, const dvec3& toEye, double roughness, double intensity) {
    const dvec3 h = toLight + toEye;
    const dvec3 halfway = h / max(length(h), 1e-10);
    const double ph = reference::beckmannPH(max(dot(normal, halfway), 1e-3), roughness);
    return saturate(dot(normal, toLight)) * intensity * ph * reference::fresnelSchlick(dot(toEye, halfway), kSkinFresnel0) /
           max(dot(h, h), 1e-4);
}

} // namespace tegument::test
