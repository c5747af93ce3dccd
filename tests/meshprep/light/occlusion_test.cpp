// Occlusion against closed forms: a plane, a sphere above a plane, a hollow sphere.

#include "meshprep/light/occlusion.h"
#include "tests/meshprep/light/ball_on_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tegument::test {

namespace {

glm::vec3 direction(const Image& map, int x, int y) {
    return 2.0F * glm::vec3(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)) - 1.0F;
}

TEST(Occlusion, of_a_plane_is_none_and_its_open_direction_the_normal) {
    const auto baked = bakeOcclusion(plane(), {.side = 8, .rays = 256});
    ASSERT_TRUE(baked) << format(baked.error());
    EXPECT_EQ(baked->covered, 64U);
    EXPECT_EQ(baked->open, 1.0);
    // Stratified rays on a disc: their mean is its centre to about 1 / rays.
    EXPECT_LT(glm::length(direction(baked->map, 3, 5) - glm::vec3(0, 1, 0)), 0.02F);
}

TEST(Occlusion, under_a_sphere_is_the_sphere_s_share_of_the_cosine) {
    // A sphere of radius r at height h above the point, at distance d aside, wholly over the horizon: its form factor is (r / D)^2 cos t.
    Mesh mesh = plane();
    constexpr float kRadius = 20;
    const glm::vec3 centre(0, 50, 0);
    addBall(mesh, centre, kRadius, false);
    const auto baked = bakeOcclusion(mesh, {.side = 16, .rays = 4096});
    ASSERT_TRUE(baked) << format(baked.error());
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const glm::dvec3 place(200 * ((x + 0.5) / 16 - 0.5), 0, 200 * ((y + 0.5) / 16 - 0.5));
            const glm::dvec3 to = glm::dvec3(centre) - place;
            const double share = kRadius * kRadius / glm::dot(to, to) * to.y / glm::length(to);
            // Standard error of unstratified rays: sqrt(0.16 * 0.84 / 4096) = 0.006; facets: 0.1 % of the radius.
            EXPECT_NEAR(static_cast<double>(baked->map.at(x, y, 3)), 1 - share, 0.006) << x << " " << y;
            // What is open has lost the rays towards the sphere: the open direction leans away from it.
            const glm::dvec3 open(direction(baked->map, x, y));
            EXPECT_LE(glm::dot(open, glm::dvec3(place.x, 0, place.z)), 0 + glm::length(place)) << x;
            if (share > 0.02) {
                EXPECT_GT(glm::dot(open, place), 0) << x << " " << y;
            }
        }
}

TEST(Occlusion, inside_of_a_closed_body_nothing_is_open) {
    Mesh mesh = plane();
    mesh.positions.clear();
    mesh.normals.clear();
    mesh.uvs.clear();
    mesh.indices.clear();
    addBall(mesh, {0, 0, 0}, 100, true);
    const auto baked = bakeOcclusion(mesh, {.side = 32, .rays = 64});
    ASSERT_TRUE(baked) << format(baked.error());
    EXPECT_EQ(baked->open, 0.0);
    // The normal stands where no direction is open.
    EXPECT_GT(
        glm::dot(direction(baked->map, 16, 16), glm::vec3(-std::cos(std::numbers::pi * 33 / 32), 0, -std::sin(std::numbers::pi * 33 / 32))),
        0.99F);
}

TEST(Occlusion, ends_at_its_reach) {
    Mesh mesh = plane();
    addBall(mesh, {0, 50, 0}, 20, false);
    const auto near = bakeOcclusion(mesh, {.side = 4, .rays = 64, .reachMm = 25});
    ASSERT_TRUE(near) << format(near.error());
    EXPECT_EQ(near->open, 1.0);
}

TEST(Occlusion, of_a_mesh_without_coordinates_is_an_error) {
    Mesh mesh = plane();
    mesh.uvs.clear();
    const auto baked = bakeOcclusion(mesh);
    ASSERT_FALSE(baked);
    EXPECT_EQ(baked.error().diagnostics.front().code, 7061);
}

} // namespace

} // namespace tegument::test
