// Where hair grows on a head: by measures from the eyes, on an egg with two eyes.

#include "meshprep/fur/roots/head_hair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument {
namespace {

constexpr double kScale = 1.25; // of this head, in mm: 80 between the eyes

/// Half axes 72, 105, 88 of a head of 64 mm between the eyes, whose middle lies 23 above and 68 before that of the egg.
Mesh egg() {
    Mesh mesh;
    constexpr int kAround = 160, kHigh = 120;
    for (int j = 0; j <= kHigh; ++j)
        for (int i = 0; i < kAround; ++i) {
            const double a = 2 * std::numbers::pi * i / kAround, b = std::numbers::pi * j / kHigh;
            const glm::dvec3 on(std::sin(b) * std::sin(a), std::cos(b), std::sin(b) * std::cos(a));
            mesh.positions.emplace_back(kScale * (on * glm::dvec3(72, 105, 88)));
            mesh.normals.emplace_back(glm::normalize(on / glm::dvec3(72, 105, 88)));
        }
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kAround; ++i) {
            const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * kAround + x % kAround); };
            mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        }
    mesh.parts = {{.name = "skin", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

Mesh head() {
    Mesh mesh = egg();
    const auto first = static_cast<std::uint32_t>(mesh.indices.size());
    for (const double side : {-1.0, 1.0})
        for (const glm::dvec3 corner : {glm::dvec3(-5, 0, 0), glm::dvec3(5, -5, 0), glm::dvec3(5, 5, 0)}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.emplace_back(kScale * (glm::dvec3(32 * side, 23, 68) + corner * side));
            mesh.normals.emplace_back(0, 0, 1);
        }
    mesh.parts.push_back({.name = "eyes", .firstIndex = first, .indexCount = 6});
    computeBounds(mesh);
    return mesh;
}

/// The vertex of the skin that lies nearest to a place given from the middle between the eyes, mm of the usual head.
std::size_t vertexAt(const Mesh& mesh, const glm::dvec3& fromEyes) {
    const glm::vec3 place(kScale * (fromEyes + glm::dvec3(0, 23, 68)));
    const auto skin = mesh.positions.begin() + 160 * 121;
    return static_cast<std::size_t>(
        std::min_element(mesh.positions.begin(), skin,
                         [&](const glm::vec3& a, const glm::vec3& b) { return glm::distance(a, place) < glm::distance(b, place); }) -
        mesh.positions.begin());
}

/// The one with the densest hair within 4 mm: brows are hardly wider than the distance of two vertices.
std::size_t densestAt(const Mesh& mesh, const HeadHair& hair, const glm::dvec3& fromEyes) {
    const std::size_t middle = vertexAt(mesh, fromEyes);
    std::size_t densest = middle;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (static_cast<double>(glm::distance(mesh.positions[i], mesh.positions[middle])) < kScale * 4 &&
            hair.density[i].x > hair.density[densest].x)
            densest = i;
    return densest;
}

TEST(HeadHair, grows_on_scalp_brows_and_chin_and_nowhere_else) {
    const Mesh mesh = head();
    const auto hair = hairOfHead(mesh);
    ASSERT_TRUE(hair);
    const auto density = [&](double x, double y, double z) { return hair->density[vertexAt(mesh, {x, y, z})].x; };
    EXPECT_GT(density(0, 82, -68), 0.99) << "the crown";
    EXPECT_GT(density(0, 0, -156), 0.99) << "the back of the head";
    EXPECT_GT(hair->density[densestAt(mesh, *hair, {32, 20, 2})].x, 0.8) << "a brow";
    EXPECT_NEAR(density(0, -92, -4), 0.55, 0.01) << "the chin";
    EXPECT_EQ(density(0, 40, 10), 0) << "the forehead";
    EXPECT_EQ(density(0, -25, 20), 0) << "the nose";
    EXPECT_EQ(density(0, -69, 0), 0) << "the lips";
    EXPECT_EQ(density(45, -30, 5), 0) << "the cheek";
    for (std::size_t i = 160 * 121; i < mesh.positions.size(); ++i)
        EXPECT_EQ(hair->density[i].x, 0) << "the eyes";
}

TEST(HeadHair, is_longest_above_and_lies_along_the_skin) {
    const Mesh mesh = head();
    const auto hair = hairOfHead(mesh);
    ASSERT_TRUE(hair);
    EXPECT_EQ(hair->length[vertexAt(mesh, {0, 82, -68})].x, 1);
    EXPECT_LT(hair->length[densestAt(mesh, *hair, {32, 20, 2})].x, 0.4) << "a brow's";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 direction = 2.0 * hair->direction[i] - 1.0;
        ASSERT_LE(glm::length(direction), 1 + 1e-9);
        ASSERT_NEAR(glm::dot(direction, glm::dvec3(mesh.normals[i])), 0, 1e-6);
    }
    const auto flow = [&](double x, double y, double z) { return 2.0 * hair->direction[vertexAt(mesh, {x, y, z})] - 1.0; };
    EXPECT_LT(flow(70, 0, -80).y, -0.5) << "down at the side";
    EXPECT_GT(flow(0, 75, -20).z, 0.2) << "to the front above the forehead";
    for (const double side : {-1.0, 1.0}) {
        const glm::dvec3 brow = 2.0 * hair->direction[densestAt(mesh, *hair, {42 * side, 21, -4})] - 1.0;
        EXPECT_GT(brow.x * side, 0.4) << "outwards in a brow";
    }
}

TEST(HeadHair, of_a_mesh_without_two_eyes_is_not_known) {
    EXPECT_FALSE(hairOfHead(egg()));
    Mesh one = head();
    one.parts.back().indexCount = 3;
    EXPECT_FALSE(hairOfHead(one));
}

} // namespace
} // namespace tegument
