// Surroundings that need no file.

#include "meshprep/light/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument {

namespace {

constexpr int kPanoramaHeight = 512;
constexpr double kDegree = std::numbers::pi / 180;

/// Around the head, 0 in front (+z), 90 at its left (+x); up from the horizon.
glm::dvec3 towards(double aroundDegrees, double upDegrees) {
    const double around = aroundDegrees * kDegree;
    const double up = upDegrees * kDegree;
    return {std::sin(around) * std::cos(up), std::sin(up), std::cos(around) * std::cos(up)};
}

/// A rectangular lamp seen from the middle of the studio: angles across and up in degrees, edges that fade over a tenth.
struct SoftBox {
    glm::dvec3 middle;
    double across;
    double up;
    glm::dvec3 radiance;
};

double within(double at, double half) {
    return std::clamp((half - std::abs(at)) / (0.1 * half) + 1, 0.0, 1.0);
}

glm::dvec3 lampLight(const SoftBox& lamp, const glm::dvec3& d) {
    const double along = glm::dot(d, lamp.middle);
    if (along <= 0) return glm::dvec3(0);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), lamp.middle));
    const glm::dvec3 up = glm::cross(lamp.middle, right);
    const double share = within(glm::dot(d, right) / along, std::tan(0.5 * lamp.across * kDegree)) *
                         within(glm::dot(d, up) / along, std::tan(0.5 * lamp.up * kDegree));
    return share * lamp.radiance;
}

glm::dvec3 studio(const glm::dvec3& d) {
    static const std::array<SoftBox, 4> kLamps = {
        SoftBox{towards(-40, 35), 48, 60, {6.0, 5.8, 5.5}}, SoftBox{towards(55, 10), 60, 70, {0.9, 0.95, 1.0}},
        SoftBox{towards(150, 20), 18, 70, {5.0, 5.2, 5.6}}, SoftBox{towards(-150, 20), 18, 70, {3.0, 3.0, 3.0}}};
    glm::dvec3 light = glm::dvec3(0.05) + glm::dvec3(0.06) * (0.5 + 0.5 * d.y); // walls, floor and ceiling
    for (const SoftBox& lamp : kLamps)
        light += lampLight(lamp, d);
    return light;
}

/// CIE S 011 / ISO 15469 (2003), standard sky type 12: gradation a, b and indicatrix c, d, e, relative to the zenith.
glm::dvec3 sky(const glm::dvec3& d) {
    static const glm::dvec3 kSun = towards(-40, 40);
    constexpr double kSunRadius = 2.0; // degrees: the true 0.27 would fall between the pixels; its light is spread over this disc
    const auto gradation = [](double zenith) { return 1 - std::exp(-0.32 / std::max(std::cos(zenith), 0.02)); };
    const auto indicatrix = [](double apart) {
        return 1 + 10 * (std::exp(-3 * apart) - std::exp(-1.5 * std::numbers::pi)) + 0.45 * std::cos(apart) * std::cos(apart);
    };
    if (d.y < 0) return glm::dvec3(0.20, 0.19, 0.17) * 1.4; // ground under such a sky
    const double apart = std::acos(std::clamp(glm::dot(d, kSun), -1.0, 1.0));
    const double zenith = std::acos(std::clamp(d.y, 0.0, 1.0));
    const double relative = gradation(zenith) * indicatrix(apart) / (gradation(0) * indicatrix(std::acos(kSun.y)));
    const double white = std::exp(-4 * apart) + 0.5 * std::exp(-6 * d.y); // near the sun and the horizon the blue pales
    const glm::dvec3 colour = glm::mix(glm::dvec3(0.45, 0.72, 1.25), glm::dvec3(1.05, 1.0, 0.92), std::min(white, 1.0));
    const glm::dvec3 sun = apart < kSunRadius * kDegree ? glm::dvec3(500, 460, 390) : glm::dvec3(0);
    return 0.35 * relative * colour + sun;
}

} // namespace

Image defaultEnvironment(DefaultEnvironment which) {
    Image image = plainImage(2 * kPanoramaHeight, kPanoramaHeight, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec3 d = panoramaDirection((x + 0.5) / image.width, (y + 0.5) / image.height);
            const glm::dvec3 light = which == DefaultEnvironment::Studio ? studio(d) : sky(d);
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = static_cast<float>(light[c]);
        }
    const glm::dvec3 front = EnvironmentLight(image).irradiance(glm::dvec3(0, 0, 1));
    const double mean = (front.x + front.y + front.z) / 3;
    for (float& value : image.pixels)
        value = static_cast<float>(static_cast<double>(value) / mean);
    return image;
}

} // namespace tegument
