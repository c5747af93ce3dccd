// Blurs in millimetres: what a map of any size must agree on.

#include "lab/reference/chart_map.h"
#include "tests/lab/reference/meshes.h"

#include <gtest/gtest.h>

using namespace tegument::reference;

namespace {

constexpr float kHalf = 10; // mm
constexpr double kKernel = 0.5;

/// One lit texel in the middle of a plane of 20 mm.
ChartMap litTexel(int size) {
    ChartMap chart = chartMap(plane(kHalf, 4), size, [](const SurfacePoint&) { return glm::dvec4(0, 0, 0, kKernel); });
    chart.map.texels[chart.map.index(size / 2, size / 2)] = glm::dvec4(1, 1, 1, kKernel);
    return chart;
}

/// mm^2, mean of both axes.
double varianceOf(const ChartMap& chart, const Map& blurred) {
    double weight = 0;
    glm::dvec2 first(0);
    double second = 0;
    for (int y = 0; y < blurred.size; ++y)
        for (int x = 0; x < blurred.size; ++x) {
            const double light = blurred.texels[blurred.index(x, y)].x;
            const glm::dvec2 place = glm::dvec2(x, y) / chart.densityAt(blurred.size / 2, blurred.size / 2);
            weight += light;
            first += light * place;
            second += light * glm::dot(place, place);
        }
    const glm::dvec2 mean = first / weight;
    return (second / weight - glm::dot(mean, mean)) / 2;
}

} // namespace

TEST(ChartMap, density_is_texels_over_millimetres) {
    for (const int size : {32, 128}) {
        const ChartMap chart = litTexel(size);
        for (const glm::dvec2& density : chart.density) {
            EXPECT_NEAR(density.x, size / 20.0, size * 1e-6); // positions are 32-bit floats
            EXPECT_NEAR(density.y, size / 20.0, size * 1e-6);
        }
    }
}

TEST(ChartMap, a_gaussian_has_its_variance_on_the_surface_at_any_size) {
    for (const int size : {32, 64, 128}) {
        const ChartMap chart = litTexel(size);
        const double texel = 20.0 / size;
        // What the map shows is spread by the texel's square once more.
        EXPECT_NEAR(varianceOf(chart, spread(chart, 1.99)) + texel * texel / 12, 1.99, 1e-4) << size;
    }
}

TEST(ChartMap, discs_have_the_variance_of_their_thirteen_points) {
    const ChartMap chart = litTexel(256);
    glm::dvec2 mean(0);
    for (const auto& p : kPrintedDisc)
        mean += glm::dvec2(p[0], p[1]) / 12.0;
    double points = 0; // of the centred disc and the texel itself, mean of both axes
    for (const auto& p : kPrintedDisc)
        points += glm::dot(glm::dvec2(p[0], p[1]) - mean, glm::dvec2(p[0], p[1]) - mean) / 26;
    const double radius = 1.6 * kKernel;
    for (const int count : {1, 2, 3}) {
        const double variance = varianceOf(chart, spread(chart, Discs{.size = 1.6, .count = count}));
        // Taps fall on whole texels, up to half of one aside: 5 % of the radius.
        EXPECT_NEAR(variance, count * points * radius * radius, 0.05 * count * points * radius * radius) << count << " discs";
    }
}

TEST(ChartMap, printed_discs_are_sized_in_texels) {
    const Discs printed{.size = 3, .turn = 0, .count = 1, .asPrinted = true};
    const double small = varianceOf(litTexel(64), spread(litTexel(64), printed));
    const double large = varianceOf(litTexel(128), spread(litTexel(128), printed));
    EXPECT_NEAR(small, 4 * large, 1e-6 * small); // positions are 32-bit floats
}

TEST(ChartMap, discs_leave_alpha_and_constant_light_as_they_are) {
    const ChartMap chart = chartMap(plane(kHalf, 4), 48, [](const SurfacePoint&) { return glm::dvec4(0.25, 0.5, 1, kKernel); });
    for (const bool printed : {false, true})
        for (const glm::dvec4& texel : spread(chart, Discs{.asPrinted = printed}).texels)
            EXPECT_LT(glm::length(texel - glm::dvec4(0.25, 0.5, 1, kKernel)), 1e-12);
}
