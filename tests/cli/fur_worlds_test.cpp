// Fur is the same picture in every world: whatever unit the mesh is in, whatever the world matrix scales by, turns or mirrors.
// Light on strands, as a user meets it: from where it comes, and none where there is none.

#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

using namespace tegument::test;
using ::tegument::Image;

namespace {

/// Of strands, which a change in the last bits of a place may let begin a pixel earlier.
constexpr double kMostDifferent = 1e-2;

struct World {
    const char* name;
    double unit;            // mm in one unit of the mesh file
    const char* scale;      // of the world matrix, JSON
    const char* rotation;   // degrees
    const char* camera;     // its keys; and those of the light
    const char* parameters; // more of them
    bool mirrored = false;
};

constexpr const char* kCamera = R"("camera": {"position": [1, 0.5, 4]}, "light": {"position": [-3, 2, 5]})";
constexpr const char* kTurned = R"("camera": {"position": [1, -4, 0.5], "up": [0, 0, 1]}, "light": {"position": [-3, -5, 2]})";
constexpr const char* kMirrored = R"("camera": {"position": [-1, 0.5, 4]}, "light": {"position": [3, 2, 5]})";

constexpr World kUnit{"unit", 1, "1", "[0, 0, 0]", kCamera, ""};
constexpr std::array kWorlds = {World{"twice as large", 1, "2", "[0, 0, 0]", kCamera, ""},
                                World{"the file in metres, the world in mm", 0.001, "1000", "[0, 0, 0]", kCamera, ""},
                                World{"all in metres", 0.001, "1", "[0, 0, 0]", kCamera, R"(, "gUnitMm": 1000)"},
                                World{"turned about x", 1, "1", "[90, 0, 0]", kTurned, R"(, "gFurDown": [0, 0, -1])"},
                                World{"mirrored", 1, "[-2, 2, 2]", "[0, 0, 0]", kMirrored, "", true}};

/// Fur maps and roots, made once from the ball of 1 mm to the unit.
const std::string& furFolder() {
    static const std::string kFolder = [] {
        const std::string folder = (scratch() / "fur").string();
        const Ran maps = tegument::test::tegument({"fur", "texture", "-o", folder, "--size", "256", "--density", "0.02", "--taper"});
        EXPECT_EQ(maps.code, 0) << maps.err;
        const Ran roots = tegument::test::tegument(
            {"fur", "roots", ballMesh(), "-o", folder + "/roots.dds", "--count", "6000", "--lean", "0.3", "--comb", "1", "0", "0"});
        EXPECT_EQ(roots.code, 0) << roots.err;
        return folder;
    }();
    return kFolder;
}

std::string workspaceOf(const World& world) {
    const std::string& fur = furFolder();
    return write(fmt::format("{}.json", world.name),
                 fmt::format(R"({{"objects": [{{"mesh": "{}", "head": false, "unit_mm": {},
 "scale": {}, "rotation": {}}}], {}, "background": [0.1, 0.2, 0.3],
 "textures": {{"gFurCubeMap": "{}/fur_cube.dds", "gFurSphereMap": "{}/fur_sphere.dds", "gFurRootsMap": "{}/roots.dds"}},
 "parameters": {{"gFurLayers": 12, "gFurTaper": 1, "gFurShadow": 1, "gFurSpacing": 0.02, "gFurLength": 0.1{}}}}})",
                             ballMesh(), world.unit, world.scale, world.rotation, world.camera, fur, fur, fur, world.parameters));
}

Image drawn(const std::string& effect, const std::string& technique, const World& world) {
    return render(fmt::format("{} {}", technique, world.name),
                  {effect, "-t", technique, "-w", workspaceOf(world), "--size", "160x160", "--map-size", "512"})
        .image;
}

