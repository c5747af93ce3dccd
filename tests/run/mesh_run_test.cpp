// Meshes on their way to the shader: stream, unwrap, winding, instances.
// Scenes of several objects: what they share, what is each one's own.

#include "host/run/geometry.h"
#include "tests/run/fixture.h"

#include <cmath>

namespace tegument::test {
namespace {

class Meshes : public Run {
protected:
    Result<RunResult> draw(const std::string& technique, const Mesh* mesh, int size = 16, const Workspace& workspace = closeUp()) {
        return run("mesh.fx", {.technique = technique, .width = size, .height = size, .compiler = defaultCompiler()}, mesh, workspace);
    }
};

TEST_F(Meshes, an_unwrapped_mesh_has_v_zero_in_the_top_row) {
    const Mesh mesh = square();
    const auto result = draw("Unwrap", &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0.5F / 16, 0.5F / 16, 0, 1}, 1e-6F)); // interpolation in float
    EXPECT_TRUE(pixelIs(result->image, 15, 0, {15.5F / 16, 0.5F / 16, 0, 1}, 1e-6F));
}

TEST(VertexStream, holds_zeros_for_what_a_mesh_lacks_and_any_tangent_of_length_one) {
    Mesh mesh;
    mesh.positions = {{1, 2, 3}, {4, 5, 6}};
    EXPECT_EQ(run::interleave(mesh), (std::vector<float>{1, 2, 3, 0, 0, 0, 1, 0, 0, 1, 0, 0, 4, 5, 6, 0, 0, 0, 1, 0, 0, 1, 0, 0}));
}

TEST_F(Meshes, normals_arrive) {
    Mesh mesh = square();
    mesh.normals.assign(4, {0.25F, 0.5F, 0.75F});
    const auto result = draw("Normal", &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 7, 7, {0.25F, 0.5F, 0.75F, 1}, 1e-6F));
}

TEST_F(Meshes, tangents_arrive_with_their_sign) {
    Mesh mesh = square();
    mesh.tangents.assign(4, {0.25F, 0.5F, 0.75F, -1});
    const auto result = draw("Tangent", &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 7, 7, {0.25F, 0.5F, 0.75F, -1}, 1e-6F));
}

TEST_F(Meshes, all_parts_are_drawn) {
    Mesh mesh = square();
    mesh.parts = {{.name = "a", .firstIndex = 0, .indexCount = 3}, {.name = "b", .firstIndex = 3, .indexCount = 3}};
    const auto result = draw("Unwrap", &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(0, 0, 3), 1.0F);
    EXPECT_EQ(result->image.at(15, 15, 3), 1.0F);
}

TEST_F(Meshes, counter_clockwise_triangles_face_the_camera) {
    const Mesh mesh = square();
    const auto result = draw("Front", &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(8, 8, 3), 1.0F);
}

TEST_F(Meshes, clockwise_triangles_are_culled) {
    Mesh mesh = square();
    mesh.indices = {0, 2, 1, 2, 3, 1};
    const auto result = draw("Front", &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(8, 8, 3), 0.0F);
}

TEST_F(Meshes, x_is_to_the_right_and_y_is_up_in_the_picture) {
    const Mesh mesh = square();
    const auto result = draw("Front", &mesh, 64);
    ASSERT_TRUE(succeeded(result));
    EXPECT_GT(result->image.at(38, 32, 0), result->image.at(26, 32, 0)) << "x grows to the right";
    EXPECT_GT(result->image.at(32, 26, 1), result->image.at(32, 38, 1)) << "y grows upwards, row 0 is the top";
}

TEST_F(Meshes, a_pass_draws_as_many_instances_as_its_annotation_says) {
    const Mesh mesh = square();
    const auto result = draw("Layers", &mesh);
    ASSERT_TRUE(succeeded(result));
    for (int layer = 0; layer < 4; ++layer)
        EXPECT_EQ(result->image.at(4 * layer + 1, 8, 0), layer < 3 ? static_cast<float>(layer + 1) : 0.0F) << layer;
}

TEST_F(Meshes, no_instances_draw_nothing) {
    const Mesh mesh = square();
    const auto result =
        run("mesh.fx", {.technique = "Layers", .width = 4, .height = 4, .compiler = defaultCompiler(), .parameters = {{"gLayers", {0}}}},
            &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(result->passes.empty());
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0, 0, 0, 0}));
}

TEST_F(Meshes, a_negative_number_of_instances_is_an_error) {
    const Mesh mesh = square();
    EXPECT_EQ(code(run("mesh.fx",
                       {.technique = "Layers", .width = 4, .height = 4, .compiler = defaultCompiler(), .parameters = {{"gLayers", {-1}}}},
                       &mesh)),
              4006);
}

TEST_F(Meshes, a_mesh_without_uvs_is_refused_where_a_pass_needs_them) {
    Mesh mesh = square();
    mesh.uvs.clear();
    const auto result = draw("Unwrap", &mesh);
    ASSERT_EQ(code(result), 4041);
    EXPECT_NE(format(result.error()).find("pass Uv needs them"), std::string::npos) << format(result.error());
}

