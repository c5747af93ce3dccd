// Cube maps and mip levels from DDS files.

#include "host/image/dds.h"
#include "tests/run/fixture.h"

#include <unistd.h>

namespace tegument::test {
namespace {

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
        DdsTexture cube{.format = format, .faces = 6, .mips = mips, .images = {}};
        for (int face = 0; face < 6; ++face)
            for (int mip = 0; mip < mips; ++mip) {
                const int side = 4 >> mip;
                Image image{.width = side, .height = side, .channels = 4, .pixels = {}};
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
    DdsTexture flat{.format = DdsFormat::Rgba32F, .faces = 1, .mips = 2, .images = {}};
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
