#include "host/reference/picture.h"

#include <algorithm>
#include <cmath>

namespace tegument::reference {

namespace {

constexpr double kTexelVariance = 1.0 / 12; // a texel is the mean over its square
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
    const Unwrapped places = unwrap(light.mesh(), mapSize);
    Map& first = maps_[0];
    first.size = mapSize;
    std::vector<glm::dvec2> density;
    for (const auto& place : places.texels) {
        const auto point = place ? std::optional(interpolate(light.mesh(), *place)) : std::nullopt;
        first.valid.push_back(point ? 1 : 0);
        first.texels.push_back(point ? glm::dvec4(light.entering(*point, light.lit(*point)), encode(*point)) : glm::dvec4(0));
        const auto j = place ? jacobian(light.mesh(), place->triangle) : std::nullopt;
        density.push_back(j ? glm::dvec2(mapSize / glm::length(j->alongU), mapSize / glm::length(j->alongV)) : glm::dvec2(0));
    }
    for (std::size_t i = 1; i < maps_.size(); ++i) {
        const double variance = skinProfile()[i].variance;
        maps_[i] = gaussian(first, [&](int x, int y) {
            const glm::dvec2 d2 = density[first.index(x, y)] * density[first.index(x, y)];
            return Spread{std::max(variance * d2.x - kTexelVariance, 0.0), std::max(variance * d2.y - kTexelVariance, 0.0)};
        });
    }
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

glm::dvec3 SkinPicture::lambert(const SurfacePoint& point, const glm::dvec3& eye) const {
    const bool lit = light_.lit(point);
    return light_.entering(point, lit) * light_.leaving(point, eye) + light_.reflected(point, light_.mappedNormal(point), eye, lit);
}

} // namespace tegument::reference
