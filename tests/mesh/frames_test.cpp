// Normals and tangents.
#include "host/mesh/triangles.h"
#include "tests/mesh/files.h"

#include <array>
#include <cmath>
#include <map>
#include <random>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

/// A square in the plane z = 0 whose chart is placed by `uvOf`.
template <class UvOf>
Mesh square(UvOf uvOf) {
    Mesh mesh;
    for (const glm::vec2 p : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        mesh.positions.emplace_back(p, 0);
        mesh.uvs.push_back(uvOf(p));
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.parts = {{"square", 0, 6}};
    computeNormals(mesh);
    return mesh;
}

glm::vec3 bitangent(const Mesh& mesh, std::size_t vertex) {
    const glm::vec4& tangent = mesh.tangents[vertex];
    return tangent.w * glm::cross(mesh.normals[vertex], glm::vec3(tangent));
}

/// A UV sphere: every vertex knows its exact tangent (east) and bitangent (north).
Mesh sphere(int slices, int stacks) {
    Mesh mesh;
    const auto pi = glm::radians(180.0f);
    for (int y = 0; y <= stacks; ++y)
        for (int x = 0; x <= slices; ++x) {
            const glm::vec2 uv(static_cast<float>(x) / static_cast<float>(slices), static_cast<float>(y) / static_cast<float>(stacks));
            const float longitude =
                2 * pi * static_cast<float>(x % slices) / static_cast<float>(slices); // the seam's positions agree bit for bit
            const float polar = pi * uv.y;
            mesh.positions.emplace_back(std::sin(polar) * std::sin(longitude), std::cos(polar), std::sin(polar) * std::cos(longitude));
            mesh.uvs.push_back(uv);
        }
    addGrid(mesh.indices, static_cast<std::uint32_t>(slices), static_cast<std::uint32_t>(stacks), "acdadb");
    mesh.parts = {{"sphere", 0, static_cast<std::uint32_t>(mesh.indices.size())}};
    return mesh;
}

bool allFinite(const Mesh& mesh) {
    for (const glm::vec4& tangent : mesh.tangents)
        if (!(std::abs(glm::length(glm::vec3(tangent)) - 1) < 1e-5f)) return false;
    for (const glm::vec3& normal : mesh.normals)
        if (!(std::abs(glm::length(normal) - 1) < 1e-5f)) return false;
    return true;
}

} // namespace

TEST(Normals, of_a_cube_corner_do_not_depend_on_how_its_faces_are_cut) {
    // The diagonal of each quad either meets the corner (two triangles there) or not (one): all eight ways.
    for (int ways = 0; ways < 8; ++ways) {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
        const std::array<std::array<std::uint32_t, 4>, 3> quads = {{{0, 2, 4, 1}, {0, 3, 5, 2}, {0, 1, 6, 3}}};
        for (int q = 0; q < 3; ++q) {
            const auto& [a, b, c, d] = quads[static_cast<std::size_t>(q)];
            if (ways >> q & 1)
                mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
            else
                mesh.indices.insert(mesh.indices.end(), {a, b, d, b, c, d});
        }
        computeNormals(mesh);
        EXPECT_LT(glm::distance(mesh.normals[0], -glm::normalize(glm::vec3(1))), 1e-6f) << "way " << ways;
    }
}

TEST(Normals, are_shared_across_uv_seams) {
    Mesh mesh = sphere(16, 8);
    computeNormals(mesh);
    for (std::size_t y = 0; y <= 8; ++y)
        EXPECT_EQ(mesh.normals[17 * y], mesh.normals[17 * y + 16]) << "row " << y;
}

TEST(Normals, survive_sizes_at_the_ends_of_float) {
    for (const float size : {1e-40f, 1e-20f, 1e20f, 1e38f}) {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
        mesh.indices = {0, 1, 2};
        computeNormals(mesh);
        EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1)) << size;
    }
}

TEST(Normals, of_two_opposite_faces_are_one_of_the_two) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 1};
    computeNormals(mesh);
    EXPECT_EQ(std::abs(mesh.normals[0].z), 1);
}

TEST(Normals, of_triangles_without_area_are_finite) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    mesh.indices = {0, 1, 2};
    computeNormals(mesh);
    EXPECT_EQ(glm::length(mesh.normals[1]), 1);
}

TEST(Normals, that_are_there_are_kept) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    mesh.indices = {0, 1, 2};
    computeNormals(mesh);
    EXPECT_EQ(mesh.normals[0], glm::vec3(1, 0, 0));
}

TEST(Tangents, point_along_u_and_the_bitangent_towards_decreasing_v) {
    Mesh mesh = square([](glm::vec2 p) { return glm::vec2(p.x, 1 - p.y); }); // v down: up in space is decreasing v
    computeTangents(mesh);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(mesh.tangents[i], glm::vec4(1, 0, 0, 1));
        EXPECT_EQ(bitangent(mesh, i), glm::vec3(0, 1, 0));
    }
}

TEST(Tangents, of_a_mirrored_chart_have_the_other_sign) {
    Mesh mesh = square([](glm::vec2 p) { return glm::vec2(1 - p.x, 1 - p.y); });
    computeTangents(mesh);
    EXPECT_EQ(mesh.tangents[0], glm::vec4(-1, 0, 0, -1));
    EXPECT_EQ(bitangent(mesh, 0), glm::vec3(0, 1, 0)) << "v is not mirrored, so the bitangent stays";
}

