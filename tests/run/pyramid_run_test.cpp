// effects/Pyramid.fx on a sphere: what its techniques draw of the same scene.

#include "host/image/compare.h"
#include "tests/run/fixture.h"
#include "tests/run/sphere.h"
#include "tests/spirv/missing.h"

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

std::string nameOf(const testing::TestParamInfo<Compiler>& info) {
    return info.param == Compiler::Dxc ? "dxc" : "glslang";
}

INSTANTIATE_TEST_SUITE_P(Compilers, PyramidRun, testing::Values(Compiler::Dxc, Compiler::Glslang), nameOf);

} // namespace
} // namespace tegument::test
