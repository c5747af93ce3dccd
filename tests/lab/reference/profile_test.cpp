// Closed forms of the profile against published values and against the integrals that they solve.

#include "lab/reference/profile.h"
#include "lab/reference/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace tegument::reference;

namespace {

constexpr double kCosines[] = {1, .7, .3, .1, 0, -.05, -.1, -.3};

/// Directly: E over the sphere times G of the chord, one Gaussian.
double sphereByQuadrature(double variance, double radius, double cosine) {
    const double reach = std::min(std::numbers::pi, 9 * std::sqrt(variance) / radius);
    const double sine = std::sqrt(1 - cosine * cosine);
    constexpr int kAround = 800;
    double sum = 0;
    for (const Node& gamma : gaussLegendre(200, 0, reach))
        for (int i = 0; i < kAround; ++i) {
            const double phi = 2 * std::numbers::pi * (i + 0.5) / kAround;
            const double light = std::max(0.0, cosine * std::cos(gamma.x) + sine * std::sin(gamma.x) * std::cos(phi));
            const double chord2 = 2 * radius * radius * (1 - std::cos(gamma.x));
            sum += gamma.weight * std::sin(gamma.x) * light * std::exp(-chord2 / (2 * variance));
        }
    return sum * 2 * std::numbers::pi / kAround * radius * radius / (2 * std::numbers::pi * variance);
}

} // namespace

TEST(Profile, is_white) {
    const glm::dvec3 sum = slab(skinProfile(), 0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c], 1, 1e-12);
}

TEST(Profile, half_plane_is_one_half_at_the_edge_and_symmetric) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(halfPlane(skinProfile(), 0)[c], 0.5, 1e-12);
        EXPECT_NEAR(halfPlane(skinProfile(), 0.4)[c] + halfPlane(skinProfile(), -0.4)[c], 1, 1e-12);
    }
}

TEST(Profile, half_plane_is_the_integral_of_the_profile_s_line_spread) {
    const auto line = [](double x) {
        glm::dvec3 sum(0);
        for (const Gaussian& g : skinProfile())
            sum += g.weight * std::exp(-x * x / (2 * g.variance)) / std::sqrt(2 * std::numbers::pi * g.variance);
        return sum;
    };
    glm::dvec3 sum(0);
    for (int panel = 0; panel < 200; ++panel)
        for (const Node& node : gaussLegendre(12, -20 + 0.1 * panel, -20 + 0.1 * (panel + 1)))
            sum += node.weight * line(node.x + 0.3);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c], halfPlane(skinProfile(), 0.3)[c], 1e-9) << c;
}

TEST(Profile, disc_and_sinusoid_are_the_integrals_over_the_plane) {
    for (double parameter : {0.3, 1.5}) {
        glm::dvec3 disc(0);
        glm::dvec3 wave(0);
        for (int panel = 0; panel < 400; ++panel)
            for (const Node& node : gaussLegendre(16, 0.05 * panel, 0.05 * (panel + 1)))
                for (const Gaussian& g : skinProfile()) {
                    const double ring = node.weight * node.x / g.variance * std::exp(-node.x * node.x / (2 * g.variance));
                    disc += node.x < parameter ? ring * g.weight : glm::dvec3(0);
                    wave += ring * std::cyl_bessel_j(0, parameter * node.x) * g.weight; // cos averaged around the ring
                }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(disc[c], discCentre(skinProfile(), parameter)[c], 1e-9) << parameter;
            EXPECT_NEAR(wave[c], sinusoid(skinProfile(), parameter)[c], 1e-9) << parameter;
        }
    }
}

TEST(Profile, a_slab_is_seen_through_as_far_as_the_table_says) { // red at 1, 2 and 4 mm
    EXPECT_NEAR(slab(skinProfile(), 1).r, .406, 0.5e-3);
    EXPECT_NEAR(slab(skinProfile(), 2).r, .194, 0.5e-3);
    EXPECT_NEAR(slab(skinProfile(), 4).r, .033, 0.5e-3);
}

/// To the digits of an independent computation (scaled Bessel functions of SciPy).
TEST(Sphere, has_the_tabulated_values) {
    constexpr double kRed5[] = {.945477, .664043, .299241, .134653, .067890, .051216, .040173, .015800};
    constexpr double kGreen5[] = {.997275, .698094, .299279, .101277, .016464, .004560, .001550, .000097};
    constexpr double kRed10[] = {.986171, .690345, .297661, .111252, .035268, .020593, .012634, .001809};
    constexpr double kGreen10[] = {.999319, .699523, .299799, .100064, .008247, .000774, .000133, .000003};
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 small = sphere(skinProfile(), 5, kCosines[i]);
        const glm::dvec3 large = sphere(skinProfile(), 10, kCosines[i]);
        EXPECT_NEAR(small.r, kRed5[i], 0.50001e-6) << kCosines[i];
        EXPECT_NEAR(small.g, kGreen5[i], 0.50001e-6) << kCosines[i];
        EXPECT_NEAR(large.r, kRed10[i], 0.50001e-6) << kCosines[i];
        EXPECT_NEAR(large.g, kGreen10[i], 0.50001e-6) << kCosines[i];
    }
}

TEST(Sphere, is_the_integral_over_its_surface) {
    for (double variance : {0.187, 1.99, 7.41})
        for (double cosine : {1.0, 0.3, 0.0, -0.3}) {
            const Profile one = {{variance, {1, 1, 1}}};
            EXPECT_NEAR(sphere(one, 5, cosine).r, sphereByQuadrature(variance, 5, cosine), 1e-5)
                << variance << ", " << cosine; // the kink at the terminator
        }
}

TEST(Sphere, tends_to_the_plane_as_it_grows) {
    EXPECT_NEAR(sphere(skinProfile(), 200, 1).r, 1, 1e-4); // 1 - mean square radius / (2 rho^2) and the like
}
