// The named scenes: what their names mean, and that their meshes are sound.

#include "host/support/file.h"
#include "lab/bench/scenes.h"
#include "lab/bench/shapes.h"
#include "lab/reference/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <unistd.h>

using namespace tegument;
using namespace tegument::bench;

namespace {

namespace fs = std::filesystem;

/// A folder that is gone after the test.
class Scenes : public testing::Test {
protected:
    Scenes() : folder_(fs::temp_directory_path() / ("tegument-scenes-" + std::to_string(::getpid()))) {}
    ~Scenes() override {
        std::error_code code;
        fs::remove_all(folder_, code);
    }
    [[nodiscard]] SceneOptions options(int width = 200, int height = 100) const {
        return {.effects = "effects", .folder = folder_, .width = width, .height = height};
    }
    fs::path folder_;
};

double areaOf(const Mesh& mesh) {
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
        area += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
    return area;
}

/// Triangles that are turned away from the mean of their normals.
int turnedAway(const Mesh& mesh) {
    int count = 0;
    for (std::uint32_t triangle = 0; 3 * triangle < mesh.indices.size(); ++triangle) {
        glm::dvec3 normal(0);
        for (std::size_t k = 0; k < 3; ++k)
            normal += glm::dvec3(mesh.normals[mesh.indices[3 * triangle + k]]);
        count += glm::dot(reference::faceNormal(mesh, triangle), normal) < 0 ? 1 : 0;
    }
    return count;
}

int codeOf(const Error& error) {
    return error.diagnostics.front().code;
}

} // namespace

TEST(SceneNames, may_be_plain) {
    const auto name = parseSceneName("sphere-10");
    ASSERT_TRUE(name);
    EXPECT_EQ(name->shape, "sphere-10");
    EXPECT_FALSE(name->light || name->shadow || name->bumps || name->checker || name->pixelsPerMm);
}

TEST(SceneNames, carry_light_and_variants_in_any_order) {
    const auto name = parseSceneName("head+checker@90+4px+bumps+shadow");
    ASSERT_TRUE(name);
    EXPECT_EQ(name->shape, "head");
    EXPECT_EQ(name->light, 90);
    EXPECT_EQ(name->pixelsPerMm, 4);
    EXPECT_TRUE(name->checker && name->bumps && name->shadow);
}

TEST(SceneNames, behind_is_165_degrees) {
    EXPECT_EQ(parseSceneName("head@behind")->light, 165);
}

TEST(SceneNames, that_are_unknown_are_refused_with_the_list) {
    const auto name = parseSceneName("spere-10");
    ASSERT_FALSE(name);
    EXPECT_EQ(codeOf(name.error()), 8072);
    EXPECT_NE(name.error().diagnostics.front().hint.find("sphere-10"), std::string::npos);
}

TEST(SceneNames, with_an_impossible_variant_are_refused) {
    for (const char* text :
         {"sphere-5@", "sphere-5@181", "sphere-5@ahead", "sphere-5+", "sphere-5+px", "sphere-5+0px", "sphere-5+hair", "plane-edge@0"}) {
        const auto name = parseSceneName(text);
        ASSERT_FALSE(name) << text;
        EXPECT_EQ(codeOf(name.error()), 8073) << text;
    }
}

TEST(Shapes, spheres_have_the_area_of_spheres) {
    const double exact = 4 * std::numbers::pi * 100;
    EXPECT_NEAR(areaOf(sphere(10)) / exact, 1, 1e-3) << "facets of 2 degrees lie a few ten-thousandths inside";
}

TEST(Shapes, face_outwards_everywhere) {
    for (const Mesh& mesh : {planeWithEdge(45), planeWithDisc(45), sphere(5), cylinder(), lobes()})
        EXPECT_EQ(turnedAway(mesh), 0) << mesh.name;
}

TEST(Shapes, have_charts_inside_the_texture_that_do_not_overlap) {
    for (const Mesh& mesh : {planeWithEdge(45), planeWithEdge(15), planeWithDisc(45), sphere(5), cylinder(), lobes()}) {
        const UvReport report = examineUvs(mesh);
        EXPECT_EQ(report.outside, 0) << mesh.name;
        EXPECT_LT(report.overlapping, 1e-3) << mesh.name;
    }
}

