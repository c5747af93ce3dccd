#include "lab/reference/skin_profiles.h"

#include "lab/reference/radial.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace tegument::reference {

NamedProfile named(const std::string& name, const std::string& source, const Profile& gaussians) {
    return {name, source, [gaussians](double radius) { return discCentre(gaussians, radius); },
            [gaussians](double x) { return halfPlane(gaussians, x); }};
}

NamedProfile namedBurley(const std::string& name, const std::string& source, const glm::dvec3& d) {
    return {name, source, [d](double radius) { return burleyWithin(d, radius); }, [d](double x) { return burleyHalfPlane(d, x); }};
}

namespace {

/// Each column divided by its sum, which rounding has left a thousandth from 1.
Profile normalised(Profile profile) {
    const glm::dvec3 sum = slab(profile, 0);
    for (Gaussian& gaussian : profile)
        gaussian.weight /= sum;
    return profile;
}

} // namespace

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

namespace {

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
