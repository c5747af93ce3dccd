#include "lab/reference/fibre.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::reference {

namespace {

using std::numbers::pi;

/// I0(x) / e^x to 2e-7: M. Abramowitz and I. Stegun, Handbook of Mathematical Functions, 9.8.1 and 9.8.2.
double scaledBessel(double x) {
    constexpr double kSplit = 3.75;
    if (x < kSplit) {
        const double t = x * x / (kSplit * kSplit);
        const double sum = 1 + t * (3.5156229 + t * (3.0899424 + t * (1.2067492 + t * (0.2659732 + t * (0.0360768 + t * 0.0045813)))));
        return sum * std::exp(-x);
    }
    const double t = kSplit / x;
    const double low = 0.39894228 + t * (0.01328592 + t * (0.00225319 + t * (-0.00157565 + t * 0.00916281)));
    const double high = -0.02057706 + t * (0.02635537 + t * (-0.01647633 + t * 0.00392377));
    return (low + std::pow(t, 5) * high) / std::sqrt(x);
}

double longitudinal(double sineLight, double cosineLight, double sineEye, double cosineEye, double v) {
    const double x = cosineLight * cosineEye / v;
    return std::exp((cosineLight * cosineEye - sineLight * sineEye - 1) / v) * scaledBessel(x) / (v * (1 - std::exp(-2 / v)));
}

double fresnel(double cosine, double eta) {
    const double inside = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
    const double s = (cosine - eta * inside) / (cosine + eta * inside);
    const double p = (eta * cosine - inside) / (eta * cosine + inside);
    return (s * s + p * p) / 2;
}

double logisticShare(double x, double scale) {
    return 1 / (1 + std::exp(-x / scale));
}

double fromMinusPi(double angle) {
    return angle - 2 * pi * std::floor(angle / (2 * pi) + 0.5);
}

double powerOf(double x, int exponent) {
    return std::pow(x, exponent);
}

} // namespace

glm::dvec3 fibreAbsorption(const glm::dvec3& colour, double around) {
    const double by = 5.969 - 0.215 * around + 2.532 * powerOf(around, 2) - 10.73 * powerOf(around, 3) + 5.574 * powerOf(around, 4) +
                      0.245 * powerOf(around, 5);
    const glm::dvec3 root = glm::log(glm::clamp(colour, 1e-6, 1 - 1e-12)) / by;
    return root * root;
}

FibreScattering::FibreScattering(const Fibre& fibre, const glm::dvec3& absorption, const glm::dvec3& toEye, double offset)
    : spread_(std::sqrt(pi / 8) * (0.265 * fibre.around + 1.194 * powerOf(fibre.around, 2) + 5.372 * powerOf(fibre.around, 22))),
      eye_(std::atan2(toEye.z, toEye.y)) {
    const double sine = std::clamp(toEye.x, -1.0, 1.0);
    const double cosine = std::max(std::sqrt(1 - sine * sine), 1e-6);
    const double h = std::clamp(offset, -1.0, 1.0);
    const double bent = std::sqrt(fibre.eta * fibre.eta - sine * sine) / cosine;
    const double outside = std::asin(h);
    const double inside = std::asin(h / bent);
    const double path = 2 * std::cos(inside) / std::sqrt(1 - sine * sine / (fibre.eta * fibre.eta));
    const glm::dvec3 left = glm::exp(-absorption * path);
    const double f = fresnel(cosine * std::sqrt(1 - h * h), fibre.eta);

    lobes_[0].share = glm::dvec3(f);
    lobes_[1].share = (1 - f) * (1 - f) * left;
    lobes_[2].share = lobes_[1].share * left * f;
    lobes_[3].share = lobes_[2].share * left * f / glm::max(1.0 - left * f, 1e-12);
    const double v = powerOf(0.726 * fibre.along + 0.812 * powerOf(fibre.along, 2) + 3.7 * powerOf(fibre.along, 20), 2);
    const std::array<double, kLobes> variances = {v, v / 4, 4 * v, 4 * v};
    const std::array<double, kLobes> tilts = {-2, 1, 4, 0};
    double sum = 0;
    for (std::size_t p = 0; p < kLobes; ++p) {
        Lobe& lobe = lobes_[p];
        const double tilt = glm::radians(fibre.tilt) * tilts[p];
        lobe.sine = sine * std::cos(tilt) + cosine * std::sin(tilt);
        lobe.cosine = std::abs(cosine * std::cos(tilt) - sine * std::sin(tilt));
        lobe.variance = variances[p];
        lobe.azimuth = static_cast<double>(p) * (2 * inside + pi) - 2 * outside;
        lobe.chance = (lobe.share.x + lobe.share.y + lobe.share.z) / 3;
        sum += lobe.chance;
    }
    for (Lobe& lobe : lobes_)
        lobe.chance /= sum;
}

