// Meshes that face the wrong way are told: nothing else says why a picture is bald and dark.
#include "host/mesh/facing.h"
#include "host/mesh/welding.h"
#include "tests/mesh/files.h"

#include <cmath>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

using FacingFiles = SceneFiles;

constexpr const char* kCorners = "v 0 0 0\nv 90 0 0\nv 90 90 0\nv 0 90 0\nv 0 0 90\nv 90 0 90\nv 90 90 90\nv 0 90 90\n";
constexpr const char* kOutwards = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
constexpr const char* kInwards = "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
constexpr const char* kMixed = "f 4 3 2 1\nf 8 7 6 5\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

int codeAmong(const Result<Mesh>& mesh) {
    EXPECT_TRUE(mesh);
    for (const Diagnostic& warning : mesh ? mesh->warnings : std::vector<Diagnostic>{})
        if (warning.code >= 5332 && warning.code <= 5334) return warning.code;
    return 0;
}

} // namespace

TEST_F(FacingFiles, a_mesh_inside_out_is_told_with_what_turns_it) {
    EXPECT_EQ(codeAmong(load("a.obj", std::string(kCorners) + kOutwards)), 0);
    const auto mesh = load("a.obj", std::string(kCorners) + kInwards);
    EXPECT_EQ(codeAmong(mesh), 5332);
    EXPECT_NE(mesh->warnings.back().hint.find("--orient"), std::string::npos);
}

TEST_F(FacingFiles, neighbours_that_face_opposite_ways_are_told) {
    EXPECT_EQ(codeAmong(load("a.obj", std::string(kCorners) + kMixed)), 5333);
}

TEST_F(FacingFiles, a_surface_that_is_there_once_for_each_side_is_told) {
    EXPECT_EQ(codeAmong(load("a.obj", std::string(kCorners) + kOutwards + "f 4 1 2 3\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\n")), 5334);
}

TEST_F(FacingFiles, triangles_with_two_corners_at_one_place_are_no_doubles) {
    EXPECT_EQ(codeAmong(load(
                  "a.obj", std::string(kCorners) +
                               "v 0 0 0\nv 0 0 0\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
                               "f 4 1 5 8\n" +
                               [] {
                                   std::string flat;
                                   for (int i = 0; i < 40; ++i)
                                       flat += "f 1 9 10\n";
                                   return flat;
                               }())),
              0);
}

TEST_F(FacingFiles, what_is_flat_or_open_is_not_judged_by_its_sides) {
    EXPECT_EQ(codeAmong(load("a.obj", "v 0 0 0\nv 90 0 0\nv 90 90 0\nv 0 90 0\nf 1 2 3 4\n")), 0) << "a square";
    EXPECT_EQ(codeAmong(load("b.obj", "v 0 0 0\nv 90 0 0\nv 90 90 0\nv 0 90 0\nf 4 3 2 1\n")), 0) << "its back";
    EXPECT_EQ(codeAmong(load("c.obj", "v 0 0 0\nv 90 0 0\nv 90 0 90\nv 0 0 90\nv 45 -10 45\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n")), 0)
        << "a hollow in the ground, seen from above";
}

TEST_F(FacingFiles, a_mesh_far_from_the_origin_is_judged_as_well) {
    EXPECT_EQ(
        codeAmong(load("a.obj", "v 500000 4000000 0\nv 500090 4000000 0\nv 500090 4000090 0\nv 500000 4000090 0\nv 500000 4000000 90\n"
                                "v 500090 4000000 90\nv 500090 4000090 90\nv 500000 4000090 90\n" +
                                    std::string(kInwards))),
        5332);
}

TEST(FacingOfMeshes, a_ball_has_one_and_inside_out_minus_one) {
    Mesh ball; // twenty triangles round each pole are enough to be near
    constexpr int kSteps = 40;
    for (int j = 0; j <= kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const double a = 2 * 3.14159265358979 * i / kSteps;
            const double b = 3.14159265358979 * j / kSteps;
            ball.positions.emplace_back(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
        }
    for (std::uint32_t j = 0; j < kSteps; ++j)
        for (std::uint32_t i = 0; i < kSteps; ++i) {
            const std::uint32_t a = j * kSteps + i;
            const std::uint32_t b = j * kSteps + (i + 1) % kSteps;
            for (const std::uint32_t index : {a, b, b + kSteps, a, b + kSteps, a + kSteps})
                ball.indices.push_back(index);
        }
    const Facing seen = examineFacing(ball, weldPositions(ball.positions));
    EXPECT_NEAR(seen.outward, 1, 0.01) << "the steps of nine degrees cost less than this";
    EXPECT_EQ(seen.opposed, 0);
    EXPECT_EQ(seen.doubled, 0);
    for (std::size_t i = 0; i < ball.indices.size(); i += 3)
        std::swap(ball.indices[i], ball.indices[i + 1]);
    EXPECT_NEAR(outwardFacing(ball), -1, 0.01);
}
