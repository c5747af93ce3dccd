#include "meshprep/human/bake.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tegument {
namespace {

/// A square of 64 mm in the plane z = 0 that fills the middle half of the map in u and v.
HeadSurface square() {
    HeadSurface head;
    head.mesh.positions = {{-32, -32, 0}, {32, -32, 0}, {32, 32, 0}, {-32, 32, 0}};
    head.mesh.normals.assign(4, glm::vec3(0, 0, 1));
    head.mesh.uvs = {{0.25f, 0.75f}, {0.75f, 0.75f}, {0.75f, 0.25f}, {0.25f, 0.25f}};
    head.mesh.indices = {0, 1, 2, 0, 2, 3};
    computeTangents(head.mesh);
    head.sourceUvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    head.parts = {BustPart::Skin, BustPart::Skin};
    return head;
}

TEST(Bake, texels_get_the_point_under_their_centre) {
    const Image image = bakeTexture(square(), 64, 3, [](const SurfacePoint& point) { return glm::vec4(point.position, 1); });
    EXPECT_NEAR(image.at(40, 20, 0), (40.5f / 64 - 0.5f) * 128, 1e-3f); // 128 mm would fill the map; a rounding of single precision
    EXPECT_NEAR(image.at(40, 20, 1), (0.5f - 20.5f / 64) * 128, 1e-3f);
}

TEST(Bake, source_coordinates_follow_the_surface) {
    const Image image = bakeTexture(square(), 64, 2, [](const SurfacePoint& point) { return glm::vec4(point.sourceUv, 0, 1); });
    EXPECT_NEAR(image.at(16, 47, 0), 0.5f / 32, 1e-5f);
    EXPECT_NEAR(image.at(16, 47, 1), 0.5f / 32, 1e-5f);
}

TEST(Bake, the_tangent_points_to_growing_u_and_the_bitangent_to_falling_v) {
    const Image image =
        bakeTexture(square(), 64, 4, [](const SurfacePoint& point) { return glm::vec4(point.tangent.x, point.bitangent.y, 0, 0); });
    EXPECT_NEAR(image.at(32, 32, 0), 1, 1e-6f);
    EXPECT_NEAR(image.at(32, 32, 1), 1, 1e-6f);
}

TEST(Bake, the_size_of_a_texel_is_known_in_millimetres) {
    const Image image = bakeTexture(square(), 64, 1, [](const SurfacePoint& point) { return glm::vec4(point.texelMm); });
    EXPECT_NEAR(image.at(32, 32, 0), 2, 1e-5f); // 64 mm over 32 texels
}

TEST(Bake, gutters_take_the_nearest_covered_value) {
    const Image image =
        bakeTexture(square(), 64, 1, [](const SurfacePoint& point) { return glm::vec4(point.position.x < 0 ? 1.0f : 2.0f); });
    EXPECT_EQ(image.at(0, 32, 0), 1);
    EXPECT_EQ(image.at(63, 32, 0), 2);
    EXPECT_EQ(image.at(2, 2, 0), 1);
}

TEST(Bake, a_mesh_without_area_leaves_the_map_black) {
    HeadSurface head = square();
    head.mesh.uvs.assign(4, glm::vec2(0.5f));
    const Image image = bakeTexture(head, 16, 1, [](const SurfacePoint&) { return glm::vec4(1); });
    for (const float value : image.pixels)
        EXPECT_EQ(value, 0);
}

} // namespace
} // namespace tegument
