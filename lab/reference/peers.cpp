#include "lab/reference/peers.h"

#include "lab/reference/radial.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace tegument::reference {

namespace {

constexpr double kPeersPi = std::numbers::pi;

/// Offsets from -reach to reach, equally spaced before squaring.
std::vector<double> squaredOffsets(int samples, double reach) {
    assert(samples > 2 && samples % 2 == 1);
    std::vector<double> offsets;
    for (int i = 0; i < samples; ++i) {
        const double t = 2.0 * i / (samples - 1) - 1;
        offsets.push_back(std::copysign(reach * t * t, t));
    }
    return offsets;
}

/// The authors' profile: the red weights of all Gaussians but the narrowest, normalised as in the plane, with their value of pi.
double printedProfile(double distance, double falloff) {
    const double r = distance / (0.001 + falloff);
    double sum = 0;
    for (std::size_t i = 1; i < skinProfile().size(); ++i) {
        const Gaussian& gaussian = skinProfile()[i];
        sum += gaussian.weight.r * std::exp(-r * r / (2 * gaussian.variance)) / (2 * 3.14 * gaussian.variance);
    }
    return sum;
}

/// Mean of the distances to both neighbours; at the ends half the distance to the one.
double printedArea(const std::vector<double>& offsets, std::size_t i) {
    const double before = i > 0 ? offsets[i] - offsets[i - 1] : 0;
    const double after = i + 1 < offsets.size() ? offsets[i + 1] - offsets[i] : 0;
    return (before + after) / 2;
}

double gaussian(double x, double variance) {
    return std::exp(-x * x / (2 * variance)) / std::sqrt(2 * kPeersPi * variance);
}

glm::dvec3 line(const Profile& profile, double x, double scale) {
    glm::dvec3 sum(0);
    for (const Gaussian& one : profile)
        sum += one.weight * gaussian(x, one.variance * scale);
    return sum;
}

} // namespace

Kernel separableKernel(const Profile& profile, int samples, double reach) {
    const std::vector<double> offsets = squaredOffsets(samples, reach);
    Kernel kernel;
    glm::dvec3 before(0);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const bool last = i + 1 == offsets.size();
        const glm::dvec3 upTo = last ? glm::dvec3(1) : halfPlane(profile, (offsets[i] + offsets[i + 1]) / 2);
        kernel.push_back({.offset = offsets[i], .weight = upTo - before});
        before = upTo;
    }
    return kernel;
}

double separableReach(int samples) {
    switch (samples) {
    case 7: return 2.2;
    case 11: return 2.7;
    case 17: return 3.2;
    default: assert(samples == 25); return 4.2;
    }
}

Kernel separableKernelPrinted(int samples) {
    const glm::dvec3 strength(0.48, 0.41, 0.28);
    const glm::dvec3 falloff(1, 0.37, 0.3);
    const std::vector<double> offsets = squaredOffsets(samples, samples > 20 ? 3 : 2);
    Kernel kernel;
    glm::dvec3 total(0);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        glm::dvec3 weight(0);
        for (int c = 0; c < 3; ++c)
            weight[c] = printedArea(offsets, i) * printedProfile(offsets[i], falloff[c]);
        kernel.push_back({.offset = offsets[i], .weight = weight});
        total += weight;
    }
    for (KernelSample& sample : kernel)
        sample.weight *= strength / total;
    kernel[kernel.size() / 2].weight += 1.0 - strength;
    return kernel;
}

glm::dvec3 kernelEdge(const Kernel& kernel, double unit, double x) {
    glm::dvec3 sum(0);
    for (const KernelSample& sample : kernel)
        if (x + unit * sample.offset > 0) sum += sample.weight;
    return sum;
}

double burleyProfile(double r, double d) {
    return (std::exp(-r / d) + std::exp(-r / (3 * d))) / (8 * kPeersPi * d * r);
}

double burleyShare(double r, double d) {
    return 1 - std::exp(-r / d) / 4 - 3 * std::exp(-r / (3 * d)) / 4;
}

double burleyRadius(double share, double d) {
    assert(share >= 0 && share < 1);
    double low = 0;
    double high = d;
    while (burleyShare(high, d) < share)
        high *= 2;
    for (int i = 0; i < 100; ++i)
        (burleyShare((low + high) / 2, d) < share ? low : high) = (low + high) / 2;
    return (low + high) / 2;
}

double burleyEdge(double x, double d) {
    static const std::vector<Node> kAngles = gaussLegendre(96, 0, kPeersPi / 2);
    double beyond = 0;
    for (const Node& angle : kAngles)
        beyond += angle.weight / kPeersPi * (1 - burleyShare(std::abs(x) / std::cos(angle.x), d));
    return x > 0 ? 1 - beyond : beyond;
}

glm::dvec3 ring(const Profile& profile, double radius, double cosine) {
    const double theta = std::acos(std::clamp(cosine, -1.0, 1.0));
    glm::dvec3 sum(0);
    for (const Gaussian& one : profile) {
        const double reach = 10 * std::sqrt(one.variance);
        // Pieces of a quarter of the width or of the ring, whichever is shorter: the light has an edge in its slope.
        const int pieces = static_cast<int>(std::ceil(2 * reach / std::min(0.25 * std::sqrt(one.variance), 0.25 * radius)));
        static const std::vector<Node> kNodes = gaussLegendre(8);
        for (int i = 0; i < pieces; ++i)
            for (const Node& node : kNodes) {
                const double x = reach * ((2.0 * i + 1 + node.x) / pieces - 1);
                sum +=
                    one.weight * (node.weight * reach / pieces * gaussian(x, one.variance) * std::max(std::cos(theta + x / radius), 0.0));
            }
    }
    return sum;
}

glm::dvec3 ringPrinted(const Profile& profile, double radius, double cosine) {
    const double theta = std::acos(std::clamp(cosine, -1.0, 1.0));
    // Chords above 18 mm hold less than 1e-8 of the widest Gaussian.
    const double reach = std::min(kPeersPi / 2, 2 * std::asin(std::min(1.0, 9 / radius)));
    constexpr int kPieces = 800;
    static const std::vector<Node> kNodes = gaussLegendre(4);
    glm::dvec3 sum(0);
    glm::dvec3 total(0);
    for (int i = 0; i < kPieces; ++i)
        for (const Node& node : kNodes) {
            const double x = reach * ((2.0 * i + 1 + node.x) / kPieces - 1);
            const glm::dvec3 weight = node.weight * line(profile, 2 * radius * std::sin(x / 2), 1.414);
            sum += weight * std::max(std::cos(theta + x), 0.0);
            total += weight;
        }
    return sum / total;
}

} // namespace tegument::reference
