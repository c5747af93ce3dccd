// Fur where it is hard: no value that is not finite, no hole, no light out of nothing.

#include "host/image/dds.h"
#include "lab/measure/flat_fur.h"
#include "lab/verify/fur_scene.h"
#include "tests/lab/verify/fur_fixture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>

using namespace tegument;
using namespace tegument::test;

namespace {

namespace fs = std::filesystem;

class Fur : public FurPictures {
protected:
    void SetUp() override {
        Verify::SetUp();
        if (IsSkipped()) return;
        scene_ = verify::furTorus({});
        folder_ = fs::temp_directory_path() / ("tegument-fur-test-" + std::to_string(::getpid()));
        DdsTexture cube{.format = DdsFormat::Rgba8, .faces = 6, .mips = 1};
        for (int face = 0; face < 6; ++face)
            cube.images.push_back(verify::furPattern(32, face));
        const auto written = writeDds(folder_ / "cube.dds", cube);
        ASSERT_TRUE(written) << format(written.error());
        scene_.scene.workspace.textures["gFurCubeMap"] = (folder_ / "cube.dds").string();
        scene_.scene.workspace.background = glm::vec3(0);
    }
    void TearDown() override {
        std::error_code code;
        if (!folder_.empty()) fs::remove_all(folder_, code);
        Verify::TearDown();
    }

    Mesh& mesh() { return scene_.scene.mesh; }
    Workspace& workspace() { return scene_.scene.workspace; }

