#include "meshprep/human/atlas.h"

#include "host/mesh/mesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tegument {
namespace {

AtlasChart rectangle(float width, float height, double surface, double density = 1) {
    return {.triangles = {{glm::vec2(0), glm::vec2(width, 0), glm::vec2(width, height)},
                          {glm::vec2(0), glm::vec2(width, height), glm::vec2(0, height)}},
            .surfaceMm2 = surface,
            .density = density};
}

/// Three sides of a square: a hollow that another chart fits into.
AtlasChart horseshoe() {
    AtlasChart chart{.triangles = {}, .surfaceMm2 = 7};
    for (const auto& [low, high] : {std::pair(glm::vec2(0, 0), glm::vec2(3, 1)), std::pair(glm::vec2(0, 1), glm::vec2(1, 3)),
                                    std::pair(glm::vec2(2, 1), glm::vec2(3, 3))}) {
        chart.triangles.push_back({low, glm::vec2(high.x, low.y), high});
        chart.triangles.push_back({low, high, glm::vec2(low.x, high.y)});
    }
    return chart;
}

UvReport reportOf(const std::vector<AtlasChart>& charts, const std::vector<Placement>& placements) {
    Mesh mesh;
    for (std::size_t i = 0; i < charts.size(); ++i)
        for (const auto& triangle : charts[i].triangles)
            for (const glm::vec2& p : triangle) {
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.uvs.size()));
                mesh.uvs.push_back(placements[i](p));
                mesh.positions.emplace_back(p, 0);
            }
    return examineUvs(mesh);
}

const std::vector<AtlasChart> kMixed = {rectangle(2, 1, 500), rectangle(1, 1, 100), rectangle(0.1f, 5, 200), horseshoe()};

TEST(Atlas, charts_do_not_overlap) {
    const std::vector<Placement> placements = packCharts(kMixed, 0.01);
    ASSERT_EQ(placements.size(), kMixed.size());
    EXPECT_EQ(reportOf(kMixed, placements).overlapping, 0);
}

TEST(Atlas, charts_lie_inside_the_unit_square) {
    const std::vector<Placement> placements = packCharts(kMixed, 0.01);
    ASSERT_EQ(placements.size(), kMixed.size());
    EXPECT_EQ(reportOf(kMixed, placements).outside, 0);
}

TEST(Atlas, texel_densities_stand_in_the_wanted_proportion) {
    const std::vector<AtlasChart> charts = {rectangle(2, 1, 500), rectangle(7, 3, 80, 2)};
    const std::vector<Placement> placements = packCharts(charts, 0.01);
    ASSERT_EQ(placements.size(), 2u);
    const auto density = [&](std::size_t i) { return placements[i].scale * std::sqrt(chartArea(charts[i]) / charts[i].surfaceMm2); };
    EXPECT_NEAR(density(1) / density(0), 2, 1e-9); // both are set from one common scale
}

TEST(Atlas, a_square_chart_fills_the_square_but_for_the_gutter) {
    const std::vector<AtlasChart> charts = {rectangle(3, 3, 1)};
    const std::vector<Placement> placements = packCharts(charts, 0.02);
    ASSERT_EQ(placements.size(), 1u);
    const double side = 3 * placements[0].scale;
    EXPECT_LE(side, 0.98);
    EXPECT_GE(side, 0.97); // cells of 1/512 and twelve bisections cost less than one part in a hundred
}

TEST(Atlas, the_gutter_stays_free) {
    const std::vector<AtlasChart> charts = {rectangle(1, 2, 2), rectangle(1, 2, 2)};
    const std::vector<Placement> placements = packCharts(charts, 0.05);
    ASSERT_EQ(placements.size(), 2u);
    const double gap = std::abs(placements[0](glm::vec2(0)).x - placements[1](glm::vec2(0)).x) - placements[0].scale;
    EXPECT_GE(gap, 0.05 - 1e-6); // rounding of single precision coordinates
}

TEST(Atlas, a_small_chart_lies_in_the_hollow_of_a_large_one) {
    const std::vector<AtlasChart> charts = {horseshoe(), rectangle(0.8f, 1.5f, 1.2)};
    const std::vector<Placement> placements = packCharts(charts, 0.01);
    ASSERT_EQ(placements.size(), 2u);
    EXPECT_GT(placements[0].scale, 0.32); // a third of the square for each unit: nothing was added to the horseshoe's own square
}

TEST(Atlas, a_chart_without_area_cannot_be_packed) {
    EXPECT_TRUE(packCharts({rectangle(0, 1, 10)}, 0.01).empty());
}

} // namespace
} // namespace tegument
