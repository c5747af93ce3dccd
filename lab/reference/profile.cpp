#include "lab/reference/profile.h"

#include <algorithm>
#include <cmath>

namespace tegument::reference {

const Profile& skinProfile() {
    static const Profile kProfile = {{0.0064, {.233, .455, .649}}, {0.0484, {.100, .336, .344}}, {0.187, {.118, .198, 0}},
                                     {0.567, {.113, .007, .007}},  {1.99, {.358, .004, 0}},      {7.41, {.078, 0, 0}}};
    return kProfile;
}

namespace {

template <class Response>
glm::dvec3 sumOver(const Profile& profile, Response response) {
    glm::dvec3 sum(0);
    for (const Gaussian& gaussian : profile)
        sum += gaussian.weight * response(gaussian.variance);
    return sum;
}

/// E_l = (2 l + 1) / 2 * integral of x P_l(x) over [0, 1]: 1/4, 1/2, then every other one. From
///   integral of x P_l = (l + 1) / (2 l + 1) a_{l+1} + l / (2 l + 1) a_{l-1},  a_n = integral of P_n over [0, 1] = (P_{n-1}(0) -
///   P_{n+1}(0)) / (2 n + 1).
std::vector<double> clampedCosine(std::size_t count) {
    std::vector<double> atZero(count + 3, 0.0); // P_n(0)
    atZero[0] = 1;
    for (std::size_t n = 2; n < atZero.size(); n += 2)
        atZero[n] = -atZero[n - 2] * (static_cast<double>(n) - 1) / static_cast<double>(n);
    const auto area = [&](std::size_t n) { return n == 0 ? 1.0 : (atZero[n - 1] - atZero[n + 1]) / (2 * static_cast<double>(n) + 1); };
    std::vector<double> coefficients(count);
    for (std::size_t l = 0; l < count; ++l) {
        const auto n = static_cast<double>(l);
        coefficients[l] = 0.5 * ((n + 1) * area(l + 1) + (l == 0 ? 0 : n * area(l - 1)));
    }
    return coefficients;
}

} // namespace

glm::dvec3 halfPlane(const Profile& profile, double x) {
    return sumOver(profile, [&](double v) { return 0.5 * (1 + std::erf(x / std::sqrt(2 * v))); });
}

glm::dvec3 discCentre(const Profile& profile, double radius) {
    return sumOver(profile, [&](double v) { return 1 - std::exp(-radius * radius / (2 * v)); });
}

glm::dvec3 sinusoid(const Profile& profile, double wavenumber) {
    return sumOver(profile, [&](double v) { return std::exp(-v * wavenumber * wavenumber / 2); });
}

glm::dvec3 slab(const Profile& profile, double thickness) {
    return sumOver(profile, [&](double v) { return std::exp(-thickness * thickness / (2 * v)); });
}

std::vector<double> besselRatios(double x, std::size_t count) {
    // r_l = I_{l+1/2} / I_{l-1/2} = 1 / ((2 l + 1) / x + r_{l+1}), exact in the limit of a far start.
    const std::size_t start = count + 64 + static_cast<std::size_t>(std::sqrt(40 * x));
    std::vector<double> ratio(start + 2, 0.0);
    for (std::size_t l = start; l >= 1; --l)
        ratio[l] = 1 / ((2 * static_cast<double>(l) + 1) / x + ratio[l + 1]);
    // I_{1/2} is the base: A_0 = 1, and I_{1/2+1} / I_{1/2} = r_1 with the order l - 1/2 = 1/2.
    std::vector<double> product(count, 1.0);
    for (std::size_t l = 1; l < count; ++l)
        product[l] = product[l - 1] * ratio[l];
    return product;
}

glm::dvec3 sphere(const Profile& profile, double radius, double cosine, const glm::dvec3& flesh) {
    double narrowest = profile.front().variance;
    for (const Gaussian& gaussian : profile)
        narrowest = std::min(narrowest, gaussian.variance);
    const auto count = static_cast<std::size_t>(8 * radius / std::sqrt(narrowest)) + 50;
    const std::vector<double> light = clampedCosine(count);
    std::vector<double> legendre(count, 1.0);
    if (count > 1) legendre[1] = cosine;
    for (std::size_t l = 2; l < count; ++l) {
        const auto n = static_cast<double>(l);
        legendre[l] = ((2 * n - 1) * cosine * legendre[l - 1] - (n - 1) * legendre[l - 2]) / n;
    }
    const auto scattered = [&](double v) {
        const double concentration = radius * radius / v;
        const std::vector<double> kernel = besselRatios(concentration, count);
        double sum = 0;
        for (std::size_t l = 0; l < count; ++l)
            sum += light[l] * kernel[l] * legendre[l];
        return (1 - std::exp(-2 * concentration)) * sum;
    };
    const glm::dvec3 alone = sumOver(profile, scattered);
    if (flesh == glm::dvec3(0)) return alone;
    return alone + flesh * sumOver(profile, [&](double v) {
                       constexpr double kStep = 1e-4; // of v: the difference is exact to its square
                       const double slope = (scattered(v * (1 + kStep)) - scattered(v * (1 - kStep))) / (2 * kStep);
                       return v / radius * (scattered(v) + slope);
                   });
}

} // namespace tegument::reference