TEST(Shapes, a_bar_takes_free_texels_only) {
    for (Mesh mesh : {sphere(5), cylinder(), lobes(), planeWithEdge(45)}) {
        ASSERT_TRUE(addBar(mesh, {1, 0, 1})) << mesh.name;
        EXPECT_LT(examineUvs(mesh).overlapping, 1e-3) << mesh.name;
    }
}

TEST_F(Scenes, with_a_bar_and_tangents_of_its_own_can_be_read) {
    Mesh mesh = sphere(5);
    computeTangents(mesh);
    ASSERT_TRUE(addBar(mesh, {1, 0, 1}));
    ASSERT_TRUE(writeGlb(folder_ / "bar.glb", mesh));
    const auto read = loadMesh(folder_ / "bar.glb", {.unitMm = 1000});
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->tangents.size(), read->positions.size());
}

TEST_F(Scenes, are_ordinary_workspace_files) {
    const auto made = loadScene("sphere-5@0+checker", options());
    ASSERT_TRUE(made) << format(made.error());
    const auto again = loadScene(made->file.string(), options());
    ASSERT_TRUE(again) << format(again.error());
    EXPECT_EQ(again->mesh.positions, made->mesh.positions);
    EXPECT_EQ(again->workspace.light.position, made->workspace.light.position);
    EXPECT_NEAR(made->mesh.bounds.radius, 5, 1e-3);
}

TEST_F(Scenes, have_the_pixels_to_the_millimetre_that_their_name_says) {
    const auto scene = loadScene("sphere-10+8px", options());
    ASSERT_TRUE(scene) << format(scene.error());
    const double across = 2 * 600 * std::tan(glm::radians(static_cast<double>(scene->workspace.camera.horizontalFov)) / 2);
    EXPECT_NEAR(200 / across, 8, 1e-4);
}

TEST_F(Scenes, a_light_stands_at_its_angle_from_the_camera) {
    const auto scene = loadScene("lobes@120", options());
    ASSERT_TRUE(scene) << format(scene.error());
    const auto camera = glm::normalize(glm::dvec3(scene->workspace.camera.position));
    const auto light = glm::normalize(glm::dvec3(scene->workspace.light.position));
    EXPECT_NEAR(glm::degrees(std::acos(glm::dot(camera, light))), 120, 1e-4);
}

/// Rays from the light, not a picture: where the shadow of the block ends.
TEST_F(Scenes, the_edge_of_the_plane_lies_at_x_0) {
    for (const char* name : {"plane-edge", "plane-edge@60"}) {
        const auto scene = loadScene(name, options());
        ASSERT_TRUE(scene) << format(scene.error());
        const reference::RayScene rays(scene->mesh);
        const glm::dvec3 light(scene->workspace.light.position);
        EXPECT_FALSE(rays.reaches(light, {-0.5, 0, 0}, 0.01)) << name;
        EXPECT_TRUE(rays.reaches(light, {0.5, 0, 0}, 0.01)) << name;
    }
}

TEST_F(Scenes, light_falls_through_the_hole_around_the_origin) {
    const auto scene = loadScene("plane-disc", options());
    ASSERT_TRUE(scene) << format(scene.error());
    const reference::RayScene rays(scene->mesh);
    const glm::dvec3 light(scene->workspace.light.position);
    EXPECT_TRUE(rays.reaches(light, {0, 0, 0}, 0.01));
    EXPECT_TRUE(rays.reaches(light, {0, 3.5, 0}, 0.01));
    EXPECT_FALSE(rays.reaches(light, {0, 5, 0}, 0.01));
    EXPECT_FALSE(rays.reaches(light, {6, 0, 0}, 0.01));
}

TEST_F(Scenes, of_several_objects_are_refused) {
    const auto scene = loadScene("effects/workspaces/two_heads.json", options());
    ASSERT_FALSE(scene);
    EXPECT_TRUE(codeOf(scene.error()) == 8074 || codeOf(scene.error()) / 100 == 54) << "or the head was not made on this machine";
}