double relativeL2(const Image& image, const Image& reference, bool mirrored) {
    double different = 0;
    double sum = 0;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double truth = static_cast<double>(reference.at(x, y, c));
                const double value = static_cast<double>(image.at(mirrored ? image.width - 1 - x : x, y, c));
                different += (value - truth) * (value - truth);
                sum += truth * truth;
            }
    return std::sqrt(different / sum);
}

struct Drawing {
    const char* effect;
    const char* technique;
};

class FurWorlds : public testing::TestWithParam<Drawing> {};

constexpr double kRadius = 110; // of ballMesh()

/// Nothing but this light; the coat's own colours.
std::string litBy(const std::string& name, const std::string& light) {
    return write(
        name,
        fmt::format(
            R"({{"mesh": "{}", "unit_mm": 1, "head": false, "background": [0, 0, 0], "camera": {{"frame": "world", "position": [0, 0, 700],
 "target": [0, 0, 0], "horizontal_fov": 22}}, "light": {{"frame": "world", "color": [1, 1, 1], {}}},
 "parameters": {{"gCoatSky": [0, 0, 0], "gCoatGround": [0, 0, 0], "gCoatRim": [0, 0, 0]}}}})",
            ballMesh(), light));
}

Image drawn(const std::string& technique, const std::string& workspace) {
    return render(technique, {"effects/FurCoat.fx", "-t", technique, "-w", workspace, "--size", "128x128", "--samples", "4", "-D",
                              "TEGUMENT_MAP_SIZE=512"})
        .image;
}

/// Brightest value of any channel.
float brightest(const std::string& effect, const std::string& technique, const std::vector<std::string>& more) {
    static const std::string dark = write("dark.json", fmt::format(R"({{"mesh": "{}", "unit_mm": 1, "head": false, "background": [0, 0, 0],
 "light": {{"color": [0, 0, 0]}}}})",
                                                                   ballMesh()));
    std::vector<std::string> arguments = {"effects/" + effect,    "-t", technique, "-w", dark, "--size", "64x64", "-D",
                                          "TEGUMENT_MAP_SIZE=256"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Image image = render(technique, arguments).image;
    EXPECT_FALSE(image.pixels.empty());
    float most = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                most = std::max(most, image.at(x, y, c));
    return most;
}

/// Means of blocks of eight pixels a side: single strands differ by where texels of the light's map lie.
std::vector<double> blocks(const Image& image) {
    constexpr int kBlock = 8;
    std::vector<double> sums(static_cast<std::size_t>(image.width / kBlock) * static_cast<std::size_t>(image.height / kBlock));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sums[static_cast<std::size_t>(y / kBlock) * static_cast<std::size_t>(image.width / kBlock) +
                 static_cast<std::size_t>(x / kBlock)] += static_cast<double>(image.at(x, y, 1)) / (kBlock * kBlock);
    return sums;
}

} // namespace

TEST_P(FurWorlds, show_the_same_coat) {
    const auto [effect, technique] = GetParam();
    const Image unit = drawn(effect, technique, kUnit);
    ASSERT_FALSE(unit.pixels.empty());
    for (const World& world : kWorlds) {
        const Image image = drawn(effect, technique, world);
        ASSERT_EQ(image.pixels.size(), unit.pixels.size()) << world.name;
        EXPECT_LT(relativeL2(image, unit, world.mirrored), kMostDifferent) << technique << ", " << world.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Techniques, FurWorlds,
                         testing::Values(Drawing{"effects/Fur.fx", "CubePosition"}, Drawing{"effects/Fur.fx", "SphereCombined"},
                                         Drawing{"effects/FurRoots.fx", "Cellular"}, Drawing{"effects/FurRoots.fx", "Roots"}),
                         [](const testing::TestParamInfo<Drawing>& tested) { return std::string(tested.param.technique); });

TEST(FurLight, that_is_parallel_lights_as_a_point_far_away_does) {
    const glm::dvec3 toLight = {std::sin(0.35), 0, std::cos(0.35)};
    const auto written = [](const glm::dvec3& v) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z); };
    const std::string parallel = litBy("parallel.json", "\"direction\": " + written(-toLight));
    const std::string point = litBy("point.json", "\"position\": " + written(60 * kRadius * toLight));
    for (const char* technique : {"Strands", "StrandsSoft", "Coat", "CoatSoft", "StrandsCompute", "CoatCompute", "CoatChance"}) {
        const std::vector<double> far = blocks(drawn(technique, point));
        const std::vector<double> rays = blocks(drawn(technique, parallel));
        ASSERT_EQ(far.size(), rays.size());
        double apart = 0, all = 0, mean = 0, of = 0;
        for (std::size_t i = 0; i < far.size(); ++i) {
            apart += std::pow(rays[i] - far[i], 2);
            all += far[i] * far[i];
            mean += rays[i];
            of += far[i];
        }
        EXPECT_GT(all, 0) << technique << ": there is something to see";
        // A point 60 radii away is one degree off at the ball's edge.
        EXPECT_NEAR(mean / of, 1, 0.02) << technique;
        EXPECT_LT(std::sqrt(apart / all), 0.025)
            << technique << "; Strands 0.018, CoatSoft 0.015; lit from the root's own distance: 0.055, 0.124";
    }
}

