// Where roots stand and how long their strands may be, on meshes for which that is known.
#include "meshprep/fur/roots/roots.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include <algorithm>
#include <array>
#include <limits>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

int codeOf(const Mesh& mesh, const RootOptions& options) {
    const auto set = makeRoots(mesh, options);
    return set ? 0 : set.error().diagnostics.front().code;
}

/// Least distance of two roots whose normals are within 90 degrees.
double leastDistance(const RootSet& set) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < set.roots.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (glm::dot(set.roots[i].normal, set.roots[k].normal) > 0)
                least = std::min(least, glm::distance(glm::dvec3(set.roots[i].position), glm::dvec3(set.roots[k].position)));
    return least;
}

/// So that every length is the limit.
RootOptions few(std::size_t count) {
    return {.count = count};
}

} // namespace

TEST(SurfacePoints, are_even_within_a_triangle) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {10, 0, 0}, {0, 30, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.indices = {0, 1, 2};
    const Mesh triangle = finished(std::move(mesh));
    const FurSurface surface(triangle);
    constexpr int kPoints = 10'000;
    std::array<int, 3> corners{};
    for (std::uint64_t i = 0; i < kPoints; ++i) {
        const SurfacePoint point = surface.point(rootNoise(i, 3));
        const glm::vec3 weights(1 - point.barycentric.x - point.barycentric.y, point.barycentric);
        for (glm::length_t c = 0; c < 3; ++c)
            corners[static_cast<std::size_t>(c)] += weights[c] > 0.5F;
    }
    for (const int count : corners) // a quarter of the area lies beyond the middle towards each corner; five sigma
        EXPECT_NEAR(count, kPoints * 0.25, 5 * std::sqrt(kPoints * 0.25 * 0.75));
}

TEST(Roots, are_as_many_as_asked_for) {
    EXPECT_EQ(rootsOf(ball(50), few(3000)).roots.size(), 3000u);
    // 4 pi 50^2 less what the cut of 64 rows loses, 0.2 %
    const RootSet dense = rootsOf(ball(50), {.density = 0.1});
    EXPECT_NEAR(static_cast<double>(dense.roots.size()), 0.1 * 4 * std::numbers::pi * 2500, 0.002 * 3142);
}

TEST(Roots, keep_their_distance) {
    for (const Mesh& mesh : {ball(50), plate()}) {
        const RootSet set = rootsOf(mesh, few(2000));
        EXPECT_GE(leastDistance(set), set.distance * (1 - 1e-5)) << "but for rounding in unit space";
        EXPECT_NEAR(set.distance, 0.72 * std::sqrt(set.area / 2000), 1e-6 * set.distance);
    }
}

