// Grooms bound to a skin.

#include "meshprep/groom/bind.h"

#include "meshprep/fur/ribbons/ribbons.h"
#include "tests/meshprep/groom/grooms.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace tegument;
using namespace tegument::test;

namespace {

constexpr float kPi = 3.14159265F;

/// A ball of 100 mm whose facets lie up to 0.5 mm inside of it.
Mesh ball() {
    Mesh mesh;
    constexpr std::uint32_t kAround = 64, kDown = 32;
    for (std::uint32_t y = 0; y <= kDown; ++y)
        for (std::uint32_t x = 0; x <= kAround; ++x) {
            const float down = kPi * static_cast<float>(y) / kDown, around = 2 * kPi * static_cast<float>(x) / kAround;
            const glm::vec3 n(std::sin(down) * std::sin(around), std::cos(down), std::sin(down) * std::cos(around));
            mesh.positions.push_back(100.0F * n);
            mesh.normals.push_back(n);
            const std::uint32_t a = y * (kAround + 1) + x, b = a + kAround + 1;
            if (x < kAround && y < kDown) mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    mesh.parts = {{.name = "skin", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

} // namespace

TEST(BoundGroom, stands_on_the_skin_and_keeps_its_curves) {
    Mesh mesh = ball();
    const Groom groom = strandsOf(madeGroom(200), [guides = madeGroom(200).guides](std::size_t i) { return guides[i] == 0; });
    BoundFigures figures;
    const auto roots = bindGroom(mesh, groom, {}, figures);
    ASSERT_TRUE(roots) << format(roots.error());
    EXPECT_EQ(figures.strands, groom.strands());
    EXPECT_EQ(figures.off, 0U);
    EXPECT_GT(figures.moved, 0.01);
    EXPECT_LT(figures.error, 0.1) << "the issue's limit; floats leave 1e-5";
    EXPECT_FALSE(whyNotItsRoots(mesh, *roots));
    const auto again = groomOfRoots(mesh, *roots, 1);
    ASSERT_TRUE(again);
    ASSERT_EQ(again->strands(), groom.strands());
    for (std::size_t i = 0; i < groom.strands(); ++i) {
        const glm::vec3 moved = again->strand(i).front() - groom.strand(i).front();
        EXPECT_NEAR(glm::length(again->strand(i).front()), 100, 0.6);
        for (const glm::vec3& p : groom.strand(i)) { // each point of it is a point of the curve that is drawn
            float least = 1e9F;
            for (const glm::vec3& q : again->strand(i))
                least = std::min(least, glm::distance(p + moved, q));
            EXPECT_LT(least, 5e-4F * 40) << "share of its length";
        }
        EXPECT_NEAR(again->widths[again->first[i]], 0.08F, 1e-4F);
    }
    const auto part = std::ranges::find(mesh.parts, kStrandsPart, &MeshPart::name);
    ASSERT_NE(part, mesh.parts.end());
    EXPECT_EQ(part->indexCount, groom.strands() * 6 * (figures.points - 1));
}

TEST(BoundGroom, says_what_stands_off_what_is_resampled_and_what_guides) {
    Mesh mesh = ball();
    Groom groom = madeGroom(20, 100);
    for (std::size_t k = 0; k < 100; ++k)
        groom.points[groom.first[7] + k] += glm::vec3(0, 50, 0);
    BoundFigures figures;
    ASSERT_TRUE(bindGroom(mesh, groom, {.width = 0.2}, figures));
    EXPECT_EQ(figures.guides, 4U);
    EXPECT_EQ(figures.off, 1U);
    EXPECT_EQ(figures.points, kMostCurvePoints);
    EXPECT_EQ(figures.resampled, 16U);
    EXPECT_GT(figures.resampledError, 0);
    EXPECT_LT(figures.resampledError, 0.1);
}

TEST(BoundGroom, without_a_skin_stands_alone) {
    Mesh mesh;
    BoundFigures figures;
    const auto roots = bindGroom(mesh, madeGroom(300), {}, figures);
    ASSERT_TRUE(roots) << format(roots.error());
    EXPECT_TRUE(figures.madeSkin);
    EXPECT_EQ(figures.off, 0U);
    EXPECT_NEAR(mesh.bounds.radius, 100, 1.5);
    EXPECT_LT(glm::distance(mesh.positions[0], mesh.positions[1]), 1) << "too small to be seen";
}

TEST(BoundGroom, of_more_strands_than_a_texture_holds_is_refused) {
    Groom groom;
    for (int i = 0; i < 3'500'000; ++i) {
        groom.points.insert(groom.points.end(), {glm::vec3(i, 0, 0), glm::vec3(i, 1, 0)});
        groom.endStrand();
    }
    Mesh mesh;
    BoundFigures figures;
    const auto roots = bindGroom(mesh, std::move(groom), {}, figures);
    ASSERT_FALSE(roots);
    EXPECT_EQ(roots.error().diagnostics.front().code, 7110);
}
