// Strands drawn into maps.
// Faces of a cube map's texture against each other, looked up face by face in double precision.

#include "meshprep/fur/cube_texture.h"
#include "meshprep/fur/fur_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tegument {

namespace {

StrandSet single(const glm::dvec3& root, double length = 1) {
    return {.strands = {{root, length}}, .wanted = 1};
}

std::size_t coveredTexels(const Image& map) {
    std::size_t count = 0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            count += map.at(x, y, 3) > 0 ? 1 : 0;
    return count;
}

TEST(FurMaps, empty_texels_are_transparent_white_and_strands_opaque_white) {
    const Image map = drawFurTexture(single({10.5, 20.5, 0}), 32, 32, {});
    for (int c = 0; c < 4; ++c)
        EXPECT_EQ(map.at(10, 20, c), 1.0F);
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(map.at(11, 20, c), 1.0F);
    EXPECT_EQ(map.at(11, 20, 3), 0.0F);
}

TEST(FurMaps, a_strand_between_texels_is_not_lost) {
    EXPECT_EQ(coveredTexels(drawFurTexture(single({10.0, 20.0, 0}), 32, 32, {})), 1u);
    EXPECT_EQ(coveredTexels(drawSphereMap(single(glm::normalize(glm::dvec3(0.3, 0.2, 0.5))), 33, {})), 1u);
}

TEST(FurMaps, a_strand_on_the_border_goes_on_at_the_other_side) {
    const Image map = drawFurTexture(single({0.0, 16.0, 0}), 32, 32, {.radius = 3});
    EXPECT_GT(map.at(31, 16, 3), 0.0F);
    EXPECT_GT(map.at(0, 16, 3), 0.0F);
    // A disc of radius 3: 28.3 texels; a lattice count within its outline's length.
    EXPECT_NEAR(static_cast<double>(coveredTexels(map)), 28.3, 6.0);
}

TEST(FurMaps, a_cone_s_height_falls_linearly_from_its_length_to_nothing) {
    const Image map = drawFurTexture(single({16.5, 16.5, 0}, 0.8), 32, 32, {.radius = 8, .taper = true});
    for (int x = 0; x <= 7; ++x)
        EXPECT_NEAR(map.at(16 + x, 16, 3), 0.8F * (1.0F - static_cast<float>(x) / 8.0F), 1e-6F);
    EXPECT_EQ(map.at(25, 16, 3), 0.0F);
}

TEST(FurMaps, sphere_map_and_direction_are_inverses) {
    for (double s = 0.05; s < 1; s += 0.09)
        for (double t = 0.05; t < 1; t += 0.09) {
            if (std::hypot(2 * s - 1, 2 * t - 1) > 0.999) continue;
            const glm::dvec2 back = sphereMapTexture(sphereMapDirection(s, t));
            EXPECT_NEAR(back.x, s, 1e-9);
            EXPECT_NEAR(back.y, t, 1e-9);
        }
    EXPECT_EQ(sphereMapDirection(0.5, 0.5), glm::dvec3(0, 0, 1));
    EXPECT_TRUE(std::isfinite(sphereMapTexture({0, 0, -1}).x));
}

TEST(FurMaps, texels_of_the_sphere_map_have_one_solid_angle) {
    constexpr int kSide = 64;
    for (const glm::ivec2 texel : {glm::ivec2(32, 32), glm::ivec2(12, 40), glm::ivec2(5, 33)}) {
        const double step = 1.0 / kSide;
        const double s = texel.x * step;
        const double t = texel.y * step;
        const glm::dvec3 a = sphereMapDirection(s + step, t) - sphereMapDirection(s, t);
        const glm::dvec3 b = sphereMapDirection(s, t + step) - sphereMapDirection(s, t);
        // Differences over a texel for the derivative: an error of a few texel sides.
        EXPECT_NEAR(glm::length(glm::cross(a, b)) / (16.0 / (kSide * kSide)), 1.0, 0.12) << texel.x << ", " << texel.y;
    }
}

TEST(FurMaps, cube_map_and_direction_are_inverses_on_every_face) {
    for (int face = 0; face < 6; ++face)
        for (double u = 0.03; u < 1; u += 0.11)
            for (double v = 0.03; v < 1; v += 0.11) {
                const CubePoint back = cubeMapTexture(cubeMapDirection(face, u, v));
                EXPECT_EQ(back.face, face);
                EXPECT_NEAR(back.uv.x, u, 1e-12);
                EXPECT_NEAR(back.uv.y, v, 1e-12);
            }
}

TEST(FurMaps, cube_faces_are_those_of_direct3d) {
    // Direct3D 10's table of faces: on +X the left border is towards +Z and the upper one towards +Y, on +Y the upper border towards -Z.
    EXPECT_GT(cubeMapDirection(0, 0.0, 0.5).z, 0);
    EXPECT_GT(cubeMapDirection(0, 0.5, 0.0).y, 0);
    EXPECT_LT(cubeMapDirection(2, 0.5, 0.0).z, 0);
    EXPECT_GT(cubeMapDirection(3, 0.5, 0.0).z, 0);
    EXPECT_GT(cubeMapDirection(4, 1.0, 0.5).x, 0);
    EXPECT_LT(cubeMapDirection(5, 1.0, 0.5).x, 0);
}

TEST(FurMaps, a_strand_on_a_cube_s_edge_is_drawn_on_both_faces) {
    const auto faces = drawCubeMap(single(glm::normalize(glm::dvec3(1, 0.1, 1))), 64, {.radius = 4});
    EXPECT_GT(coveredTexels(faces[0]), 8u);
    EXPECT_GT(coveredTexels(faces[4]), 8u);
    for (const int face : {1, 2, 3, 5})
        EXPECT_EQ(coveredTexels(faces.at(static_cast<std::size_t>(face))), 0u);
}

TEST(FurMaps, neighbours_across_every_cube_edge_have_nearly_the_same_height) {
    const auto set = strandsOnSphere(cubeMapTexels(64), {.density = 0.002, .spacing = 12, .radius = 8, .taper = true});
    ASSERT_TRUE(set);
    const auto faces = drawCubeMap(*set, 64, {.radius = 8, .taper = true});
    double across = 0;
    int count = 0;
    for (int face = 0; face < 6; ++face)
        for (int i = 8; i < 56; ++i) {
            const glm::dvec3 beyond = cubeMapDirection(face, -0.5 / 64, (i + 0.5) / 64); // half a texel left of the border
            const CubePoint there = cubeMapTexture(beyond);
            ASSERT_NE(there.face, face);
            const Image& other = faces.at(static_cast<std::size_t>(there.face));
            const int x = std::min(static_cast<int>(there.uv.x * 64), 63);
            const int y = std::min(static_cast<int>(there.uv.y * 64), 63);
            across += std::abs(static_cast<double>(other.at(x, y, 3)) -
                               static_cast<double>(faces.at(static_cast<std::size_t>(face)).at(0, i, 3)));
            ++count;
        }
    // Cones of radius 8 mean texels rise by 1/8 a texel at most, and texels differ in size by sqrt(2) at an edge's middle.
    EXPECT_LT(across / count, 0.125);
}

TEST(FurMaps, coverage_of_the_cube_is_by_solid_angle) {
    // A cap of 30 degrees covers (1 - cos 30) / 2 of the sphere.
    const double texel = texelAngle(cubeMapTexels(128));
    const auto faces = drawCubeMap(single(glm::normalize(glm::dvec3(0.2, 0.9, 0.4))), 128, {.radius = (3.14159265 / 6) / texel});
    EXPECT_NEAR(cubeCoverage(faces), 0.066987, 0.001);
}

TEST(FurMaps, coverage_of_the_sphere_map_is_by_solid_angle) {
    const double texel = texelAngle(sphereMapTexels(256));
    const Image map = drawSphereMap(single(glm::normalize(glm::dvec3(0.2, 0.9, -0.4))), 256, {.radius = (3.14159265 / 6) / texel});
    EXPECT_NEAR(sphereCoverage(map), 0.066987, 0.001);
}

constexpr int kSide = 12; // 12, 6, 3, 1: even and odd levels

/// Every texel another value.
std::array<Image, 6> noise() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> value(0, 1);
    std::array<Image, 6> faces;
    for (Image& face : faces) {
        face = {.width = kSide, .height = kSide, .channels = 4};
        for (int i = 0; i < kSide * kSide * 4; ++i)
            face.pixels.push_back(value(random));
    }
    return faces;
}

