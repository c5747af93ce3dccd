// Strands on the surface where it is hard: no value that is not finite, no light out of nothing. And on a ball, beside exact rays.

#include "host/image/dds.h"
#include "lab/measure/body_fur.h"
#include "lab/verify/corner_grid.h"
#include "lab/verify/fur_exact.h"
#include "lab/verify/fur_roots_scene.h"
#include "lab/verify/fur_scene.h"
#include "tests/lab/verify/fur_fixture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <unistd.h>

using namespace tegument;
using namespace tegument::test;

namespace {

namespace fs = std::filesystem;

/// Each test with both techniques. What is drawn is small.
class FurRoots : public FurPictures, public testing::WithParamInterface<const char*> {
protected:
    static constexpr int kSize = 48;

    void SetUp() override {
        Verify::SetUp();
        if (IsSkipped()) return;
        file_ = fs::temp_directory_path() / ("tegument-fur-roots-test-" + std::to_string(::getpid()) + ".dds");
        grow({.mapSize = 64, .pictureSize = 2 * kSize}); // strands 1.5 pixels apart
        workspace().background = glm::vec3(0);
    }
    void TearDown() override {
        std::error_code code;
        if (!file_.empty()) fs::remove(file_, code);
        Verify::TearDown();
    }

    void grow(const VerifyOptions& options) {
        auto scene = verify::strandsNearBy(options, GetParam());
        ASSERT_TRUE(scene) << format(scene.error());
        scene_ = std::move(*scene);
        if (scene_.roots.pixels.empty()) return;
        const auto written = writeDds(file_, makeDds(scene_.roots, DdsFormat::Rgba32F, false));
        ASSERT_TRUE(written) << format(written.error());
        workspace().textures["gFurRootsMap"] = file_.string();
    }

    Mesh& mesh() { return scene_.scene.mesh; }
    Workspace& workspace() { return scene_.scene.workspace; }

