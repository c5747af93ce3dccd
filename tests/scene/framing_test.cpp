// A camera that frames a mesh: every vertex inside, the outermost at the edge.

#include "host/scene/framing.h"
#include "host/scene/placement.h"
#include "host/scene/view.h"
#include "host/scene/workspace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace tegument;

namespace {

Mesh cloud(const glm::vec3& size, const glm::vec3& at) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> noise(-0.5F, 0.5F);
    Mesh mesh;
    for (int i = 0; i < 500; ++i)
        mesh.positions.push_back(at + size * glm::vec3(noise(random), noise(random), noise(random)));
    computeBounds(mesh);
    return mesh;
}

struct Extent {
    glm::dvec2 low{1e9}, high{-1e9}; // of clip space's x and y over w
};

Extent onScreen(const Mesh& mesh, Camera camera, double aspect) {
    Workspace workspace;
    workspace.camera = camera;
    workspace.cameraRelative = false;
    const Matrices matrices = cameraMatrices(placeScene(workspace, mesh.bounds).camera, aspect);
    Extent extent;
    for (const glm::vec3& p : mesh.positions) {
        const glm::dvec4 clip = glm::dmat4(matrices.viewProjection) * glm::dvec4(glm::dvec3(p), 1);
        EXPECT_GT(clip.w, 0);
        EXPECT_TRUE(clip.z >= 0 && clip.z <= clip.w) << clip.z << " of " << clip.w;
        extent.low = glm::min(extent.low, glm::dvec2(clip) / clip.w);
        extent.high = glm::max(extent.high, glm::dvec2(clip) / clip.w);
    }
    return extent;
}

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

TEST(Framing, fills_its_share_of_the_narrower_side_and_centres_the_mesh) {
    constexpr double kFloats = 1e-4; // positions of 1e3 mm in floats
    for (const glm::vec3& size : {glm::vec3(100, 100, 100), glm::vec3(1000, 10, 20), glm::vec3(10, 700, 10), glm::vec3(5, 5, 900)})
        for (const double aspect : {1.0, 2.0, 0.5})
            for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
                const Mesh mesh = cloud(size, {400, -250, 90});
                const Extent e = onScreen(mesh, frameMesh(mesh, {0.4F, 0.2F, 0.9F}, up, 25, aspect), aspect);
                const double most = std::max({e.high.x, -e.low.x, e.high.y, -e.low.y});
                EXPECT_NEAR(most, kFramedShare, kFloats) << size.x << " " << size.y << " " << size.z << " aspect " << aspect;
                EXPECT_NEAR(e.high.x + e.low.x, 0, kFloats);
                EXPECT_NEAR(e.high.y + e.low.y, 0, kFloats) << "as much room on both sides";
            }
}

TEST(Framing, holds_up_upright) {
    const Mesh mesh = cloud({100, 100, 100}, {0, 0, 0});
    for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
        const Camera camera = frameMesh(mesh, {0.4F, 0.2F, 0.9F}, up, 25, 1);
        EXPECT_EQ(camera.up, up == UpAxis::Y ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1));
        EXPECT_GT(glm::dot(camera.position - camera.target, camera.up), 0) << "the eye looks from above";
    }
    EXPECT_EQ(alongUp(UpAxis::Z, {1, 2, 3}), glm::vec3(1, -3, 2)) << "in front is -y, up is z";
    EXPECT_EQ(alongUp(UpAxis::Y, {1, 2, 3}), glm::vec3(1, 2, 3));
}

TEST(Framing, of_a_point_or_a_flat_mesh_is_finite) {
    Mesh point;
    point.positions = {{3, 4, 5}};
    computeBounds(point);
    const Camera camera = frameMesh(point, {0, 0, 1}, UpAxis::Y, 25, 1);
    EXPECT_TRUE(std::isfinite(camera.position.x) && camera.position != camera.target);
    const Camera needle = frameMesh(cloud({0, 0, 300}, {0, 0, 0}), {0, 0, 1}, UpAxis::Y, 25, 1);
    EXPECT_TRUE(std::isfinite(needle.position.x) && needle.position.z > 150) << needle.position.z;
    const Mesh flat = cloud({0, 100, 100}, {0, 0, 0});
    const Camera edge = frameMesh(flat, {0, 0, 1}, UpAxis::Y, 25, 1);
    EXPECT_GT(edge.position.z, flat.bounds.maximum.z) << "not from within";
}

TEST(Framing, of_what_turns_holds_it_in_every_position_and_no_farther_away_than_it_must) {
    constexpr double kSlices = 0.01; // heights are cut into 256, rings into 48
    for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
        const Mesh mesh = cloud({700, 200, 60}, {400, -250, 90});
        Workspace workspace;
        workspace.camera = frameTurningMesh(mesh, {0.4F, 0.2F, 0.9F}, up, 25, 1);
        workspace.cameraRelative = workspace.lightRelative = false;
        double most = 0;
        for (int i = 0; i < 36; ++i) {
            const Workspace turned = turnedScene(workspace, glm::dvec3(mesh.bounds.centre), 2 * M_PI * i / 36);
            const Extent e = onScreen(mesh, turned.camera, 1);
            most = std::max({most, e.high.x, -e.low.x, e.high.y, -e.low.y});
        }
        EXPECT_LE(most, kFramedShare + kSlices);
        EXPECT_GE(most, kFramedShare - 0.05) << "500 points do not reach everywhere that their rings do";
    }
}

TEST(Framing, a_scene_that_turns_is_seen_as_the_mesh_that_turns) {
    constexpr double kFloats = 2e-3; // mm, of positions of 1e3 mm
    const Mesh mesh = cloud({300, 200, 100}, {40, -25, 9});
    const glm::dvec3 pivot(mesh.bounds.centre);
    Workspace workspace;
    workspace.cameraRelative = workspace.lightRelative = false;
    workspace.camera.position = {100, 50, 900};
    workspace.camera.target = {10, 20, 0};
    workspace.light.position = {-300, 600, 500};
    const double quarter = M_PI / 2;
    const Workspace turned = turnedScene(workspace, pivot, quarter);
    // The mesh turned counter-clockwise by a quarter about y: what was at +z comes to +x.
    const auto ofMesh = [&](const glm::dvec3& p) { return pivot + glm::dvec3(p.z - pivot.z, p.y - pivot.y, pivot.x - p.x); };
    const auto seen = [](const Workspace& w, const glm::dvec3& p) {
        return glm::dvec2(glm::length(p - glm::dvec3(w.camera.position)), glm::length(p - glm::dvec3(w.light.position)));
    };
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec2 expected = seen(workspace, ofMesh(glm::dvec3(position)));
        const glm::dvec2 actual = seen(turned, glm::dvec3(position));
        EXPECT_NEAR(actual.x, expected.x, kFloats);
        EXPECT_NEAR(actual.y, expected.y, kFloats);
    }
    Workspace sun = workspace;
    sun.light.direction = glm::vec3(0, -1, 1);
    EXPECT_NEAR(turnedScene(sun, pivot, quarter).light.direction->x, -1, 1e-6) << "as the camera goes: the other way";
}

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
