// Fur is the same picture in every world: whatever unit the mesh is in, whatever the world matrix scales by, turns or mirrors.

#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

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
