#include "meshprep/human/unfold.h"

#include <gtest/gtest.h>

namespace tegument {
namespace {

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

} // namespace
} // namespace tegument
