// The roots' texture, read as a shader reads it, against all roots one by one.
#include "meshprep/fur/roots/root_texture.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include "meshprep/fur/roots/scatter.h"

#include <algorithm>
#include <set>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

class RootTextures : public testing::TestWithParam<double> {};

} // namespace

INSTANTIATE_TEST_SUITE_P(Reaches, RootTextures, testing::Values(0.3, 0.5, 1.5),
                         [](const auto& p) { return std::to_string(static_cast<int>(10 * p.param)); });

TEST_P(RootTextures, list_every_root_within_reach_of_any_place_of_the_surface) {
    const Built built = build(ball(50), {.count = 2000, .reach = GetParam()});
    const FurSurface surface(built.mesh);
    std::size_t within = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const glm::vec3 place = surface.toMesh(surface.point(rootNoise(i, 7)).position);
        const auto listed = rootsAround(built.texture.image, place);
        const std::set<std::size_t> found(listed.begin(), listed.end());
        EXPECT_EQ(found.size(), listed.size()) << "each once";
        for (std::size_t k = 0; k < built.set.roots.size(); ++k) {
            const double distance = glm::distance(glm::dvec3(built.set.roots[k].position), glm::dvec3(place));
            within += distance <= built.set.reach;
            const double farthest = built.set.reach + std::sqrt(3.0) * built.set.cell + 1e-3; // from the other end of the cell
            EXPECT_TRUE(found.contains(k) ? distance <= farthest : distance > built.set.reach) << "root " << k << " at " << distance;
        }
    }
    // pi reach^2 roots per place in units of the spacing: the test has looked at what it is about
    EXPECT_NEAR(static_cast<double>(within) / 2000, std::numbers::pi * GetParam() * GetParam(),
                0.1 * std::numbers::pi * GetParam() * GetParam());
}

TEST(RootTexture, has_no_list_longer_than_its_header_says) {
    const Built built = build(ball(50), {.count = 3000});
    const FurSurface surface(built.mesh);
    const float* header = &built.texture.image.pixels[4 * 2];
    std::size_t most = 0;
    for (std::uint64_t i = 0; i < 20000; ++i)
        most = std::max(most, rootsAround(built.texture.image, surface.toMesh(surface.point(rootNoise(i, 9)).position)).size());
    EXPECT_LE(most, 4 * static_cast<std::size_t>(header[3]));
    EXPECT_EQ(built.texture.mostTexels, static_cast<std::size_t>(header[3]));
    EXPECT_EQ(built.texture.mostTexels, (built.texture.mostListed + 3) / 4);
}

TEST(RootTexture, holds_each_root_as_it_is) {
    const Built built = build(ball(50), {.count = 1000, .lean = 0.7, .comb = {1, 0, 0}});
    for (std::size_t i = 0; i < built.set.roots.size(); ++i) {
        const Root& root = built.set.roots[i];
        const Root read = rootAt(built.texture.image, i);
        EXPECT_EQ(read.position, root.position);
        EXPECT_EQ(read.radius, root.radius);
        EXPECT_EQ(read.limit, root.limit);
        EXPECT_EQ(read.random, root.random);
        EXPECT_NEAR(read.share, root.share, 1e-6); // packed into a length: a few roundings
        EXPECT_NEAR(read.curl, root.curl, 1e-6);
        EXPECT_LT(glm::distance(read.normal, root.normal), 1e-6F);
        EXPECT_LT(glm::distance(read.lean, root.lean), 1e-6F);
    }
}

TEST(RootTexture, keeps_the_texels_of_a_root_in_one_row) {
    const Built built = build(ball(50), {.count = 3000}); // more than the 1,365 of one row
    const auto first = static_cast<std::size_t>(built.texture.image.at(6, 0, 0));
    EXPECT_EQ(first % kRootColumns, 0u);
    std::set<std::size_t> addresses;
    for (const Root& root : built.set.roots)
        for (std::size_t i = first; i + 2 < built.texture.texels; ++i)
            if (built.texture.image.pixels[4 * i] == root.position.x && built.texture.image.pixels[4 * i + 3] == root.radius)
                addresses.insert(i);
    EXPECT_EQ(addresses.size(), 3000u);
    for (const std::size_t address : addresses)
        EXPECT_LE(address % kRootColumns, kRootColumns - kRootTexels);
}