TEST_F(Meshes, drawing_a_mesh_that_is_not_there_is_an_error) {
    EXPECT_EQ(code(draw("Unwrap", nullptr)), 4040);
}

TEST_F(Meshes, pictures_of_a_mesh_carry_its_name_unit_and_attribution) {
    Mesh mesh = square();
    mesh.unitMm = 25.4;
    mesh.attribution = "drawn by hand";
    const auto result = draw("Unwrap", &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.metadata.at("mesh"), "square");
    EXPECT_EQ(result->image.metadata.at("unit_mm"), "25.4");
    EXPECT_EQ(result->image.metadata.at("attribution"), "drawn by hand");
}

/// Squares of 20 mm, seen from 200 mm by a camera whose planes do not depend on what is there.
Workspace scene() {
    Workspace workspace;
    workspace.cameraRelative = workspace.lightRelative = false;
    workspace.camera = {
        .position = {0, 0, 200}, .target = {0, 0, 0}, .up = {0, 1, 0}, .horizontalFov = 30, .nearPlane = 50, .farPlane = 400};
    workspace.light.position = {30, 40, 100};
    workspace.background = {0.125F, 0.25F, 0.5F};
    return workspace;
}

RunObject object(const Mesh& mesh, const Placement& placement, std::map<std::string, std::vector<double>> parameters = {}) {
    const SceneObject source{{}, placement, {}, std::move(parameters)};
    return {.mesh = &mesh, .workspace = workspaceOf(scene(), source), .placement = placement};
}

class Scenes : public Run {
protected:
    Result<RunResult> draw(const std::vector<RunObject>& objects, const std::string& technique = "Lit",
                           const std::string& file = "objects.fx", int width = 64) {
        const auto effect = loadEffect(kFixtures / file);
        if (!effect) return effect.error();
        const int height = technique == "World" ? 1 : width;
        return runScene(*device_, *effect, objects, scene(),
                        {.technique = technique, .width = width, .height = height, .compiler = defaultCompiler()});
    }

    Mesh mesh_ = square();
};

/// Pixels that an effect has drawn: its alpha is 1, the background's is 0.
bool drawn(const Image& image, std::size_t pixel) {
    return image.pixels[4 * pixel + 3] == 1;
}

const Placement kLeft{.position = {-25, 5, 0}, .rotation = {0, 30, 10}};
const Placement kRight{.position = {25, -5, 20}, .rotation = {0, -20, 0}, .scale = glm::vec3(0.75F)};

TEST_F(Scenes, two_copies_are_the_two_single_pictures_laid_together_bit_for_bit) {
    const auto both = draw({object(mesh_, kLeft), object(mesh_, kRight)});
    const auto left = draw({object(mesh_, kLeft)});
    const auto right = draw({object(mesh_, kRight)});
    ASSERT_TRUE(succeeded(both) && succeeded(left) && succeeded(right));
    std::size_t ofLeft = 0;
    std::size_t ofRight = 0;
    for (std::size_t pixel = 0; pixel < 64 * 64; ++pixel) {
        const bool isRight = drawn(right->image, pixel);
        ofLeft += drawn(left->image, pixel) ? 1 : 0;
        ofRight += isRight ? 1 : 0;
        const Image& expected = isRight ? right->image : left->image;
        for (std::size_t c = 0; c < 4; ++c)
            ASSERT_EQ(both->image.pixels[4 * pixel + c], expected.pixels[4 * pixel + c]) << "pixel " << pixel << " channel " << c;
    }
    EXPECT_GT(ofLeft, 50U);
    EXPECT_GT(ofRight, 50U);
}

TEST_F(Scenes, the_nearer_object_hides_the_farther_whatever_their_order) {
    const RunObject far = object(mesh_, {.position = {0, 0, -50}, .scale = glm::vec3(3)}, {{"gTint", {0.5}}});
    const RunObject near = object(mesh_, {.position = {0, 0, 50}}, {{"gTint", {0.75}}});
    for (const auto& objects : {std::vector{far, near}, std::vector{near, far}}) {
        const auto result = draw(objects, "Clearing");
        ASSERT_TRUE(succeeded(result));
        EXPECT_EQ(result->image.at(32, 32, 0), 0.75F);
        EXPECT_EQ(result->image.at(32, 20, 0), 0.5F) << "beside the nearer one";
    }
}

TEST_F(Scenes, an_object_where_its_file_has_it_is_the_single_mesh_bit_for_bit) {
    const auto alone = run("objects.fx", {.technique = "Lit", .width = 64, .height = 64, .compiler = defaultCompiler()}, &mesh_, scene());
    const auto placed = draw({object(mesh_, {})});
    ASSERT_TRUE(succeeded(alone) && succeeded(placed));
    EXPECT_EQ(alone->image.pixels, placed->image.pixels);
}

