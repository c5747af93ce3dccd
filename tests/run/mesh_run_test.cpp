// Meshes on their way to the shader: stream, unwrap, winding, instances.

#include "host/run/geometry.h"
#include "tests/run/fixture.h"

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

} // namespace
} // namespace tegument::test
