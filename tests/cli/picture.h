#pragma once
// `tegument render` to an EXR, under the validation layers, read back: one sample a pixel unless a test asks for more, since what is
// compared is compared at pixels' centres.

#include "host/image/image.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {

struct Picture {
    Image image;
    nlohmann::json report;
};

/// Writes <name>.exr below scratch(). Anything that goes wrong fails the test.
inline Picture render(const std::string& name, const std::vector<std::string>& arguments) {
    const std::filesystem::path path = scratch() / (name + ".exr");
    std::vector<std::string> all = {"render", "-o", path.string(), "--json", "--validate"};
    if (std::ranges::find(arguments, "--samples") == arguments.end()) all.insert(all.end(), {"--samples", "1"});
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Ran ran = tegument(all);
    EXPECT_EQ(ran.code, 0) << ran.err;
    Picture picture{.report = ran.json()};
    if (ran.code != 0) return picture;
    EXPECT_TRUE(picture.report["validation_messages"].empty()) << picture.report["validation_messages"];
    auto image = loadImage(path);
    EXPECT_TRUE(image);
    if (image) picture.image = std::move(*image);
    return picture;
}

} // namespace tegument::test