    /// The torus as verify draws it, with these parameters instead.
    Image draw(const Parameters& parameters = {}, int size = kSize) {
        const auto effect = loadEffect("effects/FurRoots.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
        EXPECT_TRUE(effect) << format(effect.error());
        RunOptions options{.technique = GetParam(), .width = size, .height = size, .compiler = defaultCompiler()};
        options.parameters = parametersOf(scene_);
        return effect ? drawn(*effect, scene_.scene, std::move(options), parameters) : Image{};
    }

    verify::StrandsScene scene_;
    fs::path file_;
};

const auto kTechnique = [](const auto& each) { return std::string(each.param); };

const Parameters kWhiteStrands = {{"gFurRootColor", {1, 1, 1}}, {"gFurTipColor", {1, 1, 1}}, {"gFurSpecular", {0}},
                                  {"gFurVariation", {0}},       {"gFurMultiple", {1}},       {"gFurFill", {0, 0, 0}}};

} // namespace

INSTANTIATE_TEST_SUITE_P(Technique, FurRoots, testing::Values("Cellular", "Roots"), kTechnique);

TEST_P(FurRoots, a_coat_without_length_covers_what_the_mesh_covers) {
    const Image none = draw({{"gFurLength", {0}}});
    const Image bald = draw({{"gFurLength", {0}}, {"gFurRadius", {0}}});
    EXPECT_GT(covered(bald), 200U);
    EXPECT_EQ(covered(none), covered(bald));
}

TEST_P(FurRoots, one_layer_sweeps_the_whole_coat) {
    // Longer segments than the steps of a sweep reach end in coverage to expect: the coat is as bright, if not as sharp.
    const Image one = draw({{"gFurLayers", {1}}});
    const Image many = draw({{"gFurLayers", {64}}, {"gFurFewest", {64}}});
    EXPECT_GT(covered(one), covered(draw({{"gFurLength", {0}}})));
    EXPECT_NEAR(mean(one), mean(many), 0.3 * mean(many)); // tufts, curls and lean are straight within one layer
}

TEST_P(FurRoots, zero_length_normals_leave_the_coat_around_them) {
    const std::size_t before = covered(draw());
    for (std::size_t i = 0; i < mesh().normals.size(); i += 7)
        mesh().normals[i] = glm::vec3(0);
    const std::size_t after = covered(draw());
    EXPECT_LT(after, before * 5 / 4);
    EXPECT_GT(after, before * 3 / 4);
}

TEST_P(FurRoots, normals_of_zero_everywhere_show_the_bare_mesh) {
    const std::size_t bare = covered(draw({{"gFurLength", {0}}}));
    std::ranges::fill(mesh().normals, glm::vec3(0));
    // Combed roots lean all the same: tips stand aside of where they grow.
    EXPECT_NEAR(static_cast<double>(covered(draw({{"gFurLean", {0}}}))), static_cast<double>(bare), 0.02 * static_cast<double>(bare));
}

TEST_P(FurRoots, fins_flipped_faces_and_triangles_without_area_are_drawn) {
    const std::size_t whole = covered(draw());
    addHardFaces(mesh());
    EXPECT_GE(covered(draw()), whole);
}

TEST_P(FurRoots, from_inside_the_coat_the_picture_is_finite_and_not_empty) {
    workspace().cameraRelative = false;
    const float radius = mesh().bounds.radius;
    for (const float height : {0.2F, 0.99F}) { // of a coat that is 0.3 of the radius high, above the torus' outer equator
        workspace().camera.position = {82 + 0.3F * radius * height, 0, 0};
        workspace().camera.target = {60, 0, 40};
        EXPECT_GT(covered(draw({{"gFurLength", {0.3}}})), 100U) << height;
    }
}

TEST_P(FurRoots, a_white_coat_is_never_brighter_than_the_light) {
    workspace().light.color = glm::vec3(1);
    EXPECT_LE(brightest(draw(kWhiteStrands)), 1 + 1e-5F); // sums of weights in 32-bit floats
}

TEST_P(FurRoots, a_white_coat_under_light_from_all_sides_is_never_brighter_than_that) {
    workspace().light.color = glm::vec3(0);
    Parameters white = kWhiteStrands;
    white["gFurFill"] = {1, 1, 1};
    EXPECT_LE(brightest(draw(white)), 1 + 1e-5F);
}

TEST_P(FurRoots, without_light_is_black) {
    workspace().light.color = glm::vec3(0);
    EXPECT_EQ(brightest(draw({{"gFurFill", {0, 0, 0}}})), 0);
}

TEST_P(FurRoots, every_slider_s_ends_leave_the_picture_finite) {
    EXPECT_GE(atSliderEnds("effects/FurRoots.fx", [&](const Parameters& end) { draw(end, 16); }), 40U);
}

TEST_P(FurRoots, meshes_a_thousandth_and_a_million_in_size_look_alike) {
    const double usual = mean(draw());
    const Mesh torus = mesh();
    const Workspace around = workspace();
    for (const float factor : {1e-3F / 80, 1e6F / 80}) {
        Mesh sized = torus;
        for (glm::vec3& position : sized.positions)
            position *= factor;
        computeBounds(sized);
        grow({.mapSize = 64, .pictureSize = 2 * kSize, .mesh = &sized, .workspace = &around});
        EXPECT_NEAR(mean(draw()), usual, 0.03 * usual) << factor; // rounding moves outlines, and roots from one place to the next
    }
}

/// Exact strands on what is no body of formulas.
class FurOnScan : public Verify {
protected:
    static Mesh bunny() {
        const char* const file = "/usr/share/glmark2/models/bunny.obj"; // Debian's glmark2-data
        if (!fs::exists(file)) return {};
        auto mesh = loadMesh(file, {.unitMm = 75});
        EXPECT_TRUE(mesh) << format(mesh.error());
        return mesh ? std::move(*mesh) : Mesh{};
    }
};

TEST_F(FurOnScan, the_bunny_s_strands_are_where_exact_ones_are) {
    const Mesh mesh = bunny();
    if (mesh.positions.empty()) GTEST_SKIP() << "no bunny.obj: install Debian's glmark2-data";
    const Workspace workspace;
    const VerifyOptions options{.compiler = defaultCompiler(), .mapSize = 256, .pictureSize = 128, .mesh = &mesh, .workspace = &workspace};
    ModuleReport report{.module = "FurRoots"};
    const auto judged = verify::judgeStrands(report, {*device_, options});
    ASSERT_TRUE(judged) << format(judged.error());
    expectPass(report);
    EXPECT_EQ(report.metrics.size(), 6U); // of both techniques
}

/// Minutes of paths where the cache has none.
class FullFibres : public FurOnScan {};

TEST_F(FullFibres, of_the_bunny_are_lit_as_paths_of_light_say) {
    const Mesh mesh = bunny();
    if (mesh.positions.empty()) GTEST_SKIP() << "no bunny.obj: install Debian's glmark2-data";
    const VerifyOptions options{.compiler = defaultCompiler(), .mapSize = 512, .pictureSize = 384, .mesh = &mesh};
    ModuleReport report{.module = "FurCoat"};
    const auto judged = verify::judgeFibres(report, {*device_, options});
    ASSERT_TRUE(judged) << format(judged.error());
    expectPass(report);
    EXPECT_EQ(report.metrics.size(), 20U); // four of each phase
}

TEST_F(Verify, a_device_s_corners_are_exact_or_on_a_grid_that_explains_them) {
    const VerifyOptions options{.compiler = defaultCompiler()};
    const auto grid = verify::measureCornerGrid({*device_, options});
    ASSERT_TRUE(grid) << format(grid.error());
    // Places are 32-bit floats of up to 64 pixels, interpolated by a few operations: 1e-5 pixels at most. Vulkan asks for 4 bits at least.
    EXPECT_LT(grid->remaining, 2e-5);
    EXPECT_LE(grid->step, 1.0 / 16);
    if (grid->step == 0) {
        EXPECT_EQ(grid->remaining, grid->exact);
    }
}

using FurOnBall = Verify;

TEST_F(FurOnBall, few_layers_show_straight_strands_as_exact_rays_meet_them) {
    // Figures for more tilts, layers, and a torus: docs/design/fur-layers.md, "Against exact strands".
    const auto fur = measure::BodyFur::create(*device_, {.radius = 1}, {.spacing = 0.04, .length = 0.12});
    ASSERT_TRUE(fur) << format(fur.error());
    const measure::BodyView view{.tilt = std::numbers::pi / 3, .size = 24, .samples = 4};
    const auto truth = fur->truth(view, reference::FurShape::Cones);
    for (const int layers : {4, 16}) {
        const auto drawn = fur->draw(view, layers, layers);
        ASSERT_TRUE(drawn) << format(drawn.error());
        const auto error = measure::bodyError(*drawn, truth, view);
        // Sections carried by the skin instead of cones: 0.02 of that. The rest is one sample to a pixel of an eighth of a spacing.
        EXPECT_LT(error.rms, 0.06) << layers;
        EXPECT_LT(std::abs(error.bias), 0.04) << layers;
    }
}
