#include "host/scene/placement.h"
#include "host/scene/workspace.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace tegument;

namespace {

Mesh tetrahedron() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {10, 0, 0}, {0, 20, 0}, {0, 0, 30}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    computeBounds(mesh);
    return mesh;
}

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance) {
    for (glm::length_t i = 0; i < 3; ++i)
        EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

} // namespace

TEST(Placements, none_is_the_identity) {
    EXPECT_EQ(worldMatrix({}), glm::dmat4(1));
}

TEST(Placements, turn_counter_clockwise_about_fixed_axes) {
    // Against the axis y, x goes towards -z.
    expectNear(transformPoint(worldMatrix({.rotation = {0, 90, 0}}), {1, 0, 0}), {0, 0, -1}, 0);
    expectNear(transformPoint(worldMatrix({.rotation = {90, 0, 0}}), {0, 1, 0}), {0, 0, 1}, 0);
    expectNear(transformPoint(worldMatrix({.rotation = {0, 0, 90}}), {1, 0, 0}), {0, 1, 0}, 0);
    const double half = std::sqrt(0.5);
    expectNear(transformPoint(worldMatrix({.rotation = {0, 45, 0}}), {1, 0, 0}), {half, 0, -half}, 1e-15); // an ulp of double
}

TEST(Placements, bounds_hold_every_placed_vertex) {
    const Mesh mesh = tetrahedron();
    const Placement placement{.position = {5, -6, 7}, .rotation = {20, 130, -70}, .scale = glm::vec3(1.5F)};
    const Bounds bounds = placedBounds(mesh, placement);
    EXPECT_FLOAT_EQ(bounds.radius, 1.5F * mesh.bounds.radius);
    for (const glm::vec3& position : mesh.positions) {
        const glm::vec3 p(transformPoint(worldMatrix(placement), glm::dvec3(position)));
        EXPECT_LE(glm::distance(p, bounds.centre), bounds.radius * (1 + 1e-6F)) << "a rounding of the centre to float";
        EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.minimum, p)) && glm::all(glm::lessThanEqual(p, bounds.maximum)));
    }
}

TEST(Placements, an_uneven_scale_goes_along_the_mesh_s_own_axes) {
    const Placement placement{.position = {1, 2, 3}, .rotation = {0, 0, 90}, .scale = {2, 3, -4}};
    expectNear(transformPoint(worldMatrix(placement), {1, 1, 1}), {1 - 3, 2 + 2, 3 - 4}, 0);
    EXPECT_TRUE(isMirrored(placement));
    EXPECT_FALSE(isEvenlyScaled(placement));
    EXPECT_FALSE(isMirrored({.scale = {-2, -2, 2}}));
    EXPECT_TRUE(isEvenlyScaled({.scale = {-2, -2, 2}}));
}

TEST(Placements, the_ball_of_what_is_scaled_unevenly_holds_every_vertex_and_no_more) {
    const Mesh mesh = tetrahedron();
    const Placement placement{.position = {5, -6, 7}, .rotation = {20, 130, -70}, .scale = {1, -0.1F, 4}};
    const Bounds bounds = placedBounds(mesh, placement);
    for (const glm::vec3& position : mesh.positions) {
        const glm::vec3 p(transformPoint(worldMatrix(placement), glm::dvec3(position)));
        EXPECT_LE(glm::distance(p, bounds.centre), bounds.radius * (1 + 1e-6F));
    }
    EXPECT_NEAR(bounds.radius, 60.21F, 0.01F) << "half of the way from (10, 0, 0) to (0, 0, 120)";
    EXPECT_FLOAT_EQ(placedBounds(mesh, {.scale = {-2, 2, 2}}).radius, 2 * mesh.bounds.radius);
}

TEST(Placements, bounds_of_two_balls_span_both) {
    const Mesh mesh = tetrahedron();
    const std::vector<PlacedMesh> two = {{&mesh, {}}, {&mesh, {.position = {1000, 0, 0}}}};
    const Bounds all = boundsOfAll(two);
    EXPECT_EQ(all.maximum.x, 1010);
    EXPECT_EQ(all.minimum.x, 0);
    EXPECT_NEAR(all.radius, 505, 1) << "half of 1010, and a little for the other corners: 30^2 / (2 * 505) is 0.9";
}

TEST(Placements, a_scene_seen_from_an_object_returns_by_its_matrix) {
    const Placement placement{.position = {5, -6, 7}, .rotation = {20, 130, -70}, .scale = glm::vec3(1.5F)};
    PlacedScene scene;
    scene.camera.position = {100, 200, 300};
    scene.light.position = {-50, 60, 70};
    const PlacedScene local = seenFrom(scene, placement);
    Placement rigid = placement;
    rigid.scale = glm::vec3(1);
    expectNear(transformPoint(worldMatrix(rigid), glm::dvec3(local.camera.position)), {100, 200, 300}, 1e-4); // floats of 300 mm
    expectNear(transformPoint(worldMatrix(rigid), glm::dvec3(local.light.position)), {-50, 60, 70}, 1e-4);
    PlacedScene parallel = scene;
    parallel.light.direction = glm::vec3(1, 2, 3);
    const glm::dvec3 turned(*seenFrom(parallel, placement).light.direction);
    rigid.position = {};
    expectNear(transformPoint(worldMatrix(rigid), turned), {1, 2, 3}, 1e-6);
    EXPECT_NEAR(glm::length(local.camera.up), 1, 1e-6F);
}
