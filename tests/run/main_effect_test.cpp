// effects/Main.fx as a whole, on a small sphere: the whole way from the file to the picture.
// effects/Pyramid.fx on a sphere: what its techniques draw of the same scene.

#include "host/image/compare.h"
#include "host/run/pixels.h"
#include "host/run/session.h"
#include "tests/run/fixture.h"
#include "tests/run/sphere.h"
#include "tests/spirv/missing.h"

#include <algorithm>

namespace tegument::test {
namespace {

constexpr int kPicture = 96;

class MainEffect : public Run {
protected:
    Result<RunResult> render(Compiler compiler, const std::string& setting, const std::string& technique = "DEonLuebke",
                             std::vector<std::string> dump = {}) {
        return renderView(closeUp(), {.technique = technique, .compiler = compiler, .dump = std::move(dump)}, setting);
    }

    Result<RunResult> renderView(const Workspace& view, RunOptions options, const std::string& setting = "2", int mapSize = 128) {
        const auto effect =
            loadEffect("effects/Main.fx", {.defines = {{"TEGUMENT_SETTING", setting}, {"TEGUMENT_MAP_SIZE", std::to_string(mapSize)}}});
        if (!effect) return effect.error();
        const Mesh mesh = sphere();
        options.width = kPicture;
        options.height = kPicture;
        return runEffect(*device_, *effect, &mesh, view, options);
    }

    /// Gosselin's technique with this many blurs.
    Result<RunResult> blurred(double count) {
        return renderView(closeUp(), {.technique = "Gosselin", .compiler = defaultCompiler(), .parameters = {{"gBlurCount", {count}}}});
    }
};

std::vector<std::string> passNames(const RunResult& result) {
    std::vector<std::string> names;
    for (const PassReport& pass : result.passes)
        names.push_back(pass.name);
    return names;
}

double meanOf(const Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (i % 4 != 3) sum += image.pixels[i];
    return sum / (0.75 * static_cast<double>(image.pixels.size()));
}

/// Share of pixels of which a colour differs by more than a thousandth of the mean.
double differingShare(const Image& a, const Image& b) {
    const double limit = 1e-3 * meanOf(a);
    int differing = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            double largest = 0;
            for (int channel = 0; channel < 3; ++channel)
                largest = std::max<double>(largest, std::abs(a.at(x, y, channel) - b.at(x, y, channel)));
            differing += largest > limit;
        }
    return differing / (static_cast<double>(a.width) * a.height);
}

TEST_F(MainEffect, both_compilers_draw_the_same_picture_in_every_setting) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    for (const char* technique : {"DEonLuebke", "Gosselin"})
        for (const char* setting : {"0", "1", "2"}) {
            const auto dxc = render(Compiler::Dxc, setting, technique);
            const auto glslang = render(Compiler::Glslang, setting, technique);
            ASSERT_TRUE(succeeded(dxc));
            ASSERT_TRUE(succeeded(glslang));
            ASSERT_GT(meanOf(dxc->image), 0.01) << "the picture is not black";
            // The two order sums differently, and a comparison with the shadow map may fall the other way on its edge.
            EXPECT_LT(differingShare(dxc->image, glslang->image), 1e-3) << technique << ", setting " << setting;
        }
}

const std::map<std::string, std::vector<const char*>> kTargets = {
    {"DEonLuebke",
     {"gTsmMap", "gTsmDepthMap", "gIrradianceMap", "gIrradiance2Map", "gIrradiance3Map", "gIrradiance4Map", "gIrradiance5Map",
      "gIrradiance6Map", "gIrradianceUMap", "gUnwrapDepthMap"}},
    {"Gosselin", {"gShadowMap", "gShadowDepthMap", "gIrradianceMap", "gBlurOddMap", "gBlurEvenMap", "gUnwrapDepthMap"}}};

TEST_F(MainEffect, every_target_can_be_read_and_is_finite) {
    for (const auto& [technique, names] : kTargets)
        for (const char* setting : {"0", "1", "2"}) {
            const auto result = render(defaultCompiler(), setting, technique, {"all"});
            ASSERT_TRUE(succeeded(result));
            for (const char* name : names)
                EXPECT_TRUE(result->dumped.contains(name)) << name;
            for (const auto& [name, image] : result->dumped)
                EXPECT_TRUE(std::ranges::all_of(image.pixels, [](float value) { return std::isfinite(value); }))
                    << name << ", setting " << setting;
        }
}