TEST(FurLight, that_is_none_leaves_every_technique_black) {
    const std::map<std::string, std::vector<std::string>> all = {
        {"FurCoat.fx", {"Strands", "StrandsSoft", "Coat", "CoatSoft", "StrandsCompute", "CoatCompute", "CoatChance"}},
        {"FurRoots.fx", {"Cellular", "Roots"}},
        {"Fur.fx", {"CubePosition", "CubeNormal", "CubeCombined", "SpherePosition", "SphereNormal", "SphereCombined"}}};
    for (const auto& [effect, techniques] : all)
        for (const std::string& technique : techniques)
            EXPECT_EQ(brightest(effect, technique, {}), 0) << effect << ", " << technique;
    EXPECT_GT(brightest("FurCoat.fx", "CoatSoft", {"--set", "gLightColor=1,1,1"}), 0);
}

TEST(FurLight, of_fibres_is_the_same_by_each_compiler_and_for_each_sample) {
    const std::string point = litBy("near.json", R"("position": [300, 400, 700])");
    const auto fibres = [&](const char* compiler, const char* samples) {
        return render("chance", {"effects/FurCoat.fx", "-t", "CoatChance", "-w", point, "--size", "128x128", "--compiler", compiler,
                                 "--samples", samples, "-D", "TEGUMENT_MAP_SIZE=512"})
            .image;
    };
    const auto mean = [](const Image& image) {
        double sum = 0;
        for (const float value : image.pixels)
            sum += static_cast<double>(value) / static_cast<double>(image.pixels.size());
        return sum;
    };
    const Image one = fibres("dxc", "1");
    const Image other = fibres("glslang", "1");
    ASSERT_EQ(one.pixels.size(), other.pixels.size());
    double apart = 0, all = 0;
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        apart += std::pow(static_cast<double>(one.pixels[i]) - static_cast<double>(other.pixels[i]), 2);
        all += std::pow(static_cast<double>(one.pixels[i]), 2);
    }
    EXPECT_GT(all, 0);
    EXPECT_LT(std::sqrt(apart / all), 0.02) << "chances are alike to the bit; edges differ by rounding";
    EXPECT_NEAR(mean(fibres("dxc", "4")) / mean(one), 1, 0.03) << "each sample has its own chance";
}

TEST(FurLight, of_lamps_reaches_fibres_and_the_layer_below_them) {
    const std::vector<std::string> lamp = {
        "--set", "TEGUMENT_LAMPS=1", "--set", "gLampPlace=0,0.3,1,0,0,1,0,0,0,1,0,0", "--set", "gLampColor=1,1,1,0,0,0,0,0,0,0,0,0"};
    EXPECT_GT(brightest("FurCoat.fx", "CoatChance", lamp), 0.05F);
    std::vector<std::string> bare = lamp;
    bare.insert(bare.end(), {"--set", "gFurShare=0"});
    EXPECT_GT(brightest("FurCoat.fx", "CoatChance", bare), 1e-3F) << "no strand is drawn";
}

