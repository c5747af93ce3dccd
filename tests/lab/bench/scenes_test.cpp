// The named scenes: what their names mean, and that their meshes are sound.
// Lights of a comparison: the same for those that draw and for the reference.

#include "host/effect/model.h"
#include "host/support/file.h"
#include "lab/bench/bench.h"
#include "lab/bench/light_set.h"
#include "lab/bench/scenes.h"
#include "lab/bench/shapes.h"
#include "lab/bench/truth.h"
#include "lab/reference/surface.h"
#include "meshprep/assets/generators.h"
#include "meshprep/write/write_mesh.h"
#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace tegument::bench {

namespace {

using namespace tegument::bench;

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

TEST(LightSet, of_lamps_is_what_effects_have_by_default) {
    const LightSet set = lightSet("lamps");
    const auto effect = loadEffect("effects/Pyramid.fx", {.defines = set.defines});
    ASSERT_TRUE(effect) << format(effect.error());
    for (const auto& [name, values] : set.parameters) {
        const auto parameter = std::ranges::find(effect->parameters, name, &Parameter::name);
        ASSERT_NE(parameter, effect->parameters.end()) << name;
        ASSERT_TRUE(parameter->defaultValue) << name;
        const auto& numbers = std::get<std::vector<double>>(*parameter->defaultValue);
        ASSERT_EQ(numbers.size(), values.size()) << name;
        if (name == "gLampAxis") continue; // of no meaning to parallel light without a penumbra
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_FLOAT_EQ(static_cast<float>(numbers[i]), static_cast<float>(values[i])) << name;
    }
}

class LitSets : public test::WithDevice {};

/// A sphere of 20 mm in key, fill, rims and studio: who draws and the reference share no line.
TEST_F(LitSets, are_drawn_as_rays_and_quadrature_see_them) {
    const auto catalogue = loadCatalogue("effects/catalogue.json");
    const auto chosen = choose(*catalogue, {"Lambert", "PyramidLinked", "Separable17"}, {"corrected"});
    ASSERT_TRUE(chosen);
    BenchOptions options{.effects = "effects",
                         .sceneFolder = std::filesystem::temp_directory_path() / ("tegument-lights-" + std::to_string(::getpid())),
                         .scenes = {"sphere-20"},
                         .width = 64,
                         .height = 64,
                         .mapSizes = {256},
                         .frames = {.warmUp = 0, .timed = 1},
                         .compiler = defaultCompiler(),
                         .pixels = 12,
                         .assets = assets::meshAssets([](const std::string&) {})};
    for (const std::string& name : lightSetNames()) {
        options.lights = name;
        const auto rows = runBench(*device_, *chosen, options, {.say = [](const std::string&) {}, .flip = nullptr});
        ASSERT_TRUE(rows) << format(rows.error());
        for (const Row& row : *rows) {
            ASSERT_FALSE(row.failure) << format(*row.failure);
            // Measured: 0.4 % with lamps; 2.2 % of the studio alone, of which more is mirrored, by lobes of an eye on the normal.
            EXPECT_LT(row.errors.relativeL2, name == "surroundings" ? 0.025 : 0.02) << name << " " << row.contender.name();
        }
    }
    std::filesystem::remove_all(options.sceneFolder);
}

TEST(Parts, count_from_one) {
    EXPECT_EQ(partOf("3/100")->index, 3U);
    for (const char* wrong : {"", "3", "0/4", "5/4", "-1/4", "1/0", "a/b", "1/4x", "1 / 4", "1//4"})
        EXPECT_EQ(partOf(wrong) ? 0 : partOf(wrong).error().diagnostics.at(0).code, 8101) << wrong;
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

} // namespace tegument::bench