TEST_F(MainEffect, the_name_of_a_technique_that_is_gone_draws_the_one_in_its_place) {
    for (const std::string technique : {"DEonLuebke", "Gosselin"}) {
        const auto now = render(defaultCompiler(), "2", technique);
        const auto before = render(defaultCompiler(), "2", technique + "Culled");
        ASSERT_TRUE(succeeded(now));
        ASSERT_TRUE(succeeded(before));
        EXPECT_EQ(before->image.pixels, now->image.pixels) << technique;
        EXPECT_EQ(std::ranges::count(before->warnings, 4082, &Diagnostic::code), 1);
        EXPECT_EQ(std::ranges::count(now->warnings, 4082, &Diagnostic::code), 0);
    }
}

TEST_F(MainEffect, as_many_blurs_run_as_are_asked_for) {
    for (int count = 1; count <= 6; ++count) {
        const auto result = blurred(count);
        ASSERT_TRUE(succeeded(result));
        std::vector<std::string> expected = {"ShadowMap", "Irradiance"};
        for (int i = 1; i <= count; ++i)
            expected.push_back("Blur" + std::to_string(i));
        expected.emplace_back(count % 2 == 1 ? "Final" : "FinalEven");
        EXPECT_EQ(passNames(*result), expected);
        EXPECT_TRUE(result->warnings.empty()) << "Final reads a map that no blur has written";
    }
}

TEST_F(MainEffect, a_count_of_blurs_out_of_range_is_an_error) {
    EXPECT_EQ(code(blurred(0)), 2301);
    EXPECT_EQ(code(blurred(7)), 2301);
}

/// Sum of the squared steps between neighbouring texels: how rough the light is.
double roughness(const Image& map) {
    double sum = 0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 1; x < map.width; ++x)
            sum += std::pow(map.at(x, y, 1) - map.at(x - 1, y, 1), 2);
    return sum;
}

TEST_F(MainEffect, every_blur_more_makes_the_light_smoother) {
    double before = 1e9;
    for (int count = 1; count <= 6; ++count) {
        const std::string last = count % 2 == 1 ? "gBlurOddMap" : "gBlurEvenMap";
        const auto result = renderView(closeUp(), {.technique = "Gosselin",
                                                   .compiler = defaultCompiler(),
                                                   .parameters = {{"gBlurCount", {static_cast<double>(count)}}, {"gBlurSize", {12}}},
                                                   .dump = {last}});
        ASSERT_TRUE(succeeded(result));
        EXPECT_LT(roughness(result->dumped.at(last)), before) << count << " blurs";
        before = roughness(result->dumped.at(last));
    }
}

TEST_F(MainEffect, a_radius_of_zero_leaves_the_light_unblurred) {
    const RunOptions options{.technique = "Gosselin",
                             .compiler = defaultCompiler(),
                             .parameters = {{"gBlurSize", {0}}},
                             .dump = {"gIrradianceMap", "gBlurOddMap"}};
    for (const char* setting : {"0", "2"}) {
        const auto result = renderView(closeUp(), options, setting);
        ASSERT_TRUE(succeeded(result));
        const Image& before = result->dumped.at("gIrradianceMap");
        const Image& after = result->dumped.at("gBlurOddMap");
        for (int y = 0; y < before.height; ++y)
            for (int x = 0; x < before.width; ++x)
                for (int c = 0; c < 4 && before.at(x, y, 3) < 0.995F;
                     ++c) // the sum of 13 equal halves, divided by 13, rounds to a neighbour
                    ASSERT_NEAR(after.at(x, y, c), before.at(x, y, c), 2e-3F * std::abs(before.at(x, y, c)))
                        << setting << " " << x << " " << y;
    }
}

class PyramidRun : public Run, public testing::WithParamInterface<Compiler> {
protected:
    void SetUp() override {
        Run::SetUp();
        if (const std::string missing = compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    }

    Result<RunResult> draw(const std::string& technique, int mapSize, double coarse, int samples = 1) {
        const auto effect = loadEffect("effects/Pyramid.fx", {.defines = {{"TEGUMENT_MAP_SIZE", std::to_string(mapSize)}}});
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
    const auto effect = loadEffect("effects/Pyramid.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
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
        EffectSession session(*device_, *effect, SessionScene{.mesh = &mesh});
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
