#include "lab/reference/profile.h"

#include "lab/reference/radial.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace tegument::reference {

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

/// Each column divided by its sum, which rounding has left a thousandth from 1.
Profile normalised(Profile profile) {
    const glm::dvec3 sum = slab(profile, 0);
    for (Gaussian& gaussian : profile)
        gaussian.weight /= sum;
    return profile;
}

constexpr double kFirst = 2e-3; // mm: radii and places looked at, to
constexpr double kLast = 100;
constexpr int kPlaces = 240;

double place(int i) {
    return kFirst * std::pow(kLast / kFirst, static_cast<double>(i) / (kPlaces - 1));
}

double burleyError(double d, const RingHistogram& rings) {
    double worst = 0;
    for (int i = 0; i < kPlaces; ++i)
        worst = std::max(worst, std::abs(burleyWithin(glm::dvec3(d), place(i)).x - rings.within(place(i)) / rings.total()));
    return worst;
}

} // namespace

const Profile& skinProfile() {
    static const Profile kProfile = {{0.0064, {.233, .455, .649}}, {0.0484, {.100, .336, .344}}, {0.187, {.118, .198, 0}},
                                     {0.567, {.113, .007, .007}},  {1.99, {.358, .004, 0}},      {7.41, {.078, 0, 0}}};
    return kProfile;
}

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

NamedProfile named(const std::string& name, const std::string& source, const Profile& gaussians) {
    return {name, source, [gaussians](double radius) { return discCentre(gaussians, radius); },
            [gaussians](double x) { return halfPlane(gaussians, x); }};
}

NamedProfile namedBurley(const std::string& name, const std::string& source, const glm::dvec3& d) {
    return {name, source, [d](double radius) { return burleyWithin(d, radius); }, [d](double x) { return burleyHalfPlane(d, x); }};
}

const Profile& refittedProfile(int count) {
    static const std::array<Profile, 4> kRefits = {
        normalised({{0.0178, {.418, .917, .994}}, {1.8439, {.582, .083, .006}}}),
        normalised({{0.0088, {.249, .589, .833}}, {0.1231, {.263, .404, .167}}, {2.3929, {.488, .007, 0}}}),
        normalised({{0.0073, {.251, .496, .743}}, {0.0746, {.142, .449, .257}}, {0.6649, {.296, .054, 0}}, {3.5484, {.310, 0, 0}}}),
        normalised({{0.0064, {.237, .455, .654}},
                    {0.0496, {.091, .353, .338}},
                    {0.2115, {.170, .188, .005}},
                    {1.5963, {.386, .003, .002}},
                    {6.1879, {.116, .001, 0}}})};
    assert(count >= 2 && count <= 5);
    return kRefits.at(static_cast<std::size_t>(count - 2));
}

const Profile& conferenceProfile() {
    const auto square = [](double sigma) { return sigma * sigma; };
    static const Profile kProfile = {{square(.042), {.220, .437, .635}}, {square(.220), {.101, .355, .365}},
                                     {square(.433), {.119, .208, 0}},    {square(.753), {.114, 0, 0}},
                                     {square(1.412), {.364, 0, 0}},      {square(2.722), {.080, 0, 0}}};
    return kProfile;
}

const Profile& physicalProfile() {
    static const Profile kProfile = normalised({{0.0003, {.058, .084, .119}},
                                                {0.0048, {.129, .182, .240}},
                                                {0.0421, {.242, .357, .437}},
                                                {0.2429, {.269, .303, .204}},
                                                {5.0122, {.137, .068, 0}},
                                                {70.33, {.164, .006, 0}}});
    return kProfile;
}

SimulatedSkin simulateSkin(std::size_t photons, std::uint64_t seed) {
    SimulatedSkin skin;
    for (int channel = 0; channel < 3; ++channel)
        skin[static_cast<std::size_t>(channel)] = followPhotons(layeredSkin(channel), {.photons = photons, .seed = seed});
    return skin;
}

double halfPlane(const RingHistogram& rings, double x) {
    constexpr int kParts = 4; // of a ring, across which its energy is spread evenly
    if (x < 0) return 1 - halfPlane(rings, -x);
    double beyond = 0; // the share of each ring on the other side of the edge, x away
    for (std::size_t ring = 0; ring < RingHistogram::kRings; ++ring)
        for (int part = 0; part < kParts; ++part) {
            const double radius = std::lerp(RingHistogram::edge(ring), RingHistogram::edge(ring + 1), (part + 0.5) / kParts);
            if (radius > x) beyond += rings.energy(ring) / kParts * std::acos(x / radius) / std::numbers::pi;
        }
    return 1 - beyond / rings.total();
}

glm::dvec3 fittedBurley(const SimulatedSkin& skin) {
    glm::dvec3 best(0);
    for (int c = 0; c < 3; ++c) {
        const RingHistogram& rings = skin[static_cast<std::size_t>(c)].rings;
        double low = std::log(0.01);
        double high = std::log(10.0);
        for (int i = 0; i < 60; ++i) { // the error has one valley: a third is cut off each time
            const double a = low + (high - low) / 3;
            const double b = high - (high - low) / 3;
            const bool lower = burleyError(std::exp(a), rings) < burleyError(std::exp(b), rings);
            (lower ? high : low) = lower ? b : a;
        }
        best[c] = std::exp(0.5 * (low + high));
    }
    return best;
}

ModelError modelError(const NamedProfile& profile, const SimulatedSkin& skin) {
    ModelError error;
    for (int i = 0; i < kPlaces; ++i) {
        const double r = place(i);
        const glm::dvec3 within = profile.within(r);
        const glm::dvec3 edge = profile.halfPlane(r); // the other side of the edge is its mirror image
        for (int c = 0; c < 3; ++c) {
            const RingHistogram& rings = skin[static_cast<std::size_t>(c)].rings;
            error.within[c] = std::max(error.within[c], std::abs(within[c] - rings.within(r) / rings.total()));
            error.halfPlane[c] = std::max(error.halfPlane[c], std::abs(edge[c] - halfPlane(rings, r)));
        }
    }
    return error;
}

} // namespace tegument::reference
