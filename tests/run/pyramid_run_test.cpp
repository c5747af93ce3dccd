// effects/Pyramid.fx on a sphere: what its techniques draw of the same scene.

#include "host/image/compare.h"
#include "host/run/read_back.h"
#include "host/run/session.h"
#include "tests/run/fixture.h"
#include "tests/run/sphere.h"
#include "tests/spirv/missing.h"

#include <algorithm>

namespace tegument::test {
namespace {

class PyramidRun : public Run, public testing::WithParamInterface<Compiler> {
protected:
    void SetUp() override {
        Run::SetUp();
        if (const std::string missing = compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    }

    Result<RunResult> draw(const std::string& technique, int mapSize, double coarse, int samples = 1) {
        const auto effect =
            loadEffect("effects/Pyramid.fx", {.defines = {{"TEGUMENT_MAP_SIZE", std::to_string(mapSize)}}, .includeFolders = {}});
        if (!effect) return effect.error();
        const Mesh mesh = sphere();
        return runEffect(*device_, *effect, &mesh, closeUp(),
                         {.technique = technique,
                          .width = 96,
                          .height = 96,
                          .samples = samples,
                          .compiler = GetParam(),
                          .parameters = {{"gCoarseLevels", {coarse}}},
                          .plainSkin = std::array{0.8F, 0.6F, 0.5F, 1.0F}});
    }
};

// The computed one takes mesh normals and tangents from maps of half floats, and filters its maps as wide along u as along v.
TEST_P(PyramidRun, the_computed_picture_is_the_drawn_one) {
    for (const auto& [mapSize, coarse] : {std::pair(128, 1), std::pair(512, 0), std::pair(1024, 0)}) {
        const auto drawn = draw("PyramidLinked", mapSize, coarse);
        const auto computed = draw("PyramidCompute", mapSize, coarse);
        ASSERT_TRUE(succeeded(drawn) && succeeded(computed));
        const auto difference = compareImages(computed->image, drawn->image);
        ASSERT_TRUE(succeeded(difference));
        EXPECT_LT(difference->relativeL2, 2e-3) << mapSize;
        EXPECT_GT(drawn->image.at(48, 48, 0), 0.05F) << "there is something to see";
    }
}

TEST_P(PyramidRun, the_computed_picture_has_one_sample_a_pixel) {
    EXPECT_EQ(code(draw("PyramidCompute", 128, 1, 4)), 4039);
}

TEST_P(PyramidRun, under_light_that_stands_still_the_light_of_the_picture_before_serves_another_camera) {
    const auto effect = loadEffect("effects/Pyramid.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}, .includeFolders = {}});
    ASSERT_TRUE(succeeded(effect));
    const Mesh mesh = sphere();
    Workspace moved = closeUp();
    moved.camera.position += glm::vec3(0.4F, 0.2F, 0.3F);
    for (const char* technique : {"Pyramid", "PyramidLinked", "PyramidCompute"}) {
        const auto options = [&](double relight) {
            return RunOptions{.technique = technique,
                              .width = 96,
                              .height = 96,
                              .compiler = GetParam(),
                              .parameters = {{"gRelight", {relight}}},
                              .plainSkin = std::array{0.8F, 0.6F, 0.5F, 1.0F}};
        };
        EffectSession session(*device_, *effect, SessionScene{.mesh = &mesh, .objects = {}});
        ASSERT_TRUE(succeeded(session.draw(closeUp(), options(1))));
        const auto rest = session.draw(moved, options(0));
        ASSERT_TRUE(succeeded(rest));
        EXPECT_LE(rest->passes.size(), 2U) << technique;
        EXPECT_TRUE(std::ranges::none_of(rest->warnings, [](const Diagnostic& warning) { return warning.code == 4026; })) << technique;
        const auto kept = run::readBack(*device_, *session.target(""));
        ASSERT_TRUE(succeeded(session.draw(moved, options(1))));
        const auto anew = run::readBack(*device_, *session.target(""));
        ASSERT_TRUE(succeeded(kept) && succeeded(anew));
        EXPECT_EQ(kept->pixels, anew->pixels) << technique;
        EXPECT_GT(*std::ranges::max_element(anew->pixels), 0.05F) << "there is something to see";
    }
}

INSTANTIATE_TEST_SUITE_P(Compilers, PyramidRun, testing::Values(Compiler::Dxc, Compiler::Glslang), compilerTestName);

} // namespace
} // namespace tegument::test
