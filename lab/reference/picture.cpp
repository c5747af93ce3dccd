#include "lab/reference/picture.h"

#include "generated/setting_names.h"
#include <algorithm>
#include <cmath>

namespace tegument::reference {

namespace {

constexpr double kLargestAlpha = 0.99;
constexpr double kOpaque = 5000;   // mm
constexpr double kDecay = 0.2;     // of the stored exp(-k t), per mm
constexpr double kThinnest = 1e-6; // alpha below which nothing passes: 69 mm

} // namespace

double SkinPicture::encode(const SurfacePoint& point) const {
    const double t = light_.thickness(point).value_or(kOpaque);
    return std::min(light_.settings().thicknessAsDepth ? t / range_ : std::exp(-kDecay * t), kLargestAlpha);
}

double SkinPicture::decode(double alpha) const {
    return light_.settings().thicknessAsDepth ? alpha * range_ : -std::log(std::max(alpha, kThinnest)) / kDecay;
}

SkinPicture::SkinPicture(const SkinScene& light, int mapSize, double range) : light_(light), range_(range) {
    const ChartMap first = chartMap(light.mesh(), mapSize, [&](const SurfacePoint& point) {
        return glm::dvec4(light.entering(point, light.lit(point)), encode(point));
    });
    maps_[0] = first.map;
    for (std::size_t i = 1; i < maps_.size(); ++i)
        maps_[i] = spread(first, skinProfile()[i].variance);
}

glm::dvec3 SkinPicture::through(const SurfacePoint& point, const std::array<glm::dvec4, 6>& here) const {
    const SkinSettings& settings = light_.settings();
    const auto entry = light_.entry(point);
    const auto j = jacobian(light_.mesh(), point.place.triangle);
    if (!entry || !j) return glm::dvec3(0);
    const double mmPerUv = std::sqrt(glm::length(glm::cross(j->alongU, j->alongV)));
    const double apart = mmPerUv * glm::length(point.uv - entry->point.uv);
    glm::dvec3 sum(0);
    for (auto i = static_cast<std::size_t>(settings.firstTransmitted - 1); i < maps_.size(); ++i) {
        const Gaussian& gaussian = skinProfile()[i];
        const double t = decode(here[i - 1].w);
        const double near = settings.fadeNearLitSide ? std::min(1.0, apart / (6 * std::sqrt(gaussian.variance))) : 1;
        glm::dvec4 there;
        if (!maps_[i].lookUp(entry->point.uv, there)) continue;
        sum += gaussian.weight * std::exp(-settings.exponent * t * t / gaussian.variance) * near * glm::dvec3(there);
    }
    return sum;
}

glm::dvec3 SkinPicture::diffused(const SurfacePoint& point) const {
    std::array<glm::dvec4, 6> here{};
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < maps_.size(); ++i) {
        if (!maps_[i].lookUp(point.uv, here[i])) return light_.entering(point, light_.lit(point));
        sum += skinProfile()[i].weight * glm::dvec3(here[i]);
    }
    return sum + through(point, here);
}

glm::dvec3 SkinPicture::radiance(const SurfacePoint& point, const glm::dvec3& eye) const {
    const glm::dvec3 reflected = light_.reflected(point, light_.mappedNormal(point), eye, light_.lit(point));
    return diffused(point) * light_.leaving(point, eye) + reflected;
}

glm::dvec3 lambert(const SkinScene& light, const SurfacePoint& point, const glm::dvec3& eye) {
    const bool lit = light.lit(point);
    return light.entering(point, lit) * light.leaving(point, eye) + light.reflected(point, light.mappedNormal(point), eye, lit);
}

GosselinSettings gosselinSettings(const std::string& name) {
    if (name == kSettingCorrected) return {};
    return {.discs = {.size = 1.5, .turn = 0, .asPrinted = true}, .shadowedReflection = false};
}

GosselinPicture::GosselinPicture(const SkinScene& light, int mapSize, const GosselinSettings& settings)
    : light_(light), settings_(settings) {
    const ChartMap first = chartMap(light.mesh(), mapSize, [&](const SurfacePoint& point) {
        return glm::dvec4(arriving(point), std::min(light.kernelSize(point), kLargestAlpha));
    });
    map_ = spread(first, settings.discs);
}

glm::dvec3 GosselinPicture::arriving(const SurfacePoint& point) const {
    const double cosine = glm::dot(light_.mappedNormal(point), light_.toLight(point));
    return light_.lit(point) ? light_.lightColour() * std::max(cosine, 0.0) : glm::dvec3(0);
}

glm::dvec3 GosselinPicture::diffused(const SurfacePoint& point) const {
    glm::dvec4 blurred;
    return map_.lookUp(point.uv, blurred) ? glm::dvec3(blurred) : arriving(point);
}

glm::dvec3 GosselinPicture::radiance(const SurfacePoint& point, const glm::dvec3& eye) const {
    const glm::dvec4 colour = light_.colour(point);
    // As printed, material that does not scatter has the kernel size 0 and takes its light from the map too (docs/design/modules/Main.md).
    const double scatters = settings_.shadowedReflection ? colour.w : 1;
    const glm::dvec3 diffuse = glm::mix(arriving(point), diffused(point), scatters);
    const bool lit = !settings_.shadowedReflection || light_.lit(point);
    return glm::dvec3(colour) * diffuse + light_.reflected(point, light_.mappedNormal(point), eye, lit);
}

} // namespace tegument::reference