TEST(Tangents, follow_a_turned_and_stretched_chart) {
    // u = 3 y, v = -x: tangent along +y, decreasing v along +x; seen from +z this is mirrored
    Mesh mesh = square([](glm::vec2 p) { return glm::vec2(3 * p.y, -p.x); });
    computeTangents(mesh);
    EXPECT_LT(glm::distance(glm::vec3(mesh.tangents[0]), glm::vec3(0, 1, 0)), 1e-6f);
    EXPECT_LT(glm::distance(bitangent(mesh, 0), glm::vec3(1, 0, 0)), 1e-6f);
    EXPECT_EQ(mesh.tangents[0].w, -1);
}

TEST(Tangents, split_the_vertices_of_a_mirror_line) {
    // A butterfly: the chart of the left half is that of the right half, folded over x = 0.
    Mesh mesh;
    for (const float x : {-1.f, 0.f, 1.f})
        for (const float y : {0.f, 1.f}) {
            mesh.positions.emplace_back(x, y, 0);
            mesh.uvs.emplace_back(std::abs(x), 1 - y);
        }
    mesh.indices = {0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5};
    mesh.parts = {{"butterfly", 0, 12}};
    computeNormals(mesh);
    computeTangents(mesh);
    EXPECT_EQ(mesh.positions.size(), 8u) << "the two vertices on the line are doubled";
    for (std::size_t i = 0; i < 12; ++i) {
        const std::uint32_t vertex = mesh.indices[i];
        const bool left = i < 6;
        EXPECT_EQ(mesh.tangents[vertex], left ? glm::vec4(-1, 0, 0, -1) : glm::vec4(1, 0, 0, 1));
        EXPECT_EQ(bitangent(mesh, vertex), glm::vec3(0, 1, 0));
    }
}

TEST(Tangents, of_a_sphere_point_east) {
    Mesh mesh = sphere(64, 32);
    for (const glm::vec3& p : mesh.positions)
        mesh.normals.push_back(glm::normalize(p));
    computeTangents(mesh);
    for (std::size_t i = 0; i < 65 * 33; ++i) {
        const glm::vec3& p = mesh.positions[i];
        if (std::abs(p.y) > 0.95f) continue; // at the poles east has no direction
        const glm::vec3 east = glm::normalize(glm::vec3(p.z, 0, -p.x));
        EXPECT_GT(glm::dot(glm::vec3(mesh.tangents[i]), east), std::cos(glm::radians(3.0f))) << "a chart cell spans 5.6 degrees";
        EXPECT_EQ(mesh.tangents[i].w, 1);
    }
}

TEST(Tangents, are_perpendicular_to_their_normals) {
    Mesh mesh = sphere(20, 10);
    computeNormals(mesh);
    computeTangents(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0, 1e-6f);
}

TEST(Tangents, do_not_depend_on_the_order_of_the_triangles) {
    Mesh mesh = sphere(12, 6);
    computeNormals(mesh);
    Mesh turned = mesh;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) // last triangle first, each begun at another corner
        for (std::size_t c = 0; c < 3; ++c)
            turned.indices[mesh.indices.size() - 3 - i + c] = mesh.indices[i + (c + 1) % 3];
    computeTangents(mesh);
    computeTangents(turned);
    ASSERT_EQ(mesh.tangents.size(), turned.tangents.size());
    std::size_t near = 0;
    for (std::size_t i = 0; i < 13 * 7; ++i)
        near += glm::distance(mesh.tangents[i], turned.tangents[i]) < 1e-5f;
    EXPECT_GE(near, 13 * 5u) << "all but the poles, whose vertices split in the order in which they are met";
}

TEST(Tangents, of_charts_without_area_are_finite_and_join_their_neighbours) {
    Mesh mesh = square([](glm::vec2 p) { return glm::vec2(p.x, 1 - p.y); });
    mesh.uvs[3] = mesh.uvs[0]; // the second triangle's chart is a line now
    computeTangents(mesh);
    EXPECT_TRUE(allFinite(mesh));
    EXPECT_EQ(mesh.positions.size(), 4u) << "it takes part in its neighbour's group instead of splitting from it";
    EXPECT_EQ(mesh.tangents[0], glm::vec4(1, 0, 0, 1));
    for (glm::vec2& uv : mesh.uvs)
        uv = glm::vec2(0.5f);
    computeTangents(mesh);
    EXPECT_TRUE(allFinite(mesh));
}

TEST(Tangents, of_random_soup_are_finite) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> value(-1, 1);
    Mesh mesh;
    for (int i = 0; i < 300; ++i) {
        mesh.positions.emplace_back(value(random), value(random), value(random));
        mesh.uvs.emplace_back(value(random), value(random));
    }
    for (int i = 0; i < 3000; ++i)
        mesh.indices.push_back(static_cast<std::uint32_t>(random() % 300));
    computeNormals(mesh);
    computeTangents(mesh);
    EXPECT_TRUE(allFinite(mesh));
    EXPECT_EQ(mesh.tangents.size(), mesh.positions.size());
}