TEST(FurLight, of_fibres_is_the_same_from_all_sides) {
    // The ball's roots, combed nowhere, and a light that goes with the eye.
    double least = 1e30, most = 0;
    constexpr int kViews = 6;
    for (int view = 0; view < kViews; ++view) {
        const double turn = 2 * 3.14159265358979 * view / kViews;
        const auto at = [&](double angle, double away) {
            return fmt::format("[{:.6f}, 0, {:.6f}]", away * std::sin(angle), away * std::cos(angle));
        };
        const std::string workspace = write(
            "side.json", fmt::format(R"({{"mesh": "{}", "unit_mm": 1, "head": false, "background": [0, 0, 0], "camera": {{"frame": "world",
 "position": {}, "target": [0, 0, 0], "horizontal_fov": 22}}, "light": {{"frame": "world", "color": [1, 1, 1], "position": {}}},
 "parameters": {{"gCoatLean": 0, "gCoatWaves": 0, "gCoatBelly": 0}}}})",
                                     ballMesh(), at(turn, 700), at(turn + 0.6, 6600)));
        double sum = 0;
        for (const float value : drawn("CoatChance", workspace).pixels)
            sum += static_cast<double>(value);
        least = std::min(least, sum);
        most = std::max(most, sum);
    }
    EXPECT_GT(least, 0);
    EXPECT_LT(most / least, 1.03) << "brightest and darkest of " << kViews << " directions";
}

TEST(FurLight, enters_no_coat_where_its_front_gapes) {
    // A tube without ends: the coat's outer surface has a gap all around its upper border, through which the light sees the far side.
    std::string tube;
    std::string faces;
    constexpr int kSectors = 24;
    constexpr int kRows = 6;
    for (int row = 0; row <= kRows; ++row)
        for (int sector = 0; sector < kSectors; ++sector) {
            const double angle = 2 * 3.14159265358979 * sector / kSectors;
            tube += fmt::format("v {:.6f} {} {:.6f}\nvn {:.6f} 0 {:.6f}\nvt {:.6f} {:.6f}\n", 50 * std::cos(angle), 50 * row,
                                50 * std::sin(angle), std::cos(angle), std::sin(angle), static_cast<double>(sector) / kSectors,
                                static_cast<double>(row) / kRows);
            const int here = row * kSectors + sector + 1;
            const int next = row * kSectors + (sector + 1) % kSectors + 1;
            if (row < kRows)
                faces += fmt::format("f {0}/{0}/{0} {2}/{2}/{2} {1}/{1}/{1}\nf {1}/{1}/{1} {2}/{2}/{2} {3}/{3}/{3}\n", here, next,
                                     here + kSectors, next + kSectors);
        }
    const std::string mesh = write("tube.obj", tube + faces);
    constexpr int kSize = 128;
    const Image picture = render("tube", {"effects/FurCoat.fx", "--mesh", mesh, "--unit-mm", "1", "--size",
                                          fmt::format("{}x{}", kSize, kSize), "-D", "TEGUMENT_MAP_SIZE=512"})
                              .image;
    const auto mean = [&](int top, int bottom) {
        double sum = 0;
        for (int y = top; y < bottom; ++y)
            for (int x = kSize * 2 / 5; x < kSize * 3 / 5; ++x)
                sum += static_cast<double>(picture.pixels[static_cast<std::size_t>((y * kSize + x) * picture.channels)]);
        return sum / (bottom - top);
    };
    const double border = mean(kSize / 8, kSize / 6);
    const double below = mean(kSize / 3, kSize / 2);
    EXPECT_GT(below, 0);
    EXPECT_NEAR(border / below, 1, 0.6) << "1.35, for less of the coat stands above; lit through the gap: 2.5";
}
