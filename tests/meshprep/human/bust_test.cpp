#include "meshprep/human/bust.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument {
namespace {

constexpr std::uint32_t kAround = 8;

/// A body: a tube of `rings` rings of quads around y, one unit high each, from y = 10 down. The upper `headRings` are one chart, the others
/// another. Two cubes stand for the eyes.
QuadMesh tube(std::uint32_t rings, std::uint32_t headRings) {
    QuadMesh mesh;
    for (std::uint32_t row = 0; row <= rings; ++row)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kAround;
            mesh.positions.emplace_back(std::sin(angle), 10 - static_cast<float>(row), std::cos(angle));
        }
    for (std::uint32_t row = 0; row <= rings + 1; ++row) // the row where the charts meet has two sets of coordinates
        for (std::uint32_t i = 0; i <= kAround; ++i)
            mesh.uvs.emplace_back(i, row);
    for (std::uint32_t row = 0; row < rings; ++row)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t next = (i + 1) % kAround;
            const std::uint32_t uv = (row + (row >= headRings ? 1 : 0)) * (kAround + 1) + i;
            mesh.quads.push_back(
                {.position = {row * kAround + i, (row + 1) * kAround + i, (row + 1) * kAround + next, row * kAround + next},
                 .uv = {uv, uv + kAround + 1, uv + kAround + 2, uv + 1}});
        }
    mesh.groups.push_back({"body", 0, mesh.quads.size()});
    for (const char* name : {"helper-l-eye", "helper-r-eye"}) {
        QuadMesh eye = shapes::cube(0.1f);
        for (glm::vec3& p : eye.positions)
            p += glm::vec3(name[7] == 'l' ? 0.4f : -0.4f, 9, 1);
        mesh.groups.push_back({name, mesh.quads.size(), eye.quads.size()});
        shapes::append(mesh, eye);
    }
    return mesh;
}

TEST(Bust, the_neck_goes_on_below_the_head_for_whole_rings) {
    const Result<Bust> bust = takeBust(tube(8, 3), "a.obj", 2);
    ASSERT_TRUE(bust) << format(bust.error());
    const auto kept = std::ranges::count(bust->support, 0);
    EXPECT_EQ(kept, (3 + 2) * kAround + 12); // head, two rings, two cubes
}

TEST(Bust, one_ring_more_supports_the_cut) {
    const Result<Bust> bust = takeBust(tube(8, 3), "a.obj", 2);
    ASSERT_TRUE(bust);
    EXPECT_EQ(std::ranges::count(bust->support, 1), kAround);
}

TEST(Bust, eyes_are_parts_of_their_own) {
    const Result<Bust> bust = takeBust(tube(8, 3), "a.obj", 2);
    ASSERT_TRUE(bust);
    EXPECT_EQ(std::ranges::count(bust->parts, BustPart::LeftEye), 6);
    EXPECT_EQ(std::ranges::count(bust->parts, BustPart::RightEye), 6);
    EXPECT_GT(bust->eyes[0].centre.x, 0);
    EXPECT_LT(bust->eyes[1].centre.x, 0);
}

TEST(Bust, a_body_without_eyes_is_an_error) {
    QuadMesh body = tube(8, 3);
    body.groups[1].name = "helper-l-ear";
    const Result<Bust> bust = takeBust(body, "a.obj", 2);
    ASSERT_FALSE(bust);
    EXPECT_EQ(bust.error().diagnostics.front().code, 7004);
}

TEST(Bust, a_head_without_anything_below_is_an_error) {
    const Result<Bust> bust = takeBust(tube(3, 3), "a.obj", 2);
    ASSERT_FALSE(bust);
    EXPECT_EQ(bust.error().diagnostics.front().code, 7005);
}

TEST(EyeChart, the_axis_of_sight_is_the_origin) {
    EXPECT_EQ(eyeChart({.centre = glm::vec3(1, 2, 3), .radius = 5}, glm::vec3(1, 2, 8)), glm::vec2(0));
}

TEST(EyeChart, distance_from_the_origin_is_the_way_over_the_eyeball) {
    const Eyeball eye{.centre = glm::vec3(1, 2, 3), .radius = 5};
    const glm::vec2 quarter = eyeChart(eye, glm::vec3(1, 7, 3)); // straight up: a quarter of a great circle
    EXPECT_NEAR(quarter.x, 0, 1e-6f);
    EXPECT_NEAR(quarter.y, 5 * std::numbers::pi_v<float> / 2, 1e-5f); // a few roundings
}

} // namespace
} // namespace tegument
