
#include "host/mesh/mesh.h"
#include "meshprep/human/atlas.h"
#include "meshprep/human/cut.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

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
    AtlasChart chart{.surfaceMm2 = 7};
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

TEST(WidenFace, keeps_the_centre_and_the_sides) {
    const glm::vec2 centre(0.3f, 0.4f);
    EXPECT_EQ(widenFace(centre, centre, 0.5f), centre);
    EXPECT_NEAR(widenFace(glm::vec2(0.8f, 0.4f), centre, 0.5f).x, 0.8f, 1e-6f);
    EXPECT_NEAR(widenFace(glm::vec2(-0.2f, 0.4f), centre, 0.5f).x, -0.2f, 1e-6f);
}

TEST(WidenFace, grows_everywhere_so_that_nothing_folds) {
    const glm::vec2 centre(0.3f, 0.4f);
    for (int i = -100; i < 100; ++i) {
        const float t = 0.005f * static_cast<float>(i);
        const glm::vec2 here = widenFace(centre + glm::vec2(t), centre, 0.5f);
        const glm::vec2 next = widenFace(centre + glm::vec2(t + 0.005f), centre, 0.5f);
        EXPECT_GT(next.x, here.x) << t;
        EXPECT_GT(next.y, here.y) << t;
    }
}

TEST(WidenFace, enlarges_the_middle) {
    const glm::vec2 step = widenFace(glm::vec2(0.001f), glm::vec2(0), 1) / 0.001f;
    EXPECT_NEAR(step.x, 1.4f, 0.01f); // 1 + 0.4, and 0.9 + 0.7
    EXPECT_NEAR(step.y, 1.6f, 0.01f);
}

/// One triangle in the plane z = 0 whose coordinates are `uv`.
TriangleSurface triangle(const std::array<glm::vec2, 3>& uv) {
    return {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
            .normals = {3, glm::vec3(0, 0, 1)},
            .uvs = {uv.begin(), uv.end()},
            .triangles = {{.position = {0, 1, 2}, .uv = {0, 1, 2}, .part = BustPart::LeftEye}}}; // not skin: no widening
}

TEST(Unfold, a_chart_that_lies_on_its_side_is_set_upright) {
    const std::vector<glm::vec2> plane = unfoldCharts(triangle({glm::vec2(0, 0), glm::vec2(0, -1), glm::vec2(1, 0)}), {0});
    EXPECT_EQ(plane[2] - plane[0], glm::vec2(0, 1));
    EXPECT_EQ(plane[1] - plane[0], glm::vec2(1, 0));
}

TEST(Unfold, an_upright_chart_stays) {
    const std::vector<glm::vec2> plane = unfoldCharts(triangle({glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}), {0});
    EXPECT_EQ(plane[1], glm::vec2(1, 0));
    EXPECT_EQ(plane[2], glm::vec2(0, 1));
}

TriangleSurface cubeSurface() {
    const QuadMesh cube = shapes::cube(1);
    TriangleSurface surface{.positions = cube.positions, .uvs = cube.uvs};
    for (const glm::vec3& p : cube.positions)
        surface.normals.push_back(glm::normalize(p));
    for (const Quad& quad : cube.quads)
        for (const auto& [b, c] : {std::pair<std::size_t, std::size_t>(1, 2), std::pair<std::size_t, std::size_t>(2, 3)})
            surface.triangles.push_back(
                {.position = {quad.position[0], quad.position[b], quad.position[c]}, .uv = {quad.uv[0], quad.uv[b], quad.uv[c]}});
    return surface;
}

double areaOf(const TriangleSurface& surface) {
    double area = 0;
    for (const CornerTriangle& t : surface.triangles)
        area += static_cast<double>(glm::length(glm::cross(surface.positions[t.position[1]] - surface.positions[t.position[0]],
                                                           surface.positions[t.position[2]] - surface.positions[t.position[0]]))) /
                2;
    return area;
}

TEST(Cut, what_is_left_has_the_area_above_the_plane) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, 0.25f);
    EXPECT_NEAR(areaOf(surface), 4 + 4 * 2 * 0.75, 1e-5); // the top and four sides of height 0.75
}

TEST(Cut, nothing_is_left_below_the_plane) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, 0.25f);
    for (const CornerTriangle& t : surface.triangles)
        for (const std::uint32_t v : t.position)
            EXPECT_GE(surface.positions[v].y, 0.25f);
}

TEST(Cut, texture_coordinates_are_cut_at_the_same_place) {
    TriangleSurface surface = cubeSurface();
    for (glm::vec2& uv : surface.uvs)
        uv = glm::vec2(-1);
    for (const CornerTriangle& t : surface.triangles)
        for (std::size_t c = 0; c < 3; ++c)
            surface.uvs[t.uv[c]] = glm::vec2(surface.positions[t.position[c]].x, surface.positions[t.position[c]].y);
    cutBelow(surface, 0.25f);
    for (const CornerTriangle& t : surface.triangles)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_LT(glm::distance(surface.uvs[t.uv[c]], glm::vec2(surface.positions[t.position[c]])), 1e-6f);
}

TEST(Cut, a_plane_beside_the_mesh_changes_nothing) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, -5);
    EXPECT_EQ(surface.triangles.size(), 12u);
}

TEST(Cut, a_vertex_near_the_plane_is_moved_onto_it) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, -0.98f);
    EXPECT_EQ(surface.triangles.size(), 10u); // the bottom goes, and no sliver comes
}

TEST(Cut, the_closed_base_leaves_no_open_edge) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, 0.25f);
    EXPECT_GT(closeBase(surface, 0.25f), 0u);
    const auto place = [&](std::uint32_t v) {
        const glm::vec3& p = surface.positions[v];
        return std::array<float, 3>{p.x, p.y, p.z};
    };
    std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> balance;
    for (const CornerTriangle& t : surface.triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            ++balance[{place(t.position[c]), place(t.position[(c + 1) % 3])}];
            --balance[{place(t.position[(c + 1) % 3]), place(t.position[c])}];
        }
    for (const auto& [edge, count] : balance)
        EXPECT_EQ(count, 0);
}

TEST(Cut, the_base_faces_down) {
    TriangleSurface surface = cubeSurface();
    cutBelow(surface, 0.25f);
    closeBase(surface, 0.25f);
    for (const CornerTriangle& t : surface.triangles) {
        if (t.part != BustPart::Base) continue;
        const glm::vec3 normal = glm::cross(surface.positions[t.position[1]] - surface.positions[t.position[0]],
                                            surface.positions[t.position[2]] - surface.positions[t.position[0]]);
        EXPECT_LT(normal.y, 0);
    }
}

} // namespace
} // namespace tegument
