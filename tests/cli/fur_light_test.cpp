// Light on strands, as a user meets it: from where it comes, and none where there is none.

#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace tegument::test;
using ::tegument::Image;

namespace {

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
                                 "--samples", samples, "-D", std::string("TEGUMENT_SAMPLES=") + samples, "-D", "TEGUMENT_MAP_SIZE=512"})
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
