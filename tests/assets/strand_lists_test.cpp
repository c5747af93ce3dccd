// Which ribbons a pass is given: none that a shader would draw is left out, and most of those that it would not.

#include "meshprep/assets/strand_lists.h"
#include "meshprep/assets/strand_passes.h"
#include "meshprep/fur/ribbons/ribbons.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace tegument::assets {
namespace {

constexpr std::uint32_t kRoots = 3000;
constexpr double kRadius = 50;
constexpr std::uint32_t kTriangles = 4; // of a ribbon

/// Ribbons on a ball, in the order of their addresses; all vertices of one stand on its root.
Mesh furryBall(std::uint32_t cluster) {
    Mesh mesh;
    std::mt19937 random(3);
    std::normal_distribution<float> axis;
    MeshPart part{.name = kStrandsPart, .firstIndex = 0, .indexCount = kRoots * 3 * kTriangles};
    for (std::uint32_t root = 0; root < kRoots; ++root) {
        const glm::vec3 normal = glm::normalize(glm::vec3(axis(random), axis(random), axis(random)));
        for (std::uint32_t i = 0; i < kTriangles + 2; ++i) {
            mesh.positions.push_back(static_cast<float>(kRadius) * normal);
            mesh.normals.push_back(normal);
            mesh.uvs.emplace_back(static_cast<float>(i), 4096.0F + 3.0F * static_cast<float>(root));
        }
        for (std::uint32_t i = 0; i < kTriangles; ++i)
            for (const std::uint32_t corner : {0U, 1U, 2U})
                mesh.indices.push_back(root * (kTriangles + 2) + i + corner);
    }
    for (std::uint32_t first = 0; cluster > 0 && first < part.indexCount; first += cluster * 3 * kTriangles)
        part.clusters.push_back({.firstIndex = first, .indexCount = std::min(cluster * 3 * kTriangles, part.indexCount - first)});
    computeClusters(mesh, part);
    mesh.parts = {part};
    computeBounds(mesh);
    return mesh;
}

std::uint32_t rootOf(std::uint32_t vertex) {
    return vertex / (kTriangles + 2);
}

/// (root, instance) of every ribbon that is drawn.
using Drawn = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Drawn drawnOf(const Mesh& mesh, const std::optional<DrawList>& lists, std::uint32_t count) {
    Drawn drawn;
    const DrawList all{.indices = mesh.indices,
                       .ranges = {{.first = 0, .count = static_cast<std::uint32_t>(mesh.indices.size()), .instances = count}}};
    const DrawList& used = lists ? *lists : all;
    for (const ListedRange& range : used.ranges)
        for (std::uint32_t i = range.first; i < range.first + range.count; i += 3 * kTriangles)
            for (std::uint32_t n = 0; n < range.instances; ++n)
                drawn.emplace(rootOf(used.indices[i]), range.firstInstance + n);
    return drawn;
}

/// As a shader computes it, in single precision (tgRibbonRank).
float shaderRank(float address) {
    const float row = std::floor(address / 4096.0F);
    const float column = address - 4096.0F * row;
    const float sum = column * 0.6180340F + row * 0.7548777F;
    return sum - std::floor(sum);
}

run::PartView viewFrom(const glm::dvec3& eye, double reach) {
    run::PartView view =
        run::partView(glm::perspective(0.5, 1.5, 1.0, 10000.0) * glm::lookAt(eye, glm::dvec3(10, 0, 0), glm::dvec3(0, 1, 0)), eye, reach);
    view.hidden = horizonOf(reach / kRadius);
    return view;
}

/// Ribbons of `segments` on the roots of furryBall, as meshprep/fur/ribbons writes them: a b c b d c.
Mesh ribbonsInRows(std::uint32_t segments) {
    Mesh mesh;
    MeshPart part{.name = kStrandsPart, .firstIndex = 0, .indexCount = kRoots * 6 * segments};
    const Mesh ball = furryBall(0);
    for (std::uint32_t root = 0; root < kRoots; ++root) {
        for (std::uint32_t vertex = 0; vertex < 2 * segments + 2; ++vertex) {
            mesh.positions.push_back(ball.positions[root * (kTriangles + 2)]);
            mesh.normals.push_back(ball.normals[root * (kTriangles + 2)]);
            const float place = std::round(31 * static_cast<float>(vertex / 2) / static_cast<float>(segments)) / 32;
            mesh.uvs.emplace_back(7 + place, 4096.0F + 3.0F * static_cast<float>(root));
        }
        for (std::uint32_t segment = 0; segment < segments; ++segment)
            for (const std::uint32_t corner : {0U, 1U, 2U, 1U, 3U, 2U})
                mesh.indices.push_back(2 * (root * (segments + 1) + segment) + corner);
    }
    mesh.parts = {part};
    computeBounds(mesh);
    return mesh;
}

TEST(SegmentsOfAPass, join_root_and_tip_by_rows_of_one_ribbon_and_are_as_long_as_asked) {
    constexpr std::uint32_t kSegments = 6;
    const Mesh mesh = ribbonsInRows(kSegments);
    double before = kSegments;
    for (const double distance : {100.0, 300.0, 450.0, 900.0, 2000.0, 20000.0}) {
        const StrandShare asked{.pixel = 0.001, .count = 2, .length = 6, .segment = 4, .fewestSegments = 2};
        const glm::dvec3 eye(0, 0, distance);
        const auto lists = listStrands(mesh, mesh.parts[0], nullptr, eye, asked);
        std::vector<std::uint32_t> rows(kRoots, 0);
        const std::vector<std::uint32_t>& indices = lists ? lists->indices : mesh.indices;
        for (std::size_t at = 0; at < indices.size(); at += 6) {
            const std::uint32_t a = indices[at], c = indices[at + 2], root = a / (2 * kSegments + 2);
            ASSERT_EQ(a % 2, 0U);
            ASSERT_LT(a, c);
            ASSERT_EQ(c / (2 * kSegments + 2), root) << "a triangle between two ribbons";
            EXPECT_EQ(std::vector(indices.begin() + static_cast<long>(at), indices.begin() + static_cast<long>(at) + 6),
                      (std::vector{a, a + 1, c, a + 1, c + 1, c}));
            const bool first = rows[root]++ == 0;
            ASSERT_EQ(a, first ? root * (2 * kSegments + 2) : indices[at - 4]) << "a gap in the ribbon";
            if (at + 6 == indices.size() || indices[at + 6] / (2 * kSegments + 2) != root) {
                ASSERT_EQ(c, (root + 1) * (2 * kSegments + 2) - 2) << "the tip is missing";
            }
        }
        double mean = 0;
        for (const std::uint32_t segments : rows) {
            ASSERT_GE(segments, 2U);
            mean += segments / double(kRoots);
        }
        const double wanted = std::clamp(6 / (0.001 * distance) / 4, 2.0, double(kSegments));
        EXPECT_NEAR(mean, wanted, 0.2) << "from " << distance << "; roots stand up to 50 nearer or further";
        EXPECT_LE(mean, before + 1e-9);
        before = mean;
    }
    EXPECT_NEAR(before, 2, 1e-9);
}

/// A strand's width in pixels at the place where a row stands, by the nearest that it may come.
double widthAt(const StrandShare& share, double stored, double nearest) {
    const double place = 32.0 / 31.0 * (stored - std::floor(stored));
    return share.widest * (1 - std::pow(place, share.taper)) / (share.pixel * nearest);
}

/// Of each root how many segments are drawn.
std::map<std::uint32_t, std::uint32_t> segmentsOf(const std::vector<std::uint32_t>& indices, std::uint32_t segments) {
    std::map<std::uint32_t, std::uint32_t> drawn;
    for (std::size_t at = 0; at < indices.size(); at += 6)
        ++drawn[indices[at] / (2 * segments + 2)];
    return drawn;
}

class TaperOfAPass : public testing::TestWithParam<double> {};

TEST_P(TaperOfAPass, leaves_out_rows_that_are_thin_from_their_beginning_on_and_no_other) {
    constexpr std::uint32_t kSegments = 6;
    const Mesh mesh = ribbonsInRows(kSegments);
    std::set<std::uint32_t> lengths;
    for (const double distance : {600.0, 900.0, 1500.0, 2500.0}) {
        const StrandShare asked{.pixel = 0.001, .count = 1, .widest = 2, .least = 0.7, .taper = GetParam()};
        const glm::dvec3 eye(0, 0, distance);
        const run::PartView view = viewFrom(eye, 5);
        const auto lists = listStrands(mesh, mesh.parts[0], &view, eye, asked);
        ASSERT_TRUE(lists);
        for (const auto& [root, drawn] : segmentsOf(lists->indices, kSegments)) {
            const std::uint32_t vertex = root * (2 * kSegments + 2);
            const double nearest = glm::distance(eye, glm::dvec3(mesh.positions[vertex])) - 5;
            const auto width = [&](std::uint32_t row) {
                return widthAt(asked, static_cast<double>(mesh.uvs[vertex + 2 * row].x), nearest);
            };
            EXPECT_GT(width(drawn - 1), 0.7 * 0.999) << "a segment that a shader draws nothing of";
            EXPECT_LE(drawn == kSegments ? 0 : width(drawn), 0.7 * 1.001) << "a segment is missing";
            lengths.insert(drawn);
        }
    }
    EXPECT_GE(lengths.size(), 3U);
}

INSTANTIATE_TEST_SUITE_P(Powers, TaperOfAPass, testing::Values(1.0, 3.0));

TEST(TaperOfAPass, leaves_rows_out_of_fewer_segments_too_and_keeps_them_joined) {
    constexpr std::uint32_t kSegments = 6;
    const Mesh mesh = ribbonsInRows(kSegments);
    const glm::dvec3 eye(0, 0, 900);
    const run::PartView view = viewFrom(eye, 5);
    StrandShare asked{.pixel = 0.001, .count = 1, .length = 6, .segment = 2, .fewestSegments = 3, .widest = 2, .least = 0.7, .taper = 1};
    const auto cut = listStrands(mesh, mesh.parts[0], &view, eye, asked);
    asked.taper = 0;
    const auto whole = listStrands(mesh, mesh.parts[0], &view, eye, asked);
    ASSERT_TRUE(cut && whole);
    EXPECT_LT(cut->indices.size(), whole->indices.size());
    // What is left of each ribbon is how it began.
    std::map<std::uint32_t, std::vector<std::uint32_t>> ribbons;
    for (const std::uint32_t index : whole->indices)
        ribbons[index / (2 * kSegments + 2)].push_back(index);
    std::map<std::uint32_t, std::size_t> at;
    for (const std::uint32_t index : cut->indices) {
        const std::uint32_t root = index / (2 * kSegments + 2);
        ASSERT_LT(at[root], ribbons[root].size());
        ASSERT_EQ(index, ribbons[root][at[root]++]);
    }
}

TEST(SegmentsOfAPass, are_all_where_none_may_be_left_out) {
    const Mesh mesh = ribbonsInRows(3);
    EXPECT_FALSE(listStrands(mesh, mesh.parts[0], nullptr, {0, 0, 20000}, {.pixel = 0.001, .length = 6, .segment = 0}));
    const Mesh other = furryBall(0); // of triangles in another order
    EXPECT_FALSE(listStrands(other, other.parts[0], nullptr, {0, 0, 20000}, {.pixel = 0.001, .length = 6, .segment = 4}));
}

TEST(ShareOfAPass, that_distance_leaves_are_the_share_asked_and_begin_with_the_rank_asked) {
    const Mesh mesh = furryBall(0);
    const StrandShare asked{.width = 0.2, .thinnest = 0.7, .fewest = 0.3, .pixel = 0.001, .count = 1};
    const auto rootsOf = [&](const StrandShare& share) {
        const auto lists = listStrands(mesh, mesh.parts[0], nullptr, {0, 0, 20000}, share);
        std::set<std::uint32_t> roots;
        for (const std::uint32_t index : lists ? lists->indices : mesh.indices)
            roots.insert(rootOf(index));
        return roots;
    };
    const auto first = rootsOf(asked);
    EXPECT_NEAR(static_cast<double>(first.size()), 0.3 * kRoots, 0.01 * kRoots);
    StrandShare later = asked;
    later.first = 0.5;
    const auto second = rootsOf(later);
    EXPECT_NEAR(static_cast<double>(second.size()), 0.3 * kRoots, 0.01 * kRoots);
    std::size_t both = 0;
    for (const std::uint32_t root : second)
        both += first.contains(root);
    EXPECT_LT(both, kRoots / 100) << "shares of 0.3 that begin half-way apart have no root in common but for rounding";
}

class StrandsOfAPass : public testing::TestWithParam<std::uint32_t> {};

TEST_P(StrandsOfAPass, hold_every_one_that_a_shader_draws_and_few_that_it_does_not) {
    const Mesh mesh = furryBall(GetParam());
    for (const double distance : {120.0, 300.0, 2000.0})
        for (const double share : {1.0, 0.37})
            for (const std::uint32_t count : {1U, 4U}) {
                const glm::dvec3 eye(0.2 * distance, 0.1 * distance, distance);
                const StrandShare asked{.share = share, .width = 0.2, .thinnest = 0.7, .pixel = 0.001, .count = count};
                const run::PartView view = viewFrom(eye, 6);
                const Drawn drawn = drawnOf(mesh, listStrands(mesh, mesh.parts[0], &view, eye, asked), count);
                std::size_t wanted = 0;
                for (std::uint32_t root = 0; root < kRoots; ++root) {
                    const std::uint32_t vertex = root * (kTriangles + 2);
                    const glm::vec3 place = mesh.positions[vertex];
                    const float away = glm::distance(place, glm::vec3(eye));
                    const float part = static_cast<float>(share) * std::min(0.2F / (0.7F * 0.001F * away), 1.0F);
                    if (!run::canBeSeen(glm::dvec3(place), glm::dvec3(mesh.normals[vertex]), view)) continue;
                    for (std::uint32_t n = 0; n < count; ++n)
                        if ((static_cast<float>(n) + shaderRank(mesh.uvs[vertex].y)) / static_cast<float>(count) < part) {
                            ++wanted;
                            ASSERT_TRUE(drawn.contains({root, n})) << "root " << root << ", strand " << n << " from " << distance;
                        }
                }
                EXPECT_LE(static_cast<double>(drawn.size()), 1.01 * static_cast<double>(wanted) + 20) << "from " << distance;
                EXPECT_LT(wanted, std::size_t{kRoots} * count) << "some must be left out, or this shows nothing";
            }
}

INSTANTIATE_TEST_SUITE_P(Clusters, StrandsOfAPass, testing::Values(0, 100));

/// A strand of width w at its root is w (1 - t^taper) at t; a pixel is as wide as the distance times `pixel`.
TEST(ThinStrands, end_where_they_are_narrower_than_the_share_asks) {
    const StrandShare share{.pixel = 1e-3, .widest = 0.1, .least = 0.5, .taper = 2};
    for (const double distance : {1.0, 50.0, 150.0, 190.0, 199.0}) {
        const double least = 0.5 * 1e-3 * distance; // mm
        const double place = thinFrom(share, distance, 0);
        EXPECT_NEAR(0.1 * (1 - place * place), least, 0.01 * least) << distance; // never too soon, by the tolerance of shares
    }
    for (const double distance : {210.0, 300.0, 399.0, 500.0, 1e6})
        EXPECT_EQ(thinFrom(share, distance, 0), 0) << "all of it is too narrow from " << distance;
    StrandShare even = share;
    even.taper = 0;
    EXPECT_EQ(thinFrom(even, 190, 0), 1) << "as wide everywhere";
    EXPECT_EQ(thinFrom(even, 210, 0), 0);
    EXPECT_EQ(thinFrom(even, 210, 20), 1) << "what may come nearer";
}

TEST(StrandsOfAPassThatShowsAll, are_drawn_from_the_mesh_itself) {
    const Mesh mesh = furryBall(100);
    EXPECT_FALSE(listStrands(mesh, mesh.parts[0], nullptr, {0, 0, 300}, {.count = 4}));
    const auto half = listStrands(mesh, mesh.parts[0], nullptr, {0, 0, 300}, {.share = 0.5, .count = 4});
    ASSERT_TRUE(half);
    EXPECT_EQ(half->ranges.front().instances, 2U) << "whole instances are drawn at once";
    EXPECT_EQ(half->ranges.front().count, mesh.indices.size());
    EXPECT_EQ(half->ranges.size(), 2U) << "and what rounding may leave of the third";
    EXPECT_LT(half->ranges.back().count, mesh.indices.size() / 100);
}

TEST(StrandsOfAPassThatShowsNothing, are_none) {
    const Mesh mesh = furryBall(100);
    const glm::dvec3 eye(0, 0, 300);
    const run::PartView away =
        run::partView(glm::perspective(0.5, 1.5, 1.0, 10000.0) * glm::lookAt(eye, glm::dvec3(0, 0, 900), glm::dvec3(0, 1, 0)), eye, 6);
    const auto lists = listStrands(mesh, mesh.parts[0], &away, eye, {.count = 4});
    ASSERT_TRUE(lists);
    EXPECT_TRUE(lists->ranges.empty());
}

} // namespace
} // namespace tegument::assets