TEST_F(Scenes, a_script_that_clears_the_picture_clears_it_for_the_first_object_only) {
    const auto result = draw({object(mesh_, kLeft), object(mesh_, kRight)}, "Clearing");
    const auto left = draw({object(mesh_, kLeft)}, "Clearing");
    ASSERT_TRUE(succeeded(result) && succeeded(left));
    for (std::size_t pixel = 0; pixel < 64 * 64; ++pixel)
        ASSERT_TRUE(drawn(result->image, pixel) || !drawn(left->image, pixel)) << pixel;
}

TEST_F(Scenes, neither_targets_nor_meshes_nor_textures_grow_with_the_objects) {
    Mesh painted = square();
    painted.textures.push_back({.role = "color", .image = {.width = 2, .height = 1, .channels = 4, .pixels = std::vector<float>(8, 1)}});
    const auto one = draw({object(painted, {})});
    ASSERT_TRUE(succeeded(one));
    std::vector<RunObject> many;
    for (int i = 0; i < 5; ++i)
        many.push_back(
            object(painted, {.position = {10.0F * static_cast<float>(i), 0, 0}, .rotation = {0, 5.0F * static_cast<float>(i), 0}}));
    const auto five = draw(many);
    ASSERT_TRUE(succeeded(five));
    EXPECT_EQ(five->bytes, one->bytes);
    EXPECT_EQ(five->deviceBytes, one->deviceBytes);
    EXPECT_EQ(five->targets.size(), one->targets.size());
}

TEST_F(Scenes, passes_are_reported_with_their_object) {
    const auto result = draw({object(mesh_, kLeft), object(mesh_, kRight)});
    ASSERT_TRUE(succeeded(result));
    std::string order;
    for (const PassReport& pass : result->passes)
        order += pass.name + std::to_string(pass.object) + " ";
    EXPECT_EQ(order, "Light0 Show0 Light1 Show1 ");
}

TEST_F(Scenes, each_object_has_parameters_of_its_own) {
    const auto result =
        draw({object(mesh_, {.position = {-25, 0, 0}}, {{"gTint", {0.25}}}), object(mesh_, {.position = {25, 0, 0}}, {{"gTint", {0.75}}})},
             "Clearing");
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(17, 32, 0), 0.25F);
    EXPECT_EQ(result->image.at(46, 32, 0), 0.75F);
}

TEST_F(Scenes, an_effect_of_class_scene_draws_all_objects_in_one_script) {
    const auto result = draw({object(mesh_, {.position = {-25, 0, 0}}), object(mesh_, {.position = {25, 0, 0}})}, "Once", "scene_class.fx");
    ASSERT_TRUE(succeeded(result));
    std::string order;
    for (const PassReport& pass : result->passes)
        order += pass.name + std::to_string(pass.object) + " ";
    EXPECT_EQ(order, "Quad0 All0 All1 ");
    EXPECT_EQ(result->image.at(17, 32, 0), 1.0F);
    EXPECT_EQ(result->image.at(32, 32, 0), 0.25F) << "between the two";
    EXPECT_EQ(result->image.at(46, 32, 0), 1.0F);
}

TEST_F(Scenes, points_are_scaled_then_turned_about_x_y_z_then_moved) {
    // (1, 2, 3) doubled is (2, 4, 6); about x by 90: (2, -6, 4); about y by 90: (4, -6, -2); about z by 90: (6, 4, -2); moved.
    const Placement placement{.position = {10, 20, 30}, .rotation = {90, 90, 90}, .scale = glm::vec3(2)};
    const auto result = draw({object(mesh_, placement)}, "World", "objects.fx", 5);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {16, 24, 28, 1}));
    EXPECT_TRUE(pixelIs(result->image, 1, 0, {1, 2, 3, 1}, 1e-5F)) << "floats of 30 mm have steps of 2e-6";
    EXPECT_TRUE(pixelIs(result->image, 2, 0, {0, 0, 0, 0}, 1e-3F)) << "two roundings of products around 1000";
    EXPECT_TRUE(pixelIs(result->image, 3, 0, {10, 20, 30, 2 * mesh_.bounds.radius}, 1e-4F));
}

TEST_F(Scenes, the_light_s_pyramid_aims_at_each_object) {
    const auto result = draw({object(mesh_, kLeft), object(mesh_, kRight)}, "World", "objects.fx", 5);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 4, 0, {0, 0, 0, 1}, 1e-5F)) << "the second object's centre is the middle of its light map";
}

TEST_F(Scenes, all_meshes_stand_in_the_metadata) {
    Mesh other = square();
    other.name = "other";
    other.attribution = "Somebody";
    const auto result = draw({object(mesh_, kLeft), object(other, kRight), object(mesh_, {})});
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.metadata.at("mesh"), "square; other");
    EXPECT_EQ(result->image.metadata.at("attribution"), "Somebody");
}

} // namespace
} // namespace tegument::test