TEST(Roots, move_closer_where_the_surface_is_rougher_than_they_are_apart) {
    Mesh mesh = ball(50, 400);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) // wrinkles finer than half the distance: 1.6 times the area in the same room
        mesh.positions[i] *= 1 + 0.01F * static_cast<float>(i % 801 % 2);
    const Mesh rough = finished(std::move(mesh));
    const RootSet set = rootsOf(rough, few(20'000));
    EXPECT_EQ(set.roots.size(), 20'000u);
    EXPECT_LT(set.distance, 0.71 * std::sqrt(set.area / 20'000));
    EXPECT_GE(leastDistance(set), set.distance * (1 - 1e-5));
}

TEST(Roots, are_as_dense_where_the_surface_is_rough_as_where_it_is_smooth) {
    Mesh mesh = ball(50, 400);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) // as above, on one half
        if (mesh.positions[i].y > 0) mesh.positions[i] *= 1 + 0.01F * static_cast<float>(i % 801 % 2);
    const Mesh half = finished(std::move(mesh));
    double area = 0;
    double rough = 0;
    for (std::size_t i = 0; i < half.indices.size(); i += 3) {
        const auto at = [&](std::size_t c) { return glm::dvec3(half.positions[half.indices[i + c]]); };
        const double own = glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) / 2;
        area += own;
        rough += at(0).y + at(1).y + at(2).y > 0 ? own : 0;
    }
    const RootSet set = rootsOf(half, few(20'000));
    const auto there = std::ranges::count_if(set.roots, [](const Root& root) { return root.position.y > 0; });
    EXPECT_NEAR(static_cast<double>(there) / (20'000 * rough / area), 1, 0.02) << "random discs alone put 23 % fewer there";
}

TEST(Roots, lie_on_the_surface) {
    for (const Root& root : rootsOf(plate(), few(500)).roots) {
        EXPECT_NEAR(root.position.z, 0, 1e-4);
        EXPECT_TRUE(root.position.x >= -1e-4F && root.position.x <= 100.0001F && root.position.y >= -1e-4F && root.position.y <= 100.0001F);
    }
}

TEST(Roots, are_as_dense_on_large_triangles_as_on_small_ones) {
    std::array<double, 16> strips{};
    const RootSet set = rootsOf(plate(), few(8000));
    for (const Root& root : set.roots)
        strips[std::min<std::size_t>(15, static_cast<std::size_t>(root.position.x / 100 * 16))] += 1;
    // 500 a strip. Discs of this distance leave a variance of 0.13 of the mean within, and as much again at two borders: 5 sigma are 60.
    for (const double count : strips)
        EXPECT_NEAR(count, 500, 60);
}

TEST(Roots, are_the_same_for_any_number_of_threads) {
    const Mesh mesh = ball(50);
    const RootSet one = rootsOf(mesh, {.count = 5000, .threads = 1});
    const RootSet many = rootsOf(mesh, {.count = 5000, .threads = 7});
    ASSERT_EQ(one.roots.size(), many.roots.size());
    for (std::size_t i = 0; i < one.roots.size(); ++i) {
        EXPECT_EQ(one.roots[i].position, many.roots[i].position);
        EXPECT_EQ(one.roots[i].random, many.roots[i].random);
        EXPECT_EQ(one.roots[i].limit, many.roots[i].limit);
    }
}

TEST(Roots, of_another_seed_stand_elsewhere) {
    const RootSet a = rootsOf(plate(), {.count = 100, .seed = 1});
    const RootSet b = rootsOf(plate(), {.count = 100, .seed = 2});
    std::size_t same = 0;
    for (const Root& root : a.roots)
        same += std::ranges::count(b.roots, root.position, &Root::position) > 0;
    EXPECT_EQ(same, 0u);
}

TEST(Roots, stand_on_both_sides_of_a_thin_sheet) {
    Mesh mesh;
    addPlate(mesh, 0.01);
    addPlate(mesh, 0, true);
    const RootSet set = rootsOf(finished(std::move(mesh)), few(2000));
    ASSERT_EQ(set.roots.size(), 2000u);
    const auto up = std::ranges::count_if(set.roots, [](const Root& root) { return root.normal.z > 0; });
    EXPECT_NEAR(set.distance, 0.72 * std::sqrt(set.area / 2000), 1e-6 * set.distance) << "the other side takes no room";
    EXPECT_NEAR(static_cast<double>(up), 1000, 60) << "each side has half of the area; 60 is what independent places stray by at most";
}

TEST(Roots, of_a_mesh_a_billion_times_as_large_are_a_billion_times_as_far_apart) {
    const RootSet small = rootsOf(ball(1e-3), few(1000));
    const RootSet large = rootsOf(ball(1e6), few(1000));
    ASSERT_EQ(small.roots.size(), large.roots.size());
    for (std::size_t i = 0; i < small.roots.size(); ++i) // floats of two sizes round differently
        EXPECT_LT(glm::distance(1e9 * glm::dvec3(small.roots[i].position), glm::dvec3(large.roots[i].position)), 1e6 * 1e-5);
    EXPECT_NEAR(small.distance * 1e9, large.distance, 1e-5 * large.distance);
}

TEST(RootLengths, are_limited_by_the_radius_of_a_hollow) {
    // From inside a sphere, normals meet in its centre; the other side is 2 r away, its half r.
    for (const Root& root : rootsOf(ball(50, 64, true), few(3000)).roots)
        EXPECT_NEAR(root.limit, 0.8 * 50, 0.03 * 40) << "curvature from a dozen neighbours on a cut sphere";
}

TEST(RootLengths, are_limited_by_nothing_on_a_ball) {
    for (const Root& root : rootsOf(ball(50), few(1000)).roots)
        EXPECT_NEAR(root.limit, 50, 1e-3) << "but by the size of the mesh";
}

TEST(RootLengths, end_half_way_to_the_sheet_opposite) {
    Mesh mesh;
    addPlate(mesh, 0);
    addPlate(mesh, 12, true);
    const RootSet set = rootsOf(finished(std::move(mesh)), {.count = 1000, .furLength = 0.5});
    for (const Root& root : set.roots)
        EXPECT_NEAR(root.limit, 6, 1e-3);
    EXPECT_EQ(set.shortenedByOpposite, set.roots.size()) << "a coat of half a radius, 35 mm, and shares of 0.7 and more";
}

TEST(RootLengths, of_a_cylinder_s_inside_follow_the_narrow_direction) {
    Mesh mesh;
    constexpr int kSides = 96;
    for (int j = 0; j <= 20; ++j)
        for (int i = 0; i <= kSides; ++i) {
            const double phi = 2 * std::numbers::pi * i / kSides;
            mesh.positions.emplace_back(20 * std::cos(phi), 20 * std::sin(phi), 5 * j);
            mesh.normals.emplace_back(-std::cos(phi), -std::sin(phi), 0);
        }
    addGrid(mesh.indices, kSides, 20, "adbacd");
    for (const Root& root : rootsOf(finished(std::move(mesh)), few(4000)).roots)
        EXPECT_NEAR(root.limit, 0.8 * 20, 0.03 * 16);
}

TEST(Strands, lean_along_the_surface_towards_the_comb) {
    for (const Root& root : rootsOf(ball(50), {.count = 500, .lean = 0.5, .comb = {0, -2, 0}}).roots) {
        EXPECT_NEAR(glm::dot(root.lean, root.normal), 0, 1e-5);
        EXPECT_LE(root.lean.y, 1e-6F);
        const double sine = std::sqrt(std::max(0.0F, 1 - root.normal.y * root.normal.y));
        EXPECT_NEAR(glm::length(root.lean), 0.5 * sine, 1e-5);
    }
}

TEST(Strands, differ_within_the_limits_that_were_given) {
    const RootSet set = rootsOf(ball(50), {.count = 4000, .radius = 0.3, .thinnest = 0.5, .shortest = 0.6, .curl = 0.4});
    double shares = 0;
    for (const Root& root : set.roots) {
        EXPECT_TRUE(root.share >= 0.6F && root.share <= 1);
        EXPECT_TRUE(root.radius >= 0.499999 * set.radius && root.radius <= 1.000001 * set.radius);
        EXPECT_TRUE(root.curl >= 0 && root.curl <= 0.4F);
        EXPECT_EQ(root.random * 16777216, std::floor(root.random * 16777216)) << "a multiple of 2^-24";
        shares += static_cast<double>(root.share);
    }
    EXPECT_NEAR(shares / 4000, 0.8, 5 * 0.4 / std::sqrt(12 * 4000.0)) << "even between 0.6 and 1: 5 sigma of the mean";
}

TEST(RootErrors, name_the_option_that_makes_no_sense) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(codeOf(plate(), {.count = 0}), 7103);
    EXPECT_EQ(codeOf(plate(), {.spacing = 2}), 7103);
    EXPECT_EQ(codeOf(plate(), {.radius = nan}), 7103);
    EXPECT_EQ(codeOf(plate(), {.radius = 1, .reach = 0.5}), 7103);
    EXPECT_EQ(codeOf(plate(), {.density = -1}), 7103);
}

TEST(RootErrors, refuse_a_billion_roots_at_once) {
    EXPECT_EQ(codeOf(plate(), {.count = 1'000'000'000}), 7104);
    EXPECT_EQ(codeOf(plate(), {.density = 1e5}), 7104);
    EXPECT_EQ(codeOf(plate(), {.density = 1e-5}), 7104) << "a tenth of a root";
}

TEST(RootErrors, tell_that_there_is_no_area) {
    Mesh flat = plate();
    for (glm::vec3& p : flat.positions)
        p.y = 0;
    EXPECT_EQ(codeOf(finished(std::move(flat)), {}), 7105);
    Mesh nan = plate();
    nan.positions[0].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(codeOf(nan, {}), 7105);
}

TEST(Roots, leave_triangles_without_area_alone) {
    Mesh mesh = plate();
    const std::size_t before = mesh.indices.size() / 3;
    for (std::uint32_t i = 0; i < 100; ++i)
        mesh.indices.insert(mesh.indices.end(), {i, i, i + 1});
    for (const Root& root : rootsOf(finished(std::move(mesh)), few(2000)).roots)
        EXPECT_LT(root.triangle, before);
}

TEST(Roots, stand_where_normals_are_zero) {
    Mesh mesh = plate();
    mesh.normals.assign(mesh.normals.size(), glm::vec3(0));
    for (const Root& root : rootsOf(mesh, few(500)).roots)
        EXPECT_EQ(root.normal, glm::vec3(0, 0, 1)) << "that of the triangle";
}
