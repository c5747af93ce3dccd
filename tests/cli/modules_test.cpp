// Each module alone, as the program draws it: all of its techniques run, and what it shows is what the whole picture is made of.

#include "tests/cli/picture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace tegument::test;
using ::tegument::Image;

namespace {

namespace fs = std::filesystem;

std::vector<std::string> effectFiles() {
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator("effects"))
        if (entry.path().extension() == ".fx") files.push_back(entry.path().generic_string());
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> techniquesOf(const std::string& effect) {
    std::vector<std::string> names;
    const auto info = ::tegument::test::tegument({"info", effect, "--json"}).json();
    for (const auto& technique : info["techniques"])
        names.push_back(technique["name"]);
    return names;
}

Picture small(const std::string& effect, const std::string& technique, const std::vector<std::string>& more = {}) {
    static int count = 0;
    std::vector<std::string> arguments = {effect, "--technique", technique, "--map-size", "128"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    if (std::ranges::find(more, "-w") == more.end()) arguments.insert(arguments.end(), {"-w", ballWorkspace(), "--size", "96x96"});
    return render(fmt::format("module-{}", ++count), arguments);
}

std::string ballRoots() {
    const std::string file = (scratch() / "ball_roots.dds").string();
    const Ran ran = ::tegument::test::tegument({"fur", "roots", ballMesh(), "-o", file});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return file;
}

Image difference(const Image& a, const Image& b) {
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    Image result = a;
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] -= b.pixels[i];
    return result;
}

/// Largest absolute value of the colours.
double largest(const Image& image) {
    double value = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (i % 4 != 3) value = std::max<double>(value, std::abs(image.pixels[i]));
    return value;
}

/// What the specular layer adds to the picture of Main. Black background: both pictures have it.
Image specularOf(const std::string& technique, const std::string& setting) {
    const Picture with = small("effects/Main.fx", technique, {"--setting", setting});
    const Picture without =
        small("effects/Main.fx", technique, {"--setting", setting, "--set", "gSpecularIntensity=0", "--set", "gPlainIntensity=0"});
    return difference(with.image, without.image);
}

void expectSame(const Image& a, const Image& b) {
    ASSERT_GT(largest(a), 0.01) << "there is nothing to compare";
    // Sum and difference of pictures of up to 1 in 24 bits.
    EXPECT_LT(largest(difference(a, b)), 1e-6);
}

/// The ball without colour map, half of it out of the picture to the right.
std::string halfOut() {
    return write("half_out.json", fmt::format(R"({{"mesh": "{}", "unit_mm": 1,
 "camera": {{"position": [0, 0.5, 5], "target": [-1.1, 0, 0]}}, "light": {{"position": [-3, 2, 5]}}}})",
                                              ballMesh()));
}

/// Pixels of the view, the upper right quarter, that have one of the causes' colours: the green of skin without a colour map is 0.64 of its
/// red.
int culledPixels(const std::string& technique, const std::string& setting) {
    const Image image = small("effects/Culling.fx", technique, {"-w", halfOut(), "--setting", setting, "--size", "256x256"}).image;
    int culled = 0;
    for (int y = 0; y < image.height / 2; ++y)
        for (int x = image.width / 2; x < image.width; ++x)
            culled += std::abs(image.at(x, y, 1) - 0.34F / 0.53F * image.at(x, y, 0)) > 0.01F;
    return culled;
}

} // namespace

TEST(Modules, culling_per_vertex_as_printed_loses_texels_that_show) {
    // Triangles with one vertex behind the outline or out of the picture go whole.
    EXPECT_GT(culledPixels("PrePass", "seed"), 20);
}

TEST(Modules, every_technique_draws_without_a_validation_message) {
    const auto files = effectFiles();
    ASSERT_GE(files.size(), 11U);
    for (const std::string& effect : files)
        for (const std::string& technique : techniquesOf(effect)) {
            // A ball has no face by which hair would know where to grow: it gets fur's roots.
            const bool hair = effect.ends_with("FurSkin.fx");
            const Picture picture = small(effect, technique,
                                          hair ? std::vector<std::string>{"--set", "gFurRootsMap=" + ballRoots()}
                                               : std::vector<std::string>{}); // fails the test where anything is wrong
            EXPECT_TRUE(std::ranges::all_of(picture.image.pixels, [](float value) { return std::isfinite(value); }))
                << effect << " " << technique;
        }
}

TEST(Modules, specular_is_what_main_adds_to_the_diffuse_light) {
    expectSame(small("effects/Specular.fx", "Specular").image, specularOf("Gosselin", "corrected"));
}

TEST(Modules, unshadowed_specular_is_what_gosselin_adds_in_setting_seed) {
    expectSame(small("effects/Specular.fx", "SpecularUnshadowed", {"--setting", "seed"}).image, specularOf("Gosselin", "seed"));
}

TEST(Modules, shadow_takes_from_the_specular_light_and_never_adds) {
    const Image shadowed = small("effects/Specular.fx", "Specular").image;
    const Image unshadowed = small("effects/Specular.fx", "SpecularUnshadowed").image;
    for (std::size_t i = 0; i < shadowed.pixels.size(); ++i)
        ASSERT_LE(shadowed.pixels[i], unshadowed.pixels[i]);
}

TEST(Modules, smooth_specular_is_the_same_where_there_is_no_normal_map) {
    // The tangent frame is not renormalised, so the flat normal (0, 0, 1) of the fallback comes back to within rounding of 0.5 in 8 bits.
    const Image flat = small("effects/Specular.fx", "Specular").image;
    EXPECT_LT(largest(difference(flat, small("effects/Specular.fx", "SpecularSmooth").image)), 0.02 * largest(flat));
}

TEST(Modules, the_shadow_map_holds_the_depths_of_the_translucent_shadow_map) {
    for (const char* setting : {"seed", "corrected"}) {
        const auto shadow = small("effects/ShadowMap.fx", "ShadowMap", {"--dump", "gShadowMap", "--setting", setting}).report;
        const auto tsm = small("effects/TSM.fx", "TSM", {"--dump", "gTsmMap", "--setting", setting}).report;
        const auto depth = ::tegument::loadImage(shadow["dumped"]["gShadowMap"].get<std::string>());
        const auto translucent = ::tegument::loadImage(tsm["dumped"]["gTsmMap"].get<std::string>());
        ASSERT_TRUE(depth && translucent);
        for (int y = 0; y < depth->height; ++y)
            for (int x = 0; x < depth->width; ++x)
                ASSERT_EQ(depth->at(x, y, 0), translucent->at(x, y, 0)) << setting << " " << x << " " << y;
    }
}
