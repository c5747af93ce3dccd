// What the file's form is made into: a neck that ends, ears as sharp as they were modelled, lids over the cornea.

#include "meshprep/human/ears.h"
#include "meshprep/human/neck.h"
#include "meshprep/human/subdivide.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument {
namespace {

Bust bustOf(const QuadMesh& mesh) {
    return {.positions = mesh.positions,
            .uvs = mesh.uvs,
            .quads = mesh.quads,
            .parts = std::vector<BustPart>(mesh.quads.size(), BustPart::Skin),
            .support = std::vector<std::uint8_t>(mesh.quads.size(), 0),
            .eyes = {Eyeball{.centre = glm::vec3(31, 60, 0), .radius = 15}, Eyeball{.centre = glm::vec3(-31, 60, 0), .radius = 15}}};
}

/// A neck of 50 mm that widens into shoulders below y = -40; its chin, a point in front, is at y = 0.
Bust shoulders() {
    constexpr std::uint32_t kAround = 24;
    QuadMesh mesh;
    for (std::uint32_t row = 0; row < 12; ++row)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const float y = -10 * static_cast<float>(row);
            const float radius = 50 + (y < -40 ? 2 * (-40 - y) : 0.0f);
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kAround;
            mesh.positions.emplace_back(radius * std::sin(angle), y, radius * std::cos(angle));
            mesh.uvs.emplace_back(i, row);
        }
    for (std::uint32_t row = 0; row + 1 < 12; ++row)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t next = (i + 1) % kAround;
            const std::array<std::uint32_t, 4> corners = {row * kAround + i, (row + 1) * kAround + i, (row + 1) * kAround + next,
                                                          row * kAround + next};
            mesh.quads.push_back({.position = corners, .uv = corners});
        }
    Bust bust = bustOf(mesh);
    for (Eyeball& eye : bust.eyes)
        eye.centre.z = 49.9f; // of the middle of the front, the lowest point before the eyes: at the bottom row
    return bust;
}

TEST(Neck, goes_down_as_wide_as_it_is) {
    Bust bust = shoulders();
    const Bust before = bust;
    // The shoulders' front is this shape's chin, 110 mm under the neck's top: 85 above it the neck is 50 wide.
    const float farthest = straightenNeck(bust, -85);
    EXPECT_GT(farthest, 60);
    for (std::size_t v = 0; v < bust.positions.size(); ++v) {
        const glm::vec3& p = bust.positions[v];
        const float below = std::max(0.0f, -25 - p.y);
        EXPECT_LE(std::hypot(p.x, p.z), 50 * (1.12f + 0.1f * below / 24) + 0.1f) << p.y;
        EXPECT_EQ(p.y, before.positions[v].y);
        if (p.y > -25) { // what lies above stays
            EXPECT_EQ(p, before.positions[v]);
        }
    }
}

TEST(Neck, a_bust_without_one_stays_as_it_is) {
    Bust bust = bustOf(shapes::grid(4));
    const Bust before = bust;
    EXPECT_EQ(straightenNeck(bust, 500), 0);
    EXPECT_EQ(bust.positions, before.positions);
}

/// The height of the limit surface of a plane with a ridge of one row of control points, as a share of the ridge's.
double ridgeLeft(float times) {
    constexpr std::uint32_t kSide = 12;
    constexpr float kMiddle = 6;
    static_assert(2 * kMiddle == kSide);
    Bust bust = bustOf(shapes::grid(kSide));
    for (glm::vec3& p : bust.positions)
        if (p.x == kMiddle) p.z = 1;
    RegionMasks masks;
    masks.ears = {.width = 1, .height = 1, .channels = 1, .pixels = {1}, .bitsPerChannel = 8, .metadata = {}};
    sharpenEars(bust, masks, times);
    const Result<Subdivided> fine = subdivide(bust.positions, bust.uvs, bust.quads, 2);
    EXPECT_TRUE(fine);
    float highest = 0;
    for (const glm::vec3& p : fine->positions)
        if (std::abs(p.y - kMiddle) < 1) highest = std::max(highest, p.z); // away from the plane's border
    return static_cast<double>(highest);
}

TEST(Ears, subdivision_takes_less_of_what_was_modelled) {
    // By hand, with the limit's weights 16, 4, 1 over 36: 2/3 of the ridge; with `times` t, 1 + t/3 on it and -t/6 beside it.
    for (const double t : {0.0, 1.0, 1.6})
        EXPECT_NEAR(ridgeLeft(static_cast<float>(t)), (24 * (1 + t / 3) - 12 * t / 6) / 36, 1e-4) << t;
}

TEST(Ears, what_is_no_ear_stays_as_it_is) {
    Bust bust = bustOf(shapes::grid(9));
    bust.positions[44].z = 1;
    const Bust before = bust;
    EXPECT_EQ(sharpenEars(bust, {}, 1), 0);
    EXPECT_EQ(bust.positions, before.positions);
}

TEST(Lids, are_raised_by_as_much_as_the_cornea_stands_out) {
    Bust bust = bustOf(shapes::grid(1));
    const Eyeball& eye = bust.eyes[0];
    bust.positions = {eye.centre + glm::vec3(0, 0, 15.5f), eye.centre + glm::vec3(0, 0, 40), eye.centre + glm::vec3(0, 0, -15.5f),
                      eye.centre + glm::vec3(15.5f, 0, 0.1f)};
    const Bust before = bust;
    raiseLids(bust);
    EXPECT_NEAR(bust.positions[0].z - before.positions[0].z, eyeSurface(eye, glm::vec3(0, 0, 1)) - eye.radius, 1e-4f);
    for (std::size_t v = 1; v < 4; ++v)
        EXPECT_LT(glm::distance(bust.positions[v], before.positions[v]), 1e-3f) << v;
}

} // namespace
} // namespace tegument