    /// The torus as verify draws it, with these parameters instead.
    Image draw(const Parameters& parameters = {}, int size = 96) {
        const auto effect = loadEffect("effects/Fur.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "256"}}});
        EXPECT_TRUE(effect) << format(effect.error());
        RunOptions options{.technique = "CubePosition", .width = size, .height = size, .compiler = defaultCompiler()};
        options.parameters = verify::parametersOf(scene_.coat);
        return effect ? drawn(*effect, scene_.scene, std::move(options), parameters) : Image{};
    }

    verify::FurScene scene_;
    fs::path folder_;
};

/// Largest difference of the first three channels.
float distance(const Image& a, const Image& b) {
    float largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        if (i % 4 != 3) largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
    return largest;
}

void scale(Mesh& mesh, float factor) {
    for (glm::vec3& position : mesh.positions)
        position *= factor;
    computeBounds(mesh);
}

const Parameters kWhite = {{"gFurRootColor", {1, 1, 1}}, {"gFurTipColor", {1, 1, 1}}, {"gFurSpecular", {0}}, {"gFurFill", {0, 0, 0}}};

} // namespace

TEST_F(Fur, a_coat_without_length_covers_what_the_mesh_covers) {
    const Image bare = draw({{"gFurLayers", {1}}, {"gFurAlphaTest", {1}}}); // no layer passes: the skin alone
    const Image flat = draw({{"gFurLength", {0}}});
    EXPECT_GT(covered(bare), 1000U);
    EXPECT_EQ(covered(flat), covered(bare));
}

TEST_F(Fur, one_layer_is_drawn_at_the_coat_s_full_height) {
    const Parameters full = {{"gFurTaper", {0}}, {"gFurLean", {0}}, {"gFurLayers", {1}}};
    Parameters bare = full;
    bare["gFurAlphaTest"] = {1};
    EXPECT_GT(covered(draw(full)), covered(draw(bare)) * 21 / 20);
}

TEST_F(Fur, layers_add_up_to_a_picture_that_more_of_them_hardly_change) {
    const Image many = draw({{"gFurLayers", {256}}}, 48);
    const Image most = draw({{"gFurLayers", {512}}}, 48);
    EXPECT_NEAR(mean(many), mean(most), 0.01 * mean(most)) << "missed tips go with one over the layers";
}

TEST_F(Fur, zero_length_normals_leave_their_vertices_where_they_are) {
    const std::size_t before = covered(draw());
    for (std::size_t i = 0; i < mesh().normals.size(); i += 7)
        mesh().normals[i] = glm::vec3(0);
    const std::size_t after = covered(draw());
    EXPECT_LE(after, before);
    EXPECT_GT(after, before * 3 / 4);
}

TEST_F(Fur, normals_of_zero_everywhere_show_the_bare_mesh) {
    const std::size_t bare = covered(draw({{"gFurLength", {0}}}));
    std::ranges::fill(mesh().normals, glm::vec3(0));
    EXPECT_EQ(covered(draw({{"gFurLean", {0}}})), bare);
}

TEST_F(Fur, meshes_a_thousandth_and_a_million_in_size_look_alike) {
    const Image usual = draw();
    for (const float factor : {1e-3F / 80, 1e6F / 80}) {
        Mesh sized = mesh();
        std::swap(sized, mesh());
        scale(mesh(), factor);
        const Image picture = draw();
        EXPECT_NEAR(mean(picture), mean(usual), 1e-3 * mean(usual)) << factor; // rounding moves outlines and the alpha test
        std::swap(sized, mesh());
    }
}

TEST_F(Fur, fins_flipped_faces_and_triangles_without_area_are_drawn) {
    const Image whole = draw();
    addHardFaces(mesh());
    EXPECT_GE(covered(draw()), covered(whole));
}

TEST_F(Fur, from_inside_the_coat_the_picture_is_finite_and_not_empty) {
    workspace().cameraRelative = false;
    const float radius = mesh().bounds.radius;
    for (const float height : {0.2F, 0.5F, 0.99F}) { // of a coat that is 0.3 of the radius high, above the torus' outer equator
        workspace().camera.position = {82 + 0.3F * radius * height, 0, 0};
        workspace().camera.target = {60, 0, 40};
        EXPECT_GT(covered(draw({{"gFurLength", {0.3}}})), 500U) << height;
    }
}

TEST_F(Fur, a_white_coat_is_never_brighter_than_the_light) {
    workspace().light.color = glm::vec3(1);
    for (const double multiple : {0.0, 0.7, 1.0}) {
        Parameters white = kWhite;
        white["gFurMultiple"] = {multiple};
        EXPECT_LE(brightest(draw(white)), 1 + 1e-5F) << multiple; // sums of weights in 32-bit floats
    }
}

TEST_F(Fur, a_white_coat_under_light_from_all_sides_is_never_brighter_than_that) {
    workspace().light.color = glm::vec3(0);
    Parameters white = kWhite;
    white["gFurFill"] = {1, 1, 1};
    for (const double multiple : {0.0, 0.5, 1.0}) {
        white["gFurMultiple"] = {multiple};
        EXPECT_LE(brightest(draw(white)), 1 + 1e-5F) << multiple;
    }
}

TEST_F(Fur, without_light_is_black) {
    workspace().light.color = glm::vec3(0);
    EXPECT_EQ(brightest(draw({{"gFurFill", {0, 0, 0}}})), 0);
}

TEST_F(Fur, opaque_layers_give_the_same_picture_in_both_orders) {
    // With a sharp end of strands every layer is there or not: whichever is drawn first, the outermost hides the others.
    Parameters sharp = {{"gFurSoftness", {0}}, {"gFurAlphaTest", {0.5}}};
    const Image inner = draw(sharp);
    sharp["gFurOuterFirst"] = {1};
    const Image outer = draw(sharp);
    EXPECT_LT(std::abs(mean(inner) - mean(outer)), 2e-3 * mean(inner)); // where a coverage is neither 0 nor 1 the former blends
    EXPECT_EQ(covered(inner), covered(outer));
}

TEST_F(Fur, its_coat_throws_shadows_on_other_parts_and_lights_none) {
    workspace().light.position = {-6, 1.5F, 0};
    const Image without = draw();
    const Image with = draw({{"gFurShadow", {1}}});
    EXPECT_LT(mean(with), 0.99 * mean(without)) << "the far side of the hole is behind the near one";
    for (std::size_t i = 0; i < with.pixels.size(); ++i)
        ASSERT_LE(with.pixels[i], without.pixels[i] + 1e-6F);
}

TEST_F(Fur, a_ball_s_coat_throws_no_shadow_on_itself) {
    scene_.scene.mesh = verify::furBall({}).scene.mesh;
    const Image without = draw();
    EXPECT_NEAR(mean(draw({{"gFurShadow", {1}}})), mean(without), 1e-3 * mean(without)); // single strands near the terminator
}

TEST_F(Fur, keeps_its_light_from_afar_by_the_deviation_of_its_heights) {
    Parameters parameters = {{"gFurLayers", {32}}, {"gFurSoftness", {0.2}}, {"gFurGrain", {0.075}}}; // 1.66 texels of furPattern(32)
    const Image strands = draw(parameters, 512); // whose pixels are finer than the map's texels
    const auto lost = [&](double deviation) {
        parameters["gFurDeviation"] = {deviation};
        return std::abs(mean(draw(parameters, 24)) / mean(strands) - 1);
    };
    EXPECT_LT(lost(0.192), 0.05);
    EXPECT_GT(lost(0), 0.06);
}

TEST_F(Fur, is_the_same_in_every_run) {
    EXPECT_EQ(distance(draw(), draw()), 0);
}

TEST_F(Fur, every_slider_s_ends_leave_the_picture_finite) {
    EXPECT_GE(atSliderEnds("effects/Fur.fx", [&](const Parameters& end) { draw(end, 48); }), 24U);
}

using FullFur = Verify;

TEST_F(FullFur, shells_of_the_effect_follow_the_law_where_it_gives_a_hundredth_to_a_tenth) {
    auto flat = measure::FlatFur::create(*device_, {});
    ASSERT_TRUE(flat) << format(flat.error());
    int cases = 0;
    for (const double degrees : {45.0, 70.0})
        for (const int layers : {16, 32, 64}) {
            const double law = 0.27 * 4 * std::tan(glm::radians(degrees)) / layers;
            if (law < 0.012 || law > 0.1) continue;
            const reference::FurView view{.tilt = glm::radians(degrees), .pixel = 0.25, .size = 16, .samples = 4};
            const auto drawn = flat->draw(view, layers);
            ASSERT_TRUE(drawn) << format(drawn.error());
            EXPECT_NEAR(reference::furError(*drawn, flat->truth(view)).rms / law, 1, 0.3) << degrees << " degrees, " << layers << " layers";
            ++cases;
        }
    EXPECT_GE(cases, 4);
}
