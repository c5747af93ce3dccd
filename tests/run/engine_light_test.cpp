// The light hook of effects/passes/engine_light.fxh, by the engine of docs/samples/lights: its sun and its cascades light every technique.

#include "host/run/program.h"
#include "tests/check/hook_example.h"
#include "tests/run/fixture.h"
#include "tests/run/sheet.h"

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr int kSunPicture = 64;

struct Sunlit {
    const char* effect;
    const char* technique;
};

constexpr Sunlit kSunlit[] = {{"Main.fx", "Lambert"},         {"Main.fx", "DEonLuebke"},   {"Main.fx", "Gosselin"},
                              {"Specular.fx", "Specular"},    {"SkinPost.fx", "SkinPost"}, {"peers/Separable.fx", "Separable7"},
                              {"peers/Burley.fx", "Burley20"}};

class EngineLight : public Run, public testing::WithParamInterface<Sunlit> {
protected:
    void SetUp() override {
        Run::SetUp();
        if (IsSkipped()) return;
        mesh_ = reliefSheet();
        const auto text = readFile("docs/samples/lights/Lights.fx");
        ASSERT_TRUE(text);
        text_ = *text;
        // The left half, of the first cascade, is open as far as its depth goes; in the right half something stands before everything.
        atlas_ = fs::temp_directory_path() / ("tegument-atlas-" + std::to_string(::getpid()) + ".exr");
        Image atlas = blankImage(8);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x)
                atlas.at(x, y, 0) = x < 4 ? 1.0F : 0.0F;
        ASSERT_TRUE(succeeded(writeExr(atlas_, atlas)));
    }
    void TearDown() override {
        if (!atlas_.empty()) fs::remove(atlas_);
        Run::TearDown();
    }

    /// split: from which distance on the second cascade counts.
    Image drawn(const Sunlit& what, double split, double red, double green) {
        const auto effect = loadEffect(copy_.put(text_, what.effect), {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
        if (!effect) return (ADD_FAILURE() << format(effect.error()), Image{});
        RunOptions options{.technique = what.technique, .width = kSunPicture, .height = kSunPicture, .compiler = defaultCompiler()};
        options.parameters = {{"gSunSplit", {split, 0.001, 0, 0}},
                              {"gSunColor", {red, green, 0, 0}},
                              {"gSunDirection", {0, 0, 1, 0}},
                              {"gSunCascade", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.25, 0.5, 0.5, 1, //
                                               0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.75, 0.5, 0.5, 1}}};
        if (effect->findParameter("gTransmission")) options.parameters["gTransmission"] = {0};
        options.textures = {{"gSunAtlasMap", atlas_.string()}};
        Workspace workspace;
        workspace.camera.position = {0.7F, 0.5F, 3};
        workspace.light.position = {-3, 2, -3}; // behind the sheet: this project's own light shows nothing
        const auto result = runEffect(*device_, *effect, &mesh_, workspace, options);
        if (!result) return (ADD_FAILURE() << what.effect << ": " << format(result.error()), Image{});
        return result->image;
    }

    static double sum(const Image& image, int channel) {
        double all = 0;
        for (std::size_t i = static_cast<std::size_t>(channel); i < image.pixels.size(); i += 4)
            all += image.pixels[i];
        return all;
    }

private:
    EffectsCopy copy_;
    Mesh mesh_;
    std::string text_;
    fs::path atlas_;
};

TEST_P(EngineLight, is_the_engines_alone_in_colour_and_in_cascades) {
    const Sunlit what = GetParam();
    const Image lit = drawn(what, 1e6, 1.0, 0.5);
    const Image dark = drawn(what, 0.0, 1.0, 0.5);
    const Image brighter = drawn(what, 1e6, 2.0, 0.5);
    ASSERT_FALSE(lit.pixels.empty() || dark.pixels.empty() || brighter.pixels.empty());
    EXPECT_GT(sum(lit, 0), 1.0) << "the sun does not reach it";
    EXPECT_LT(sum(dark, 0), 1e-3 * sum(lit, 0)) << "the second cascade does not hide the sun";
    // Halves of maps round to 2^-11.
    EXPECT_NEAR(sum(brighter, 0), 2.0 * sum(lit, 0), 2e-3 * sum(lit, 0));
    EXPECT_NEAR(sum(brighter, 1), sum(lit, 1), 2e-3 * sum(lit, 1));
}

INSTANTIATE_TEST_SUITE_P(Techniques, EngineLight, testing::ValuesIn(kSunlit),
                         [](const auto& tested) { return std::string(tested.param.technique); });

} // namespace
} // namespace tegument::test