double FibreScattering::around(std::size_t lobe, double azimuth) const {
    if (lobe + 1 == kLobes) return 1 / (2 * pi);
    const double x = std::abs(fromMinusPi(azimuth - lobes_[lobe].azimuth));
    const double e = std::exp(-x / spread_);
    const double whole = logisticShare(pi, spread_) - logisticShare(-pi, spread_);
    return e / (spread_ * (1 + e) * (1 + e) * whole);
}

glm::dvec3 FibreScattering::evaluate(const glm::dvec3& toLight) const {
    const double sine = std::clamp(toLight.x, -1.0, 1.0);
    const double cosine = std::sqrt(1 - sine * sine);
    const double azimuth = std::atan2(toLight.z, toLight.y) - eye_;
    glm::dvec3 sum(0);
    for (std::size_t p = 0; p < kLobes; ++p) {
        const Lobe& lobe = lobes_[p];
        sum += lobe.share * (longitudinal(sine, cosine, lobe.sine, lobe.cosine, lobe.variance) * around(p, azimuth));
    }
    return sum;
}

double FibreScattering::density(const glm::dvec3& toLight) const {
    const double sine = std::clamp(toLight.x, -1.0, 1.0);
    const double cosine = std::sqrt(1 - sine * sine);
    const double azimuth = std::atan2(toLight.z, toLight.y) - eye_;
    double sum = 0;
    for (std::size_t p = 0; p < kLobes; ++p) {
        const Lobe& lobe = lobes_[p];
        sum += lobe.chance * longitudinal(sine, cosine, lobe.sine, lobe.cosine, lobe.variance) * around(p, azimuth);
    }
    return sum;
}

FibreScattering::Sampled FibreScattering::sample(const std::array<double, 4>& random) const {
    std::size_t p = 0;
    for (double left = random[0]; p + 1 < kLobes && left >= lobes_[p].chance; ++p)
        left -= lobes_[p].chance;
    const Lobe& lobe = lobes_[p];
    // d'Eon et al. 2013, An Energy-Conserving Hair Reflectance Model, sampling.
    const double up = 1 + lobe.variance * std::log(std::max(random[1], 1e-300) + (1 - random[1]) * std::exp(-2 / lobe.variance));
    const double aside = std::sqrt(std::max(1 - up * up, 0.0));
    const double sine = std::clamp(-up * lobe.sine + aside * std::cos(2 * pi * random[2]) * lobe.cosine, -1.0, 1.0);
    double azimuth = 2 * pi * random[3];
    if (p + 1 < kLobes) {
        const double low = logisticShare(-pi, spread_);
        const double share = std::clamp(low + random[3] * (logisticShare(pi, spread_) - low), 1e-300, 1 - 1e-16);
        azimuth = lobe.azimuth - spread_ * std::log(1 / share - 1);
    }
    const double cosine = std::sqrt(1 - sine * sine);
    Sampled sampled;
    sampled.toLight = {sine, cosine * std::cos(eye_ + azimuth), cosine * std::sin(eye_ + azimuth)};
    sampled.weight = evaluate(sampled.toLight) / std::max(density(sampled.toLight), 1e-300);
    return sampled;
}

} // namespace tegument::reference
