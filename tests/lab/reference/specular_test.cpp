// The reflection of the references against published values and against plainer integrals.

#include "lab/reference/quadrature.h"
#include "lab/reference/specular.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace tegument::reference;

namespace {

/// The integral over light directions, as it is defined: no half vectors, no change of variables.
double albedoOverLight(double cosine, double m, std::size_t polar, int around) {
    const glm::dvec3 toEye{std::sqrt(1 - cosine * cosine), 0, cosine};
    double sum = 0;
    for (const Node& theta : gaussLegendre(polar, 0, 0.5 * std::numbers::pi))
        for (int i = 0; i < around; ++i) {
            const double phi = std::numbers::pi * (i + 0.5) / around;
            const glm::dvec3 toLight{std::sin(theta.x) * std::cos(phi), std::sin(theta.x) * std::sin(phi), std::cos(theta.x)};
            sum += theta.weight * std::sin(theta.x) * toLight.z * kelemenBrdf({0, 0, 1}, toLight, toEye, m, 1);
        }
    return sum * 2 * std::numbers::pi / around;
}

constexpr double kTableCosines[] = {0.05, 0.2, 0.5, 0.8, 1.0};

} // namespace

TEST(Quadrature, integrates_polynomials_up_to_twice_its_nodes_exactly) {
    for (std::size_t count : {1U, 2U, 5U, 16U, 48U}) {
        double sum = 0;
        const auto degree = static_cast<double>(2 * count - 2);
        for (const Node& node : gaussLegendre(count))
            sum += node.weight * std::pow(node.x, degree);
        EXPECT_NEAR(sum, 2 / (degree + 1), 1e-14) << count << " nodes"; // rounding of a sum of at most 48 terms
    }
}

TEST(BeckmannReference, integrates_with_the_cosine_to_pi) {
    for (double m : {0.05, 0.1, 0.3, 1.0}) {
        double sum = 0;
        for (int panel = 0; panel < 64; ++panel) // narrow lobes need narrow panels
            for (const Node& theta : gaussLegendre(16, panel * std::numbers::pi / 128, (panel + 1) * std::numbers::pi / 128))
                sum += theta.weight * beckmannPH(std::cos(theta.x), m) * std::cos(theta.x) * std::sin(theta.x);
        EXPECT_NEAR(2 * sum, 1, 1e-10) << "m = " << m;
    }
}

/// An independent table of four digits, made with 720 azimuths; its first entry is 1.5385, see the test below.
TEST(DirectionalAlbedoReference, has_the_tabulated_values) {
    constexpr double kRoughness[] = {0.1, 0.2, 0.3, 0.5};
    constexpr double kTable[4][5] = {{1.5393, .8558, .1860, .0883, .0871},
                                     {1.2263, .6107, .1725, .0864, .0844},
                                     {1.0138, .4771, .1478, .0822, .0801},
                                     {.7511, .3363, .1113, .0686, .0665}};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 5; ++column)
            EXPECT_NEAR(directionalAlbedo(kTableCosines[column], kRoughness[row]), kTable[row][column], 0.50001e-4)
                << "m = " << kRoughness[row] << ", cosine = " << kTableCosines[column];
}

TEST(DirectionalAlbedoReference, agrees_with_the_integral_over_light_directions) {
    for (double m : {0.1, 0.3, 1.0})
        for (double cosine : kTableCosines) // at cosine 0.05 the plain rule needs this many azimuths to come within the tolerance
            EXPECT_NEAR(directionalAlbedo(cosine, m), albedoOverLight(cosine, m, 300, 1000), 2e-5)
                << "m = " << m << ", cosine = " << cosine;
}

/// At m = 0.1 and cosine 0.05 the lobe is 0.4 degrees wide around the plane of incidence for grazing directions: steps of 0.5 degrees miss
/// it.
TEST(DirectionalAlbedoReference, at_grazing_angles_720_azimuths_are_too_few) {
    EXPECT_NEAR(albedoOverLight(0.05, 0.1, 1500, 360), 1.5385, 0.50001e-4);
    EXPECT_NEAR(albedoOverLight(0.05, 0.1, 800, 1500), 1.5393, 0.50001e-4);
}

TEST(DirectionalAlbedoReference, the_printed_rule_has_the_tabulated_values) {
    constexpr double kNarrow[] = {.2352, .6709, .1814, .0861, .0859};
    constexpr double kTypical[] = {.9070, .4648, .1441, .0802, .0790};
    for (int column = 0; column < 5; ++column) {
        EXPECT_NEAR(directionalAlbedoPrinted(kTableCosines[column], 0.1, 80), kNarrow[column], 0.50001e-4) << kTableCosines[column];
        EXPECT_NEAR(directionalAlbedoPrinted(kTableCosines[column], 0.3, 80), kTypical[column], 0.50001e-4) << kTableCosines[column];
    }
}

TEST(KelemenReference, is_reciprocal) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(0.3, -0.5, 0.4));
    const glm::dvec3 b = glm::normalize(glm::dvec3(-0.7, 0.1, 0.2));
    const double there = kelemenBrdf({0, 0, 1}, a, b, 0.3, 0.18);
    EXPECT_NEAR(there, kelemenBrdf({0, 0, 1}, b, a, 0.3, 0.18), 1e-12 * there); // rounding: tan^2 / m^2 is 11 here
}
