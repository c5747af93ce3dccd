// Maps that shape fur, on a plate with texture coordinates and on a ball without.
#include "meshprep/fur/roots/roots.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include <algorithm>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

/// Two texels side by side.
FurMap halves(const glm::vec3& left, const glm::vec3& right) {
    Image image{.width = 2, .height = 1, .channels = 3, .pixels = {left.x, left.y, left.z, right.x, right.y, right.z}, .metadata = {}};
    return FurMap(DdsTexture{.images = {image}});
}

/// A cube map of one colour a face.
FurMap faces(const std::array<glm::vec3, 6>& colours) {
    DdsTexture texture{.faces = 6, .images = {}};
    for (const glm::vec3& c : colours)
        texture.images.push_back({.width = 1, .height = 1, .channels = 3, .pixels = {c.x, c.y, c.z}, .metadata = {}});
    return FurMap(std::move(texture));
}

} // namespace

TEST(RootMaps, thin_the_fur_out_where_the_density_is_less) {
    // A map of two texels is a ramp between their centres and repeats at the borders: at 1/4 it is 1, at 3/4 it is 0.25, in the middle
    // 0.625.
    const RootSet set = rootsOf(plate(), {.count = 8000, .densityMap = halves(glm::vec3(1), glm::vec3(0.25))});
    EXPECT_NEAR(static_cast<double>(set.wanted), 8000 * 0.625, 8000 * 0.01);
    EXPECT_EQ(set.roots.size(), set.wanted);
    const auto between = [&](double from, double to) {
        return static_cast<double>(std::ranges::count_if(
            set.roots, [&](const Root& root) { return root.position.x >= 100 * from && root.position.x < 100 * to; }));
    };
    // the ramp's mean over a fifth round its ends: 1 - 0.05 * 1.5 = 0.925 and 0.325; five sigma of independent places
    EXPECT_NEAR(between(0.15, 0.35), 1600 * 0.925, 5 * std::sqrt(1600 * 0.925));
    EXPECT_NEAR(between(0.65, 0.85), 1600 * 0.325, 5 * std::sqrt(1600 * 0.325));
}

TEST(RootMaps, scale_lengths_and_leave_bald_what_has_none) {
    const RootSet set = rootsOf(plate(), {.count = 4000, .shortest = 1, .lengthMap = halves(glm::vec3(0.5F), glm::vec3(0))});
    EXPECT_LT(set.roots.size(), 4000u);
    for (const Root& root : set.roots) {
        const double u = static_cast<double>(root.position.x) / 100;
        const double ramp = u < 0.25 ? 0.25 + u : u < 0.75 ? 0.75 - u : u - 0.75; // bilinear, repeating
        EXPECT_NEAR(root.share, ramp, 1e-4) << u;
    }
}

TEST(RootMaps, lean_strands_in_tangent_space) {
    const RootSet set = rootsOf(plate(), {.count = 100, .lean = 0.5, .directionMap = halves({1, 0.5F, 1}, {1, 0.5F, 1})});
    for (const Root& root : set.roots)
        EXPECT_LT(glm::distance(root.lean, glm::vec3(0.5F, 0, 0)), 1e-5F)
            << "along the tangent; what points out of the surface is left out";
    const RootSet up = rootsOf(plate(), {.count = 100, .lean = 0.5, .directionMap = halves({0.5F, 1, 0.5F}, {0.5F, 1, 0.5F})});
    for (const Root& root : up.roots)
        EXPECT_LT(glm::distance(root.lean, glm::vec3(0, 0.5F, 0)), 1e-5F) << "+Y of a normal map: the bitangent, decreasing v";
}

TEST(RootMaps, as_cube_maps_need_no_texture_coordinates) {
    std::array<glm::vec3, 6> density;
    density.fill(glm::vec3(0));
    density[2] = glm::vec3(1); // +Y
    const RootSet set = rootsOf(ball(50), {.count = 6000, .densityMap = faces(density)});
    EXPECT_NEAR(static_cast<double>(set.roots.size()), 1000, 40) << "a face is a sixth of the sphere";
    for (const Root& root : set.roots)
        EXPECT_GE(root.normal.y, std::max(std::abs(root.normal.x), std::abs(root.normal.z)) - 1e-3F);
}

TEST(RootMaps, that_are_flat_need_texture_coordinates) {
    const auto set = makeRoots(ball(50), {.count = 100, .lengthMap = halves(glm::vec3(1), glm::vec3(1))});
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().diagnostics.front().code, 7106);
}

TEST(RootMaps, that_are_black_everywhere_leave_no_root) {
    const auto set = makeRoots(plate(), {.count = 100, .densityMap = halves(glm::vec3(0), glm::vec3(0))});
    ASSERT_TRUE(set);
    EXPECT_TRUE(set->roots.empty());
}
