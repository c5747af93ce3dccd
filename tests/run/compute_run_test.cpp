// Compute passes of effects: what they write is what later passes read, by both compilers.
// Cube maps and mip levels from DDS files.

#include "host/image/dds.h"
#include "tests/run/fixture.h"
#include "tests/spirv/missing.h"

#include <unistd.h>

#include <algorithm>

namespace tegument::test {
namespace {

class ComputeRun : public Run, public testing::WithParamInterface<Compiler> {
protected:
    static RunOptions picture(const std::string& technique, int width = 16, int height = 8) {
        return {.technique = technique, .width = width, .height = height, .compiler = GetParam()};
    }

    void SetUp() override {
        Run::SetUp();
        if (const std::string missing = compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    }

    Result<RunResult> draw(const RunOptions& options) { return run("compute.fx", options); }
};

TEST_P(ComputeRun, a_thread_for_each_texel_writes_it) {
    RunOptions options = picture("Numbers");
    options.parameters["gStep"] = {0.25};
    const auto result = draw(options);
    ASSERT_TRUE(succeeded(result));
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_TRUE(pixelIs(result->image, x, y, {static_cast<float>(x), static_cast<float>(y), 0.25F, 1}));
}

TEST_P(ComputeRun, threads_of_a_group_share_what_they_have_read) {
    const auto result = draw(picture("Reversed"));
    ASSERT_TRUE(succeeded(result));
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_TRUE(pixelIs(result->image, x, y, {2.0F * static_cast<float>(15 - x), 2.0F * static_cast<float>(y), 2, 2}));
}

TEST_P(ComputeRun, groups_are_counted_by_numbers_or_by_a_parameter) {
    RunOptions options = picture("Counted");
    options.parameters["gCount"] = {2, 4};
    const auto result = draw(options);
    ASSERT_TRUE(succeeded(result));
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool given = x < 2 && y < 4;
            const bool any = given || (x < 3 && y < 2);
            EXPECT_TRUE(pixelIs(result->image, x, y,
                                {given ? 2.0F
                                 : any ? 1.0F
                                       : 0.0F,
                                 any ? static_cast<float>(x) : 0, any ? static_cast<float>(y) : 0, 0}));
        }
}

TEST_P(ComputeRun, the_last_groups_may_reach_over_the_targets_border_and_the_viewport_is_that_target) {
    const auto result = draw(picture("Wide", 19, 9));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 18, 8, {18, 8, 19, 9})) << "written through a name of its own";
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0, 0, 19, 9}));
}

TEST_P(ComputeRun, the_viewport_is_the_picture_or_another_target_where_a_pass_says_so) {
    const auto asPicture = draw(picture("WideAsPicture", 38, 18));
    ASSERT_TRUE(succeeded(asPicture));
    EXPECT_TRUE(pixelIs(asPicture->image, 37, 17, {18, 8, 38, 18}));
    const auto asOther = draw(picture("WideAsOther", 19, 9));
    ASSERT_TRUE(succeeded(asOther));
    EXPECT_TRUE(pixelIs(asOther->image, 18, 8, {18, 8, 16, 8}));
}

TEST_P(ComputeRun, mip_chains_are_made_of_what_was_written) {
    const auto result = draw(picture("Chain", 1, 1));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {2, 7.5F, 0, 1}, 1e-3F)) << "the mean of 16 x 16 texels";
}

TEST_P(ComputeRun, passes_are_reported_in_order_and_frames_are_alike) {
    RunOptions options = picture("Reversed");
    options.frames = 3;
    const auto thrice = draw(options);
    const auto once = draw(picture("Reversed"));
    ASSERT_TRUE(succeeded(thrice) && succeeded(once));
    EXPECT_EQ(thrice->image.pixels, once->image.pixels);
    std::vector<std::string> names;
    for (const PassReport& pass : thrice->passes)
        names.push_back(pass.name);
    EXPECT_EQ(names, (std::vector<std::string>{"Number", "Reverse", "Show"}));
}

TEST_P(ComputeRun, a_texture_is_not_read_and_written_in_one_pass) {
    EXPECT_EQ(code(draw(picture("Feedback"))), 4024);
    EXPECT_EQ(code(draw(picture("Twice"))), 4024) << "nor written by two names";
}

TEST_P(ComputeRun, what_is_written_belongs_to_a_target) {
    EXPECT_EQ(code(draw(picture("Nowhere"))), 4062);
}

TEST_P(ComputeRun, a_pass_says_how_many_groups_run) {
    EXPECT_EQ(code(draw(picture("Uncounted"))), 4063);
    EXPECT_EQ(code(draw(picture("Odd"))), 4063) << "-1 groups";
}

