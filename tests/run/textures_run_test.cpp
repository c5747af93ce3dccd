// Textures: who names them, how they are decoded. Those that other effects draw: products_run_test.cpp.

#include "host/run/prepare.h"
#include "tests/run/fixture.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

/// Works in a folder of its own.
class Textures : public Run {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("tegument_run_" + std::to_string(::getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        Run::SetUp();
    }

    void TearDown() override {
        Run::TearDown();
        fs::remove_all(folder_);
    }

    /// 2 x 2 pixels: black, white; white, black.
    fs::path checker(const std::string& name) const {
        Image image{.width = 2, .height = 2, .channels = 3, .pixels = {0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0}};
        const fs::path path = folder_ / name;
        EXPECT_TRUE(succeeded(writePng(path, image, PngEncoding::Raw)));
        return path;
    }

    fs::path grey(const std::string& name, float value) const {
        Image image{.width = 1, .height = 1, .channels = 3, .pixels = {value, value, value}};
        const fs::path path = folder_ / name;
        EXPECT_TRUE(succeeded(name.ends_with(".exr") ? writeExr(path, image) : writePng(path, image, PngEncoding::Raw)));
        return path;
    }

    static RunOptions pixel(const std::string& technique, std::map<std::string, std::string> textures = {}) {
        RunOptions options = row(8, technique);
        options.height = 4;
        options.textures = std::move(textures);
        return options;
    }

    Result<RunResult> draw(const RunOptions& options, const Mesh* mesh = nullptr, const Workspace& workspace = {},
                           const LoadOptions& load = {}) {
        return run("textures.fx", options, mesh, workspace, load);
    }

    fs::path folder_;
};

TEST_F(Textures, eight_bit_colour_maps_are_decoded_from_srgb) {
    const auto result = draw(pixel("Color", {{"gColorMap", grey("g.png", 188.0F / 255)}}));
    ASSERT_TRUE(succeeded(result));
    const float expected = srgbToLinear(188.0F / 255);
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {expected, expected, expected, 1}, 0.002F)); // devices may decode with 8 or more bits
}

TEST_F(Textures, float_colour_maps_are_linear_already) {
    const auto result = draw(pixel("Color", {{"gColorMap", grey("g.exr", 0.73F)}}));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0.73F, 0.73F, 0.73F, 1}, 1e-6F));
}

TEST_F(Textures, the_caller_s_plain_skin_is_said_where_no_file_gives_a_colour) {
    const Mesh mesh = square();
    const auto result =
        run("objects.fx",
            {.technique = "Lit", .width = 8, .height = 8, .compiler = defaultCompiler(), .plainSkin = std::array{0.8F, 0.6F, 0.5F, 1.0F}},
            &mesh, closeUp());
    ASSERT_TRUE(succeeded(result));
    ASSERT_EQ(result->warnings.size(), 1U);
    EXPECT_EQ(result->warnings[0].code, 4056);
    EXPECT_NE(result->warnings[0].text.find("(0.8, 0.6, 0.5)"), std::string::npos) << result->warnings[0].text;
}

/// What a look-up compares need not be comparable in another format than a depth (VUID-vkCmdDrawIndexed-None-06479).
TEST_F(Textures, what_is_compared_is_a_depth_texture_and_nothing_else_is) {
    const auto effect = loadEffect(kFixtures / "compared.fx");
    ASSERT_TRUE(succeeded(effect));
    const Workspace workspace;
    for (const auto& textures : {std::map<std::string, std::string>{}, {{"gDepthMap", grey("d.png", 128.0F / 255)}}}) {
        const RunOptions options = pixel("Compared", textures);
        const run::RunInput input{.effect = *effect, .workspace = workspace, .options = options};
        auto prepared = run::prepare(input);
        ASSERT_TRUE(succeeded(prepared));
        ASSERT_TRUE(succeeded(run::prepareTextures(input, *prepared)));
        EXPECT_EQ(prepared->textures.at("gDepthMap").format, PixelFormat::D32F);
        EXPECT_EQ(prepared->textures.at("gPlainMap").format, PixelFormat::RGBA32F);
        const auto result = runEffect(*device_, *effect, nullptr, workspace, options);
        ASSERT_TRUE(succeeded(result));
        EXPECT_TRUE(pixelIs(result->image, 3, 1, {1, 0, 2.5F, 0.25F})); // 0.45 is less than a half, 0.55 is not
    }
}

TEST_F(Textures, depths_are_brought_into_0_to_1) {
    for (const auto& [value, lit] : {std::pair(-1.0F, 0.0F), std::pair(7.0F, 1.0F), std::pair(std::nanf(""), 0.0F)}) {
        const auto result = run("compared.fx", pixel("Compared", {{"gDepthMap", grey("d.exr", value)}}));
        ASSERT_TRUE(succeeded(result));
        EXPECT_EQ(result->image.at(0, 0, 1), lit) << value;
    }
}

TEST_F(Textures, other_maps_are_not_decoded) {
    const auto result = draw(pixel("Plain", {{"gPlainMap", grey("g.png", 188.0F / 255)}}));
    ASSERT_TRUE(succeeded(result));
    EXPECT_NEAR(result->image.at(0, 0, 0), 188.0F / 255, 0.002F);
}

TEST_F(Textures, a_linear_mip_filter_gives_a_file_its_mip_chain) {
    const auto result = draw(pixel("PlainMip", {{"gPlainMap", checker("c.png")}}));
    ASSERT_TRUE(succeeded(result));
    EXPECT_NEAR(result->image.at(0, 0, 0), 0.5F, 1.0F / 255) << "one step of 8 bits";
}

