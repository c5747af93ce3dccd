// A head that is lit from behind: light must not come through where a thin part, an ear, stands between the lamp and skin.

#include "host/image/image.h"
#include "host/support/file.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

using namespace tegument::test;
namespace fs = std::filesystem;

namespace {

constexpr int kSize = 640;
constexpr int kReach = 4; // pixels: as far as the white outline is wide

struct Picture {
    std::vector<float> pixels; // four a pixel

    [[nodiscard]] float brightest(int x, int y) const {
        const auto at = static_cast<std::size_t>(4 * (y * kSize + x));
        return std::max({pixels[at], pixels[at + 1], pixels[at + 2]});
    }
    [[nodiscard]] bool background(int x, int y) const {
        const auto at = static_cast<std::size_t>(4 * (y * kSize + x));
        const std::size_t corner = 4 * (kSize - 1); // top right
        return std::equal(pixels.begin() + static_cast<std::ptrdiff_t>(at), pixels.begin() + static_cast<std::ptrdiff_t>(at + 3),
                          pixels.begin() + static_cast<std::ptrdiff_t>(corner));
    }
};

/// Lit skin with nothing but dark skin around it. What mirrors the lamp lies on the outline, beside the background.
bool isLeak(const Picture& picture, int x, int y) {
    if (picture.brightest(x, y) < 0.5F) return false;
    int lit = 0;
    for (int v = y - kReach; v <= y + kReach; ++v)
        for (int u = x - kReach; u <= x + kReach; ++u) {
            if (picture.background(u, v)) return false;
            lit += picture.brightest(u, v) > 0.1F;
        }
    return lit < (2 * kReach + 1) * (2 * kReach + 1) / 3; // a line or a point, and no lit place
}

} // namespace

TEST(Backlit, no_light_comes_through_an_ear) {
    const fs::path head = tegument::cacheFolder() / "human" / "human.glb";
    if (!fs::exists(head)) GTEST_SKIP() << "no " << head << ": tegument prep human makes it";
    for (const char* technique : {"Pyramid", "PyramidLinked"}) {
        const fs::path file = scratch() / "backlit.exr";
        const Ran ran =
            tegument::test::tegument({"render", "effects/Pyramid.fx", "-t", technique, "-w", "effects/workspaces/human_backlit.json",
                                      "--size", "640x640", "--samples", "1", "-o", file.string()});
        ASSERT_EQ(ran.code, 0) << ran.err;
        const auto image = tegument::loadImage(file);
        ASSERT_TRUE(image);
        ASSERT_EQ(image->pixels.size(), std::size_t{4} * kSize * kSize);
        const Picture picture{image->pixels};
        int leaks = 0;
        for (int y = kReach; y < kSize - kReach; ++y)
            for (int x = kReach; x < kSize - kReach; ++x)
                leaks += isLeak(picture, x, y);
        EXPECT_EQ(leaks, 0) << technique;
    }
}
