// Which ribbons a pass is given: none that a shader would draw is left out, and most of those that it would not.

#include "host/run/strands.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace tegument::run {
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

Drawn drawnOf(const Mesh& mesh, const std::optional<StrandLists>& lists, std::uint32_t count) {
    Drawn drawn;
    const StrandLists all{
        .indices = mesh.indices,
        .ranges = {{.range = {.first = 0, .count = static_cast<std::uint32_t>(mesh.indices.size())}, .instances = count}}};
    const StrandLists& used = lists ? *lists : all;
    for (const StrandRange& range : used.ranges)
        for (std::uint32_t i = range.range.first; i < range.range.first + range.range.count; i += 3 * kTriangles)
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

PartView viewFrom(const glm::dvec3& eye, double reach) {
    return partView(glm::perspective(0.5, 1.5, 1.0, 10000.0) * glm::lookAt(eye, glm::dvec3(10, 0, 0), glm::dvec3(0, 1, 0)), eye, reach);
}

class StrandsOfAPass : public testing::TestWithParam<std::uint32_t> {};

TEST_P(StrandsOfAPass, hold_every_one_that_a_shader_draws_and_few_that_it_does_not) {
    const Mesh mesh = furryBall(GetParam());
    for (const double distance : {120.0, 300.0, 2000.0})
        for (const double share : {1.0, 0.37})
            for (const std::uint32_t count : {1U, 4U}) {
                const glm::dvec3 eye(0.2 * distance, 0.1 * distance, distance);
                const StrandShare asked{.share = share, .width = 0.2, .thinnest = 0.7, .pixel = 0.001, .count = count};
                const PartView view = viewFrom(eye, 6);
                const Drawn drawn = drawnOf(mesh, listStrands(mesh, mesh.parts[0], &view, eye, asked), count);
                std::size_t wanted = 0;
                for (std::uint32_t root = 0; root < kRoots; ++root) {
                    const std::uint32_t vertex = root * (kTriangles + 2);
                    const glm::vec3 place = mesh.positions[vertex];
                    const float away = glm::distance(place, glm::vec3(eye));
                    const float part = static_cast<float>(share) * std::min(0.2F / (0.7F * 0.001F * away), 1.0F);
                    if (!canBeSeen(glm::dvec3(place), glm::dvec3(mesh.normals[vertex]), view)) continue;
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

TEST(StrandsOfAPassThatShowsAll, are_drawn_from_the_mesh_itself) {
    const Mesh mesh = furryBall(100);
    EXPECT_FALSE(listStrands(mesh, mesh.parts[0], nullptr, {0, 0, 300}, {.count = 4}));
    const auto half = listStrands(mesh, mesh.parts[0], nullptr, {0, 0, 300}, {.share = 0.5, .count = 4});
    ASSERT_TRUE(half);
    EXPECT_EQ(half->ranges.front().instances, 2U) << "whole instances are drawn at once";
    EXPECT_EQ(half->ranges.front().range.count, mesh.indices.size());
    EXPECT_EQ(half->ranges.size(), 2U) << "and what rounding may leave of the third";
    EXPECT_LT(half->ranges.back().range.count, mesh.indices.size() / 100);
}

TEST(StrandsOfAPassThatShowsNothing, are_none) {
    const Mesh mesh = furryBall(100);
    const glm::dvec3 eye(0, 0, 300);
    const PartView away =
        partView(glm::perspective(0.5, 1.5, 1.0, 10000.0) * glm::lookAt(eye, glm::dvec3(0, 0, 900), glm::dvec3(0, 1, 0)), eye, 6);
    const auto lists = listStrands(mesh, mesh.parts[0], &away, eye, {.count = 4});
    ASSERT_TRUE(lists);
    EXPECT_TRUE(lists->ranges.empty());
}

} // namespace
} // namespace tegument::run