TEST_F(Textures, row_zero_of_a_file_is_at_v_zero) {
    Image image{.width = 1, .height = 2, .channels = 3, .pixels = {1, 0, 0, 0, 1, 0}};
    ASSERT_TRUE(succeeded(writePng(folder_ / "rows.png", image, PngEncoding::Raw)));
    const auto result = draw(pixel("Plain", {{"gPlainMap", (folder_ / "rows.png").string()}}));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {1, 0, 0, 1}));
    EXPECT_TRUE(pixelIs(result->image, 0, 3, {0, 1, 0, 1}));
}

TEST_F(Textures, the_workspace_names_textures_by_semantic_relative_to_itself) {
    grey("g.exr", 0.25F);
    Workspace workspace;
    workspace.file = folder_ / "workspace.json";
    workspace.textures["diffuse"] = "g.exr";
    const auto result = draw(pixel("Color"), nullptr, workspace);
    ASSERT_TRUE(succeeded(result));
    EXPECT_NEAR(result->image.at(0, 0, 0), 0.25F, 1e-6F);
}

TEST_F(Textures, set_wins_over_the_workspace) {
    Workspace workspace;
    workspace.file = folder_ / "workspace.json";
    workspace.textures["gColorMap"] = "g.exr";
    grey("g.exr", 0.25F);
    const auto result = draw(pixel("Color", {{"gColorMap", grey("h.exr", 0.75F)}}), nullptr, workspace);
    ASSERT_TRUE(succeeded(result));
    EXPECT_NEAR(result->image.at(0, 0, 0), 0.75F, 1e-6F);
}

TEST_F(Textures, a_mesh_brings_its_own_colour_map) {
    Mesh mesh = square();
    mesh.textures.push_back({.role = "color", .image = {.width = 1, .height = 1, .channels = 3, .pixels = {0.5F, 0.25F, 0.125F}}});
    const auto result = draw(pixel("Color"), &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0.5F, 0.25F, 0.125F, 1}, 1e-6F));
}

TEST_F(Textures, a_fallback_stands_in_where_nothing_names_a_file) {
    const auto result = draw(pixel("Fallback"));
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0.1F, 0.2F, 0.3F, 0.4F}, 1e-6F));
}

TEST_F(Textures, texels_above_the_largest_value_that_the_effect_names_are_warned_of_with_their_share) {
    Mesh mesh = square();
    mesh.textures.push_back({.role = "kernelSize", .image = {.width = 4, .height = 1, .channels = 1, .pixels = {0.5F, 1, 0.99F, 0}}});
    const auto result = draw(pixel("Fallback"), &mesh);
    ASSERT_TRUE(succeeded(result));
    ASSERT_EQ(result->warnings.size(), 1U);
    EXPECT_EQ(result->warnings.front().code, 4034);
    EXPECT_EQ(result->warnings.front().text, "25.00 % of the texels of gFallbackMap are above 0.99");
    EXPECT_EQ(result->warnings.front().hint, "paint 0.99 at most");
}

TEST_F(Textures, a_texture_that_nothing_names_is_an_error_that_says_where_it_looked) {
    const auto result = draw(pixel("Resource"));
    ASSERT_EQ(code(result), 4030);
    const Diagnostic& diagnostic = result.error().diagnostics.front();
    EXPECT_EQ(diagnostic.text, "no texture for gResourceMap: looked in --set, the workspace, the file no such file.png");
    EXPECT_EQ(diagnostic.hint, "give a file: --set gResourceMap=FILE");
}

TEST_F(Textures, a_named_file_that_is_missing_is_an_error_that_names_the_parameter) {
    const auto result = draw(pixel("Fallback", {{"gFallbackMap", (folder_ / "missing.png").string()}}));
    ASSERT_FALSE(result);
    const std::string message = format(result.error());
    EXPECT_NE(message.find("missing.png"), std::string::npos) << message;
    EXPECT_NE(message.find("the texture of gFallbackMap, named by --set"), std::string::npos) << message;
}

TEST_F(Textures, a_named_file_that_is_damaged_is_an_error) {
    std::ofstream(folder_ / "damaged.png") << "this is not a picture";
    EXPECT_FALSE(draw(pixel("Fallback", {{"gFallbackMap", (folder_ / "damaged.png").string()}})));
}

TEST_F(Textures, setting_an_unknown_texture_is_an_error_with_the_nearest_name) {
    const auto result = draw(pixel("Fallback", {{"gFallbackMop", "x.png"}}));
    ASSERT_EQ(code(result), 4010);
    EXPECT_EQ(result.error().diagnostics.front().hint, "did you mean 'gFallbackMap'?");
}

TEST_F(Textures, that_nothing_makes_from_the_mesh_are_warned_of_and_a_constant_stands_in) {
    const Mesh mesh = square();
    RunOptions options = row(1, "Made");
    const auto bare = run("unmade.fx", options, &mesh);
    ASSERT_TRUE(succeeded(bare));
    ASSERT_EQ(std::ranges::count(bare->warnings, 4080, &Diagnostic::code), 1);
    EXPECT_TRUE(pixelIs(bare->image, 0, 0, {0.25F, 0.5F, 0.75F, 1}));
    const fs::path made = grey("made.exr", 0.125F);
    options.assets.make = [&](const std::string& generator, const Mesh&) -> Result<fs::path> {
        EXPECT_EQ(generator, "test map");
        return made;
    };
    const auto served = run("unmade.fx", options, &mesh);
    ASSERT_TRUE(succeeded(served));
    EXPECT_EQ(std::ranges::count(served->warnings, 4080, &Diagnostic::code), 0);
    EXPECT_TRUE(pixelIs(served->image, 0, 0, {0.125F, 0.125F, 0.125F, 1}));
}

} // namespace
} // namespace tegument::test
