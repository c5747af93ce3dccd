#include "tests/hlsl/skin_scene.h"

#include "lab/reference/specular.h"

#include <algorithm>
#include <cmath>

namespace tegument::test {

namespace {

std::vector<double> rowsOf(const std::vector<glm::dvec4>& vectors) {
    std::vector<double> numbers;
    for (const glm::dvec4& v : vectors)
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

TestMap rowOfTexels(const std::vector<glm::dvec4>& texels) {
    TestMap row{.size = static_cast<int>(texels.size()), .height = 1};
    for (const glm::dvec4& t : texels)
        row.texels.push_back(texelOf(t));
    return row;
}

glm::dvec4 texelOfRow(const TestMap& row, double place) {
    return row.texel(static_cast<int>(std::round(place)), 0);
}

FunctionCase skinCase(const char* effect, const char* function, std::string body, std::vector<Argument> arguments,
                      std::function<Values(const Inputs&)> expected, Tolerance tolerance) {
    FunctionCase made =
        passCase(effect, scene(), function, std::move(body), std::move(arguments), std::move(expected), std::move(tolerance));
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

glm::dvec3 skinColour(const glm::dvec3& albedo, double exponent) {
    return glm::pow(glm::max(albedo, 1e-5), glm::dvec3(exponent));
}

glm::dvec3 enteringSkin(const glm::dvec3& albedo, double cosine, double shadow) {
    return skinColour(albedo, kSkinMix) * kSkinLight * (std::clamp(cosine, 0.0, 1.0) * shadow * kSkinLeft);
}

double mirrored(const glm::dvec3& normal, const glm::dvec3& toLight, const glm::dvec3& toEye, double roughness, double intensity) {
    const glm::dvec3 h = toLight + toEye;
    const glm::dvec3 halfway = h / std::max(glm::length(h), 1e-10);
    const double ph = reference::beckmannPH(std::max(glm::dot(normal, halfway), 1e-3), roughness);
    return std::clamp(glm::dot(normal, toLight), 0.0, 1.0) * intensity * ph *
           reference::fresnelSchlick(glm::dot(toEye, halfway), kSkinFresnel0) / std::max(glm::dot(h, h), 1e-4);
}

} // namespace tegument::test