const Image& levelOf(const DdsTexture& cube, int face, int mip) {
    return cube.images.at(static_cast<std::size_t>(face * cube.mips + mip));
}

/// Bilinear within the face: what Direct3D 9 does.
double filtered(const Image& face, glm::dvec2 uv, int channel) {
    const glm::dvec2 at = uv * glm::dvec2(face.width, face.height) - 0.5;
    const glm::dvec2 low = glm::floor(at);
    double sum = 0;
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
            const int x = std::clamp(static_cast<int>(low.x) + dx, 0, face.width - 1);
            const int y = std::clamp(static_cast<int>(low.y) + dy, 0, face.height - 1);
            const double wx = dx == 1 ? at.x - low.x : 1 - at.x + low.x;
            const double wy = dy == 1 ? at.y - low.y : 1 - at.y + low.y;
            sum += wx * wy * static_cast<double>(face.at(x, y, channel));
        }
    return sum;
}

/// The largest step between the two faces' values over points of the cube's edges.
double largestStep(const DdsTexture& cube, int mip) {
    constexpr double kBeyond = 1e-9;
    double largest = 0;
    for (int face = 0; face < 6; ++face)
        for (int i = 1; i < 200; ++i)
            for (const glm::dvec2 border : {glm::dvec2(0, i / 200.0), {1, i / 200.0}, {i / 200.0, 0}, {i / 200.0, 1}}) {
                const glm::dvec2 outside = 0.5 + (border - 0.5) * (1 + kBeyond);
                const CubePoint there = cubeMapTexture(cubeMapDirection(face, outside.x, outside.y));
                EXPECT_NE(there.face, face);
                for (int channel = 0; channel < 4; ++channel)
                    largest = std::max(largest, std::abs(filtered(levelOf(cube, face, mip), border, channel) -
                                                         filtered(levelOf(cube, there.face, mip), there.uv, channel)));
            }
    return largest;
}