INSTANTIATE_TEST_SUITE_P(Compilers, ComputeRun, testing::Values(Compiler::Dxc, Compiler::Glslang), compilerTestName);

namespace fs = std::filesystem;

constexpr std::array<std::array<double, 3>, 6> kDirections = {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

class CubeMaps : public Run {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("tegument_cube_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
        Run::SetUp();
    }
    void TearDown() override {
        Run::TearDown();
        fs::remove_all(folder_);
    }

    /// Face n has the value n in red, level m the value m in green.
    std::string sky(DdsFormat format, int mips) const {
        DdsTexture cube{.format = format, .faces = 6, .mips = mips};
        for (int face = 0; face < 6; ++face)
            for (int mip = 0; mip < mips; ++mip) {
                const int side = 4 >> mip;
                Image image{.width = side, .height = side, .channels = 4};
                for (int i = 0; i < side * side; ++i)
                    image.pixels.insert(image.pixels.end(), {static_cast<float>(face) / 5, static_cast<float>(mip), 0, 1});
                cube.images.push_back(std::move(image));
            }
        const fs::path path = folder_ / "sky.dds";
        EXPECT_TRUE(succeeded(writeDds(path, cube)));
        return path.string();
    }

    Result<RunResult> look(std::array<double, 3> direction, const std::string& file, double level = 0,
                           const std::string& technique = "Sky") {
        RunOptions options = row(1, technique);
        if (!file.empty()) options.textures["gSkyMap"] = file;
        options.parameters["gDirection"] = {direction.begin(), direction.end()};
        options.parameters["gLevel"] = {level};
        return run("cube.fx", options);
    }

    fs::path folder_;
};

TEST_F(CubeMaps, faces_lie_as_in_direct3d) {
    const std::string file = sky(DdsFormat::Rgba16F, 1);
    for (std::size_t face = 0; face < 6; ++face) {
        const auto result = look(kDirections[face], file);
        ASSERT_TRUE(succeeded(result));
        EXPECT_NEAR(result->image.at(0, 0, 0), static_cast<float>(face) / 5, 1e-3F) << "a half has 11 bits";
    }
}

TEST_F(CubeMaps, the_file_s_own_mip_levels_are_sampled) {
    const auto result = look({0, 0, -1}, sky(DdsFormat::Rgba32F, 3), 1);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {1, 1, 0, 1}));
}

TEST_F(CubeMaps, levels_that_are_made_are_those_of_each_face) {
    const std::string file = sky(DdsFormat::Rgba16F, 1);
    for (std::size_t face = 0; face < 6; ++face)
        for (const double level : {0.0, 1.0, 2.0}) {
            const auto result = look(kDirections[face], file, level, "Smooth");
            ASSERT_TRUE(succeeded(result));
            const float there = result->image.at(0, 0, 0);
            EXPECT_NEAR(there, static_cast<float>(face) / 5, 1e-3F) << "face " << face << ", level " << level;
        }
}

TEST_F(CubeMaps, a_fallback_fills_all_faces) {
    const auto result = look({0, -1, 0}, "");
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0.25F, 0.5F, 0.75F, 1}));
}

TEST_F(CubeMaps, a_picture_is_no_cube_map) {
    const fs::path path = folder_ / "flat.dds";
    const Image image{.width = 1, .height = 1, .channels = 4, .pixels = {0, 0, 0, 1}};
    ASSERT_TRUE(succeeded(writeDds(path, makeDds(image, DdsFormat::Rgba8, false))));
    EXPECT_EQ(code(look({1, 0, 0}, path.string())), 4038);
}

TEST_F(CubeMaps, a_cube_map_is_no_texture2d) {
    RunOptions options = row(1, "Plain");
    options.textures["gPlainMap"] = sky(DdsFormat::Rgba8, 1);
    EXPECT_EQ(code(run("textures.fx", options)), 4038);
}

TEST_F(CubeMaps, a_flat_dds_file_brings_its_mip_levels) {
    DdsTexture flat{.format = DdsFormat::Rgba32F, .faces = 1, .mips = 2};
    flat.images.push_back({.width = 2, .height = 2, .channels = 4, .pixels = std::vector<float>(16, 0.25F)});
    flat.images.push_back({.width = 1, .height = 1, .channels = 4, .pixels = std::vector<float>(4, 0.75F)}); // no mean of the first
    const fs::path path = folder_ / "levels.dds";
    ASSERT_TRUE(succeeded(writeDds(path, flat)));
    RunOptions options = row(1, "PlainMip");
    options.textures["gPlainMap"] = path.string();
    const auto result = run("textures.fx", options);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(0, 0, 0), 0.75F);
}

} // namespace
} // namespace tegument::test
