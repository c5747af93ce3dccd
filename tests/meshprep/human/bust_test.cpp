// What the file's form is made into: a neck that ends, ears as sharp as they were modelled, lids over the cornea.

#include "meshprep/human/bust.h"
#include "meshprep/human/cut.h"
#include "meshprep/human/ears.h"
#include "meshprep/human/exterior.h"
#include "meshprep/human/neck.h"
#include "meshprep/human/subdivide.h"
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

TEST(Exterior, every_face_of_a_cube_is_seen) {
    const QuadMesh cube = shapes::cube(1);
    EXPECT_EQ(std::ranges::count(seenFromOutside(cube.positions, cube.quads), 1), 6);
}

TEST(Exterior, a_cube_inside_a_closed_cube_is_not_seen) {
    QuadMesh mesh = shapes::cube(2);
    shapes::append(mesh, shapes::cube(1));
    EXPECT_EQ(seenFromOutside(mesh.positions, mesh.quads), (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0}));
}

TEST(Exterior, a_cube_inside_an_open_box_is_seen_from_the_opening_only) {
    QuadMesh mesh = shapes::cube(2);
    mesh.quads.erase(mesh.quads.begin() + 3); // the face at +y
    shapes::append(mesh, shapes::cube(1.9f));
    const std::vector<std::uint8_t> seen = seenFromOutside(mesh.positions, mesh.quads);
    EXPECT_EQ(seen[5 + 3], 1); // +y
    EXPECT_EQ(seen[5 + 2], 0); // -y
}

TEST(Exterior, cracks_do_not_open_a_cavity) {
    QuadMesh mesh = shapes::cube(2);
    shapes::append(mesh, shapes::cube(1.9f));
    for (std::uint32_t& corner : mesh.quads[3].position) { // the lid gets corners of its own, moved aside by 0.01
        mesh.positions.push_back(mesh.positions[corner] + glm::vec3(0.01f, 0, 0));
        corner = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }
    const std::vector<std::uint8_t> seen = seenFromOutside(mesh.positions, mesh.quads);
    EXPECT_EQ(std::ranges::count(seen.begin() + 6, seen.end(), 1), 0);
}

/// A row of quads of which the first is seen.
std::vector<std::uint8_t> hiddenInRow(std::size_t leastPatch, float rim) {
    QuadMesh row;
    for (std::uint32_t x = 0; x <= 10; ++x) {
        row.positions.emplace_back(x, 0, 0);
        row.positions.emplace_back(x, 1, 0);
    }
    for (std::uint32_t x = 0; x < 10; ++x)
        row.quads.push_back({.position = {2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1}});
    std::vector<std::uint8_t> seen(10, 0);
    seen[0] = 1;
    return hiddenPatches(row.positions, row.quads, seen, leastPatch, rim);
}

TEST(Exterior, a_rim_of_hidden_faces_stays_beside_the_seen_ones) {
    EXPECT_EQ(hiddenInRow(1, 2.5f), (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
}

TEST(Exterior, small_hidden_patches_stay) {
    EXPECT_EQ(std::ranges::count(hiddenInRow(10, 0.5f), 1), 0);
}

TEST(EdgeWays, lengths_run_along_edges) {
    const QuadMesh grid = shapes::grid(3);
    const EdgeWays ways = waysAlongEdges(grid.positions, grid.quads, {0}, 100);
    EXPECT_FLOAT_EQ(ways.length[15], 6); // three to the right, three up: no diagonal
}

TEST(EdgeWays, every_vertex_knows_its_nearest_source) {
    const QuadMesh grid = shapes::grid(3);
    const EdgeWays ways = waysAlongEdges(grid.positions, grid.quads, {0, 15}, 100);
    EXPECT_EQ(ways.source[1], 0u);
    EXPECT_EQ(ways.source[14], 15u);
}

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
    masks.ears = {.width = 1, .height = 1, .channels = 1, .pixels = {1}, .bitsPerChannel = 8};
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