TEST(CubeTexture, faces_filtered_by_themselves_meet_at_every_edge_on_every_level) {
    const DdsTexture cube = cubeTexture(noise(), DdsFormat::Rgba32F);
    ASSERT_EQ(cube.mips, 4);
    for (int mip = 0; mip < cube.mips; ++mip)
        EXPECT_LT(largestStep(cube, mip), 1e-6) << "level " << mip; // of floats, between points 1e-9 of a face apart
}

TEST(CubeTexture, texels_inside_of_the_faces_are_those_that_were_drawn) {
    const auto faces = noise();
    const DdsTexture cube = cubeTexture(faces, DdsFormat::Rgba32F);
    for (int face = 0; face < 6; ++face)
        for (int y = 1; y < kSide - 1; ++y)
            for (int x = 1; x < kSide - 1; ++x)
                EXPECT_EQ(levelOf(cube, face, 0).at(x, y, 3), faces.at(static_cast<std::size_t>(face)).at(x, y, 3));
}

TEST(CubeTexture, a_corner_is_the_mean_of_its_three_texels) {
    std::array<Image, 6> faces = noise();
    // Three faces meet at (1, 1, 1): +X's upper left texel, +Y's lower right one, +Z's upper right one.
    const double mean = (static_cast<double>(faces[0].at(0, 0, 3)) + static_cast<double>(faces[2].at(kSide - 1, kSide - 1, 3)) +
                         static_cast<double>(faces[4].at(kSide - 1, 0, 3))) /
                        3;
    const DdsTexture cube = cubeTexture(faces, DdsFormat::Rgba32F);
    EXPECT_NEAR(static_cast<double>(levelOf(cube, 0, 0).at(0, 0, 3)), mean, 1e-6);
    EXPECT_NEAR(static_cast<double>(levelOf(cube, 2, 0).at(kSide - 1, kSide - 1, 3)), mean, 1e-6);
    EXPECT_NEAR(static_cast<double>(levelOf(cube, 4, 0).at(kSide - 1, 0, 3)), mean, 1e-6);
}

} // namespace

} // namespace tegument