TEST(RootTexture, tells_in_its_first_row_what_is_in_it) {
    const Built built = build(ball(50), {.count = 1000, .shortest = 0.5, .lean = 0.4});
    const auto texel = [&](std::size_t i) {
        return glm::vec4(built.texture.image.at(static_cast<int>(i), 0, 0), built.texture.image.at(static_cast<int>(i), 0, 1),
                         built.texture.image.at(static_cast<int>(i), 0, 2), built.texture.image.at(static_cast<int>(i), 0, 3));
    };
    EXPECT_FLOAT_EQ(texel(0).w, static_cast<float>(built.set.cell));
    EXPECT_EQ(texel(2).x, static_cast<float>(built.texture.image.height));
    EXPECT_EQ(texel(2).z, 1000);
    EXPECT_FLOAT_EQ(texel(3).x, static_cast<float>(built.set.reach));
    EXPECT_FLOAT_EQ(texel(3).w, static_cast<float>(1000 / built.set.area));
    EXPECT_NEAR(texel(4).w, 50, 1e-3);
    EXPECT_NEAR(texel(5).x, 0.5, 0.01) << "the least of a thousand shares between 0.5 and 1";
    EXPECT_NEAR(texel(5).y, 0.75, 0.03);
    EXPECT_NEAR(texel(5).z, 0.4, 0.01) << "round the equator strands lean as far as asked for";
}

TEST(RootTexture, has_nothing_outside_of_its_grid) {
    const Built built = build(ball(50), {.count = 1000});
    for (const glm::vec3& place : {glm::vec3(1000, 0, 0), glm::vec3(0, -1000, 0), glm::vec3(0, 0, 1e30F), glm::vec3(0)})
        EXPECT_TRUE(rootsAround(built.texture.image, place).empty());
}

TEST(RootTexture, takes_larger_bricks_where_parts_are_far_apart) {
    Mesh mesh = ball(1, 16);
    Mesh far = ball(1, 16);
    const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t i = 0; i < far.positions.size(); ++i) {
        mesh.positions.push_back(far.positions[i] + 150.0F);
        mesh.normals.push_back(far.normals[i]);
    }
    for (const std::uint32_t index : far.indices)
        mesh.indices.push_back(index + shift);
    const Built built = build(finished(std::move(mesh)), {.count = 2000});
    EXPECT_GT(built.texture.brick, 4);
    for (std::size_t i = 0; i < built.set.roots.size(); ++i) {
        const auto found = rootsAround(built.texture.image, built.set.roots[i].position);
        EXPECT_TRUE(std::ranges::count(found, i) == 1) << i;
    }
}

TEST(RootTexture, that_would_be_too_large_is_refused) {
    const Mesh mesh = ball(50);
    auto many = makeRoots(mesh, {.count = 40'000, .spacing = 0.1, .radius = 0.2, .reach = 4, .cell = 0.25});
    ASSERT_TRUE(many);
    const auto texture = buildRootTexture(*many);
    ASSERT_FALSE(texture);
    EXPECT_EQ(texture.error().diagnostics.front().code, 7107);

    Mesh apart = ball(1, 16);
    for (std::size_t i = apart.positions.size() / 2; i < apart.positions.size(); ++i)
        apart.positions[i] += 1.0F; // a tear; and one triangle a million radii away
    apart.positions.insert(apart.positions.end(), {{1e6F, 1e6F, 1e6F}, {1e6F + 1, 1e6F, 1e6F}, {1e6F, 1e6F + 1, 1e6F}});
    apart.normals.insert(apart.normals.end(), 3, glm::vec3(0, 0, 1));
    const auto n = static_cast<std::uint32_t>(apart.positions.size());
    apart.indices.insert(apart.indices.end(), {n - 3, n - 2, n - 1});
    auto far = makeRoots(finished(std::move(apart)), {.count = 5000, .spacing = 0.1});
    ASSERT_TRUE(far) << format(far.error());
    const auto sparse = buildRootTexture(*far);
    ASSERT_FALSE(sparse);
    EXPECT_EQ(sparse.error().diagnostics.front().code, 7107);
}
