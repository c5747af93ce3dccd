#include "host/scene/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace tegument;

namespace {

Bounds sphereAt(glm::vec3 centre, float radius) {
    return {.minimum = centre - radius, .maximum = centre + radius, .centre = centre, .radius = radius};
}

/// mul(v, M), written out from the storage order that view.h states.
glm::vec4 mul(const glm::vec4& v, const glm::mat4& m) {
    glm::vec4 result(0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            result[column] += v[row] * m[row][column];
    return result;
}

glm::vec3 project(const glm::vec3& point, const Matrices& matrices) {
    const glm::vec4 clip = mul(glm::vec4(point, 1), matrices.viewProjection);
    return glm::vec3(clip) / clip.w;
}

Camera simple() {
    Camera camera{.position = {0, 0, 10}, .target = {0, 0, 0}, .up = {0, 1, 0}, .horizontalFov = 90};
    camera.nearPlane = 1.0f;
    camera.farPlane = 100.0f;
    return camera;
}

glm::vec3 onSphere(const Bounds& bounds, std::mt19937& random) {
    std::normal_distribution<float> normal;
    return bounds.centre + bounds.radius * glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

} // namespace

TEST(CameraMatrices, x_is_right_and_y_up_on_screen) {
    const Matrices m = cameraMatrices(simple(), 1);
    EXPECT_GT(project({1, 0, 0}, m).x, 0);
    EXPECT_GT(project({0, 1, 0}, m).y, 0);
    EXPECT_LT(glm::length(glm::vec2(project({0, 0, 0}, m))), 1e-6f);
}

TEST(CameraMatrices, depth_is_0_at_the_near_plane_and_1_at_the_far_plane) {
    const Matrices m = cameraMatrices(simple(), 1);
    EXPECT_NEAR(project({0, 0, 9}, m).z, 0, 1e-6f);
    EXPECT_NEAR(project({0, 0, -90}, m).z, 1, 1e-6f);
}

TEST(CameraMatrices, w_is_the_distance_along_the_view) {
    const Matrices m = cameraMatrices(simple(), 1);
    EXPECT_FLOAT_EQ(mul({3, 4, 2, 1}, m.viewProjection).w, 8);
}

TEST(CameraMatrices, the_field_of_view_is_horizontal) {
    const Matrices m = cameraMatrices(simple(), 2);
    EXPECT_NEAR(project({10, 0, 0}, m).x, 1, 1e-6f) << "45 degrees to the side at a field of 90";
    EXPECT_NEAR(project({0, 5, 0}, m).y, 1, 1e-6f) << "twice as wide as high";
}

TEST(CameraMatrices, counter_clockwise_triangles_stay_so_on_screen) {
    const Matrices m = cameraMatrices(simple(), 1);
    const glm::vec2 a(project({0, 0, 0}, m)), b(project({1, 0, 0}, m)), c(project({0, 1, 0}, m));
    EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0) << "y up";
}

TEST(CameraMatrices, stored_as_stated_glm_multiplies_columns_to_the_same_result) {
    const Matrices m = cameraMatrices(simple(), 1.5);
    const glm::vec4 point(1, 2, 3, 1);
    EXPECT_LT(glm::distance(mul(point, m.viewProjection), m.viewProjection * point), 1e-5f);
    EXPECT_LT(glm::distance(mul(mul(point, m.view), m.projection), mul(point, m.viewProjection)), 1e-5f);
    EXPECT_EQ(m.view[3], glm::vec4(0, 0, -10, 1)) << "the last row moves the eye to the origin";
    EXPECT_EQ(m.projection[2][3], -1);
}

TEST(CameraMatrices, inverses_lead_back) {
    Camera camera = simple();
    camera.position = {300, 200, 500};
    camera.nearPlane = 400.0f;
    camera.farPlane = 900.0f;
    const Matrices m = cameraMatrices(camera, 1.3);
    const glm::vec4 point(10, -20, 30, 1);
    const glm::vec4 back = mul(mul(point, m.viewProjection), m.inverseViewProjection);
    EXPECT_LT(glm::distance(glm::vec3(back) / back.w, glm::vec3(point)), 0.01f)
        << "float clip coordinates of 1e3 mm carry 1e-4 mm, times the inverse's 25";
    EXPECT_LT(glm::distance(mul(mul(point, m.view), m.inverseView), point), 1e-3f);
}

TEST(CameraMatrices, an_up_along_the_view_still_gives_a_frame) {
    Camera camera = simple();
    camera.up = {0, 0, 1};
    const Matrices m = cameraMatrices(camera, 1);
    EXPECT_TRUE(std::isfinite(m.view[0][0]));
    EXPECT_NEAR(std::abs(glm::determinant(glm::mat3(m.view))), 1, 1e-5f);
    camera.position = {0, 10, 0};
    camera.up = {0, 1, 0};
    EXPECT_NEAR(std::abs(glm::determinant(glm::mat3(cameraMatrices(camera, 1).view))), 1, 1e-5f);
}

TEST(PlaceScene, relative_positions_are_measured_in_radii_from_the_centre) {
    Workspace workspace;
    workspace.camera.position = {0, 0, 5};
    workspace.camera.target = {0, 0.5f, 0};
    workspace.light.position = {1, 2, 3};
    const PlacedScene scene = placeScene(workspace, sphereAt({10, 20, 30}, 100));
    EXPECT_EQ(scene.camera.position, glm::vec3(10, 20, 530));
    EXPECT_EQ(scene.camera.target, glm::vec3(10, 70, 30));
    EXPECT_EQ(scene.light.position, glm::vec3(110, 220, 330));
}

TEST(PlaceScene, world_positions_are_taken_as_they_are) {
    Workspace workspace;
    workspace.cameraRelative = workspace.lightRelative = false;
    workspace.camera.position = {1, 2, 700};
    workspace.light.position = {4, 5, 6};
    const PlacedScene scene = placeScene(workspace, sphereAt({10, 20, 30}, 100));
    EXPECT_EQ(scene.camera.position, glm::vec3(1, 2, 700));
    EXPECT_EQ(scene.light.position, glm::vec3(4, 5, 6));
}

TEST(PlaceScene, fitted_planes_enclose_the_sphere_within_a_thousandth) {
    Workspace workspace;
    workspace.camera.position = {3, 2, 4};
    const Bounds bounds = sphereAt({5, -7, 9}, 120);
    const PlacedScene scene = placeScene(workspace, bounds);
    const Matrices m = cameraMatrices(scene.camera, 1);
    std::mt19937 random(1);
    float low = 1, high = 0;
    for (int i = 0; i < 20000; ++i) {
        const float depth = project(onSphere(bounds, random), m).z;
        low = std::min(low, depth);
        high = std::max(high, depth);
    }
    EXPECT_GE(low, 0);
    EXPECT_LE(high, 1);
    EXPECT_NEAR(*scene.camera.farPlane - *scene.camera.nearPlane, 2 * bounds.radius, 2 * bounds.radius * 3e-3f)
        << "margin of 1e-3 of radius or distance";
}

TEST(PlaceScene, given_planes_are_kept) {
    Workspace workspace;
    workspace.camera.nearPlane = 17.0f;
    workspace.camera.farPlane = 99.0f;
    const PlacedScene scene = placeScene(workspace, sphereAt({0, 0, 0}, 1));
    EXPECT_EQ(scene.camera.nearPlane, 17);
    EXPECT_EQ(scene.camera.farPlane, 99);
}

TEST(PlaceScene, an_eye_inside_the_mesh_or_looking_away_gets_positive_planes) {
    Workspace workspace;
    for (const glm::vec3 position : {glm::vec3(0, 0, 0.1f), glm::vec3(0, 0, -1), glm::vec3(0, 0, -50)}) {
        workspace.camera.position = position;
        workspace.camera.target = position - glm::vec3(0, 0, 1);
        const PlacedScene scene = placeScene(workspace, sphereAt({0, 0, 0}, 100));
        EXPECT_GT(*scene.camera.nearPlane, 0);
        EXPECT_GT(*scene.camera.farPlane, *scene.camera.nearPlane);
        EXPECT_TRUE(std::isfinite(cameraMatrices(scene.camera, 1).inverseViewProjection[2][3]));
    }
}

TEST(PlaceScene, a_mesh_that_is_one_point_can_be_looked_at) {
    Workspace workspace;
    const PlacedScene scene = placeScene(workspace, sphereAt({1, 2, 3}, 0));
    EXPECT_GT(*scene.camera.farPlane, *scene.camera.nearPlane);
}

TEST(LightMatrices, the_pyramid_holds_the_sphere_and_fits_it) {
    const Bounds bounds = sphereAt({5, -7, 9}, 120);
    const Matrices m = lightMatrices({.position = {400, 500, 300}, .color = {1, 1, 1}}, bounds);
    std::mt19937 random(2);
    float widest = 0;
    for (int i = 0; i < 50000; ++i) {
        const glm::vec3 p = project(onSphere(bounds, random), m);
        widest = std::max({widest, std::abs(p.x), std::abs(p.y)});
        ASSERT_GE(p.z, 0);
        ASSERT_LE(p.z, 1);
    }
    EXPECT_LE(widest, 1);
    EXPECT_GT(widest, 0.995f) << "the margin is a thousandth of the radius";
    EXPECT_EQ(m.position, glm::vec3(400, 500, 300));
}

TEST(LightMatrices, a_light_inside_or_at_the_centre_of_the_sphere_stays_regular) {
    const Bounds bounds = sphereAt({0, 0, 0}, 100);
    for (const glm::vec3 position : {glm::vec3(0), glm::vec3(0, 50, 0), glm::vec3(0, 0, 100.001f)}) {
        const Matrices m = lightMatrices({.position = position, .color = {1, 1, 1}}, bounds);
        EXPECT_GT(m.nearPlane, 0);
        EXPECT_LE(m.horizontalFov, glm::radians(160.1f));
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                EXPECT_TRUE(std::isfinite(m.inverseViewProjection[i][j]));
    }
}

TEST(LightMatrices, a_light_straight_above_has_an_upright_frame) {
    const Matrices m = lightMatrices({.position = {0, 900, 0}, .color = {1, 1, 1}}, sphereAt({0, 0, 0}, 100));
    EXPECT_NEAR(std::abs(glm::determinant(glm::mat3(m.view))), 1, 1e-5f);
}

TEST(LightMatrices, parallel_light_has_a_box_that_holds_the_sphere_and_fits_it) {
    const Bounds bounds = sphereAt({5, -7, 9}, 120);
    const glm::vec3 direction(-4, -5, -3);
    const Matrices m = lightMatrices({.position = {}, .color = {1, 1, 1}, .direction = direction}, bounds);
    std::mt19937 random(2);
    glm::vec3 low(1), high(-1);
    for (int i = 0; i < 50000; ++i) {
        const glm::vec4 p = m.viewProjection * glm::vec4(onSphere(bounds, random), 1);
        ASSERT_EQ(p.w, 1) << "parallel";
        low = glm::min(low, glm::vec3(p));
        high = glm::max(high, glm::vec3(p));
    }
    EXPECT_TRUE(glm::all(glm::greaterThan(low, glm::vec3(-1, -1, 0))) && glm::all(glm::lessThan(high, glm::vec3(1))));
    EXPECT_TRUE(glm::all(glm::greaterThan(high - low, glm::vec3(1.99F, 1.99F, 0.995F)))) << "the margin is a thousandth of the radius";
    // Where the light goes nothing but the depth changes.
    const glm::vec4 along = m.viewProjection * glm::vec4(direction, 0);
    EXPECT_NEAR(glm::length(glm::vec2(along)), 0, 1e-6F);
    EXPECT_GT(along.z, 0);
    // The position is on the near plane: depths are counted from it.
    EXPECT_NEAR((m.viewProjection * glm::vec4(m.position, 1)).z, 0, 1e-6F);
    EXPECT_EQ(m.nearPlane, 0);
    EXPECT_NEAR(m.farPlane, 2 * 1.001F * bounds.radius, 1e-3F);
}

TEST(LightMatrices, what_the_map_covers_can_be_said) {
    const Bounds bounds = sphereAt({0, 0, 0}, 100);
    const Matrices narrow = lightMatrices({.position = {0, 0, 500}, .color = {1, 1, 1}, .fov = 10.0F}, bounds);
    EXPECT_NEAR(narrow.horizontalFov, glm::radians(10.0F), 1e-6F);
    EXPECT_NEAR(project({500 * std::tan(glm::radians(5.0F)), 0, 0}, narrow).x, 1, 1e-5F);
    const Matrices box = lightMatrices({.position = {}, .color = {1, 1, 1}, .direction = glm::vec3(0, 0, -1), .width = 60.0F}, bounds);
    EXPECT_NEAR(project({30, -15, 0}, box).x, 1, 1e-6F);
    EXPECT_NEAR(project({30, -15, 0}, box).y, -0.5F, 1e-6F);
}

TEST(PlaceScene, a_width_in_the_frame_of_the_mesh_is_counted_in_radii) {
    Workspace workspace;
    workspace.light.direction = glm::vec3(0, -1, 0);
    workspace.light.width = 0.5F;
    EXPECT_EQ(placeScene(workspace, sphereAt({10, 20, 30}, 100)).light.width, 50);
    workspace.lightRelative = false;
    EXPECT_EQ(placeScene(workspace, sphereAt({10, 20, 30}, 100)).light.width, 0.5F);
}

TEST(PlaceScene, in_another_unit_only_lengths_change) {
    Workspace workspace;
    workspace.light = {.position = {1, 2, 3}, .color = {1, 2, 3}, .direction = glm::vec3(0, -1, 0), .width = 2.0F};
    const Bounds bounds = sphereAt({10, 20, 30}, 100);
    const PlacedScene scene = placeScene(workspace, bounds);
    const PlacedScene metres = inUnit(scene, 1e-3F);
    EXPECT_EQ(metres.camera.position, 1e-3F * scene.camera.position);
    EXPECT_EQ(metres.camera.target, 1e-3F * scene.camera.target);
    EXPECT_EQ(*metres.camera.farPlane, 1e-3F * *scene.camera.farPlane);
    EXPECT_EQ(metres.camera.horizontalFov, scene.camera.horizontalFov);
    EXPECT_EQ(metres.camera.up, scene.camera.up);
    EXPECT_EQ(metres.light.position, 1e-3F * scene.light.position);
    EXPECT_EQ(*metres.light.width, 1e-3F * *scene.light.width);
    EXPECT_EQ(metres.light.direction, scene.light.direction);
    EXPECT_EQ(metres.light.color, scene.light.color);
    EXPECT_EQ(inUnit(bounds, 1e-3F).radius, 0.1F);
}
