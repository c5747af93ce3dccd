#include "lab/reference/specular.h"

#include "lab/reference/radial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::reference {

double beckmannPH(double cosine, double m) {
    if (cosine <= 0) return 0;
    const double tangent2 = (1 - cosine) * (1 + cosine) / (cosine * cosine);
    return std::exp(-tangent2 / (m * m)) / (m * m * cosine * cosine * cosine * cosine);
}

double fresnelSchlick(double cosine, double f0) {
    const double c = 1 - std::clamp(cosine, 0.0, 1.0);
    return f0 + (1 - f0) * c * c * c * c * c;
}

double kelemenBrdf(const glm::dvec3& normal, const glm::dvec3& toLight, const glm::dvec3& toEye, const Lobe& lobe) {
    if (glm::dot(normal, toLight) <= 0 || glm::dot(normal, toEye) <= 0) return 0;
    const glm::dvec3 sum = toLight + toEye;
    const glm::dvec3 halfway = glm::normalize(sum);
    return lobe.rhoS * beckmannPH(glm::dot(normal, halfway), lobe.m) * fresnelSchlick(glm::dot(toEye, halfway), lobe.f0) /
           glm::dot(sum, sum);
}

namespace {

/// Half vectors by slope: H = (t cos phi, t sin phi, 1) / sqrt(1 + t^2), V = (sine, 0, cosine).
struct SlopeIntegral {
    double cosine;
    double sine;
    double m;
    double f0;

    /// With dL = 4 (V.H) dH, |L + V| = 2 (V.H) and dH = t dt dphi / (1 + t^2)^1.5 the integrand over t and phi is
    /// exp(-t^2/m^2) / m^2 sqrt(1 + t^2) F(V.H) (N.L) / (V.H) t, where N.L = 2 (V.H)(N.H) - N.V.
    [[nodiscard]] double integrand(double t, double cosinePhi) const {
        const double length = std::sqrt(1 + t * t);
        const double vh = (sine * t * cosinePhi + cosine) / length;
        const double nl = 2 * vh / length - cosine;
        return std::exp(-t * t / (m * m)) / (m * m) * length * fresnelSchlick(vh, f0) * nl / vh * t;
    }

    /// N.L > 0 up to this slope: the positive root of cosine t^2 - 2 sine cos(phi) t - cosine.
    [[nodiscard]] double lastSlope(double cosinePhi) const {
        const double a = sine * cosinePhi;
        const double root = std::sqrt(a * a + cosine * cosine);
        return a > 0 ? (a + root) / cosine : cosine / (root - a);
    }
};

} // namespace

double directionalAlbedo(double cosine, double m, double f0) {
    constexpr double kReach = 6.5; // exp(-42)
    static const std::vector<Node> kRadial = gaussLegendre(32, 0, 1);
    static const std::vector<Node> kPanel = gaussLegendre(12, 0, 1);
    // The last slope turns quickly around phi = pi / 2 when the eye is low: narrower panels there.
    static const std::vector<double> kEnds = {0, 0.35, 0.45, 0.49, 0.5, 0.51, 0.55, 0.65, 1};
    const SlopeIntegral slopes{cosine, std::sqrt((1 - cosine) * (1 + cosine)), m, f0};
    double sum = 0;
    for (std::size_t panel = 0; panel + 1 < kEnds.size(); ++panel) {
        const double width = std::numbers::pi * (kEnds[panel + 1] - kEnds[panel]);
        for (const Node& around : kPanel) {
            const double cosinePhi = std::cos(std::numbers::pi * kEnds[panel] + width * around.x);
            const double last = std::min(kReach * m, slopes.lastSlope(cosinePhi));
            double ray = 0;
            for (const Node& along : kRadial)
                ray += along.weight * last * slopes.integrand(along.x * last, cosinePhi);
            sum += around.weight * width * ray;
        }
    }
    return 2 * sum; // the other half turn by symmetry
}

double directionalAlbedoPrinted(double cosine, double m, double f0, int nodes) {
    const glm::dvec3 normal{0, 0, 1};
    const glm::dvec3 toEye{std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine};
    double sum = 0;
    for (int i = 0; i < nodes; ++i) {
        const double phi = 2 * std::numbers::pi * i / (nodes - 1);
        for (int j = 0; j < nodes; ++j) {
            const double theta = 0.5 * std::numbers::pi * j / (nodes - 1);
            const glm::dvec3 toLight{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
            sum += std::sin(theta) * toLight.z * kelemenBrdf(normal, toLight, toEye, {.m = m, .f0 = f0});
        }
    }
    return sum * std::numbers::pi * std::numbers::pi / (static_cast<double>(nodes) * nodes);
}

} // namespace tegument::reference
