// Faces of a cube map's texture against each other, looked up face by face in double precision.

#include "meshprep/fur/cube_texture.h"

#include "meshprep/fur/fur_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tegument {

namespace {

constexpr int kSide = 12; // 12, 6, 3, 1: even and odd levels

/// Every texel another value.
std::array<Image, 6> noise() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> value(0, 1);
    std::array<Image, 6> faces;
    for (Image& face : faces) {
        face = {.width = kSide, .height = kSide, .channels = 4, .pixels = {}};
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
