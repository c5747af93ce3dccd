// `--samples`: one is at pixels' centres, several smooth edges, others are refused.

#include "tests/cli/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tegument::test;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> ball(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"effects/OriginalTexture.fx", "-w", ballWorkspace(), "--size", "64x64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

Ran renderTo(const fs::path& path, const std::string& samples) {
    std::vector<std::string> arguments = {"render", "-o", path.string()};
    for (const std::string& argument : ball({"--samples", samples}))
        arguments.push_back(argument);
    return tegument::test::tegument(arguments);
}

} // namespace

TEST(Samples, one_is_drawn_without_a_resolve_and_covers_a_pixel_wholly_or_not_at_all) {
    const Picture one = render("one", ball({"--samples", "1"}));
    EXPECT_EQ(one.report["samples"], 1);
    for (const auto& pass : one.report["passes"])
        EXPECT_NE(pass["name"], "resolve");
    for (std::size_t alpha = 3; alpha < one.image.pixels.size(); alpha += 4)
        EXPECT_TRUE(one.image.pixels[alpha] == 0 || one.image.pixels[alpha] == 1) << one.image.pixels[alpha];
}

TEST(Samples, four_give_the_rim_of_a_ball_steps_of_a_quarter) {
    const Picture four = render("four", ball({"--samples", "4"}));
    EXPECT_EQ(four.report["samples"], 4);
    bool between = false;
    for (int y = 0; y < four.image.height; ++y)
        for (int x = 0; x < four.image.width; ++x) {
            const float alpha = 4 * four.image.at(x, y, 3);
            EXPECT_EQ(alpha, std::round(alpha)) << x << ", " << y;
            between = between || (alpha > 0 && alpha < 4);
        }
    EXPECT_TRUE(between);
}

TEST(Samples, every_technique_of_the_skin_draws_with_four) {
    for (const char* technique : {"DEonLuebke", "Gosselin"}) {
        const Picture four = render(technique, {"effects/Main.fx", "-t", technique, "-w", ballWorkspace(), "--size", "64x64", "--map-size",
                                                "64", "--samples", "4"});
        EXPECT_EQ(four.report["samples"], 4) << technique;
    }
}

TEST(Samples, a_number_other_than_1_2_4_8_is_refused_before_work) {
    for (const char* samples : {"0", "3", "16", "-4", "four"}) {
        const fs::path path = scratch() / "refused.png";
        const Ran ran = renderTo(path, samples);
        EXPECT_EQ(ran.code, 2) << ran.err;
        EXPECT_NE(ran.err.find("--samples"), std::string::npos) << ran.err;
        EXPECT_FALSE(fs::exists(path));
    }
}

TEST(Samples, eight_are_drawn_or_refused_with_those_that_the_device_has) {
    const fs::path path = scratch() / "eight.png";
    const Ran ran = renderTo(path, "8");
    if (ran.code == 0) {
        EXPECT_TRUE(fs::exists(path));
        return;
    }
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_NE(ran.err.find("TG6016"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("1, 4"), std::string::npos) << ran.err;
    EXPECT_FALSE(fs::exists(path));
}
