// What stands in for textures whose files are not there.

#include "host/run/procedures.h"

#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace tegument::run {
namespace {

TEST(PlainPictures, of_one_colour_are_that_colour_everywhere) {
    for (const auto& [name, colour] : {std::pair("white", glm::vec4(1)), std::pair("grey", glm::vec4(0.5F, 0.5F, 0.5F, 1)),
                                       std::pair("normal", glm::vec4(0.5F, 0.5F, 1, 1))}) {
        const Image picture = plainPicture(name);
        ASSERT_EQ(picture.channels, 4);
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                for (int channel = 0; channel < 4; ++channel)
                    ASSERT_EQ(picture.at(x, y, channel), colour[channel]) << name << " at " << x << ", " << y;
    }
}

TEST(PlainPictures, a_ramp_rises_from_black_to_white_by_the_same_step) {
    const Image picture = plainPicture("ramp");
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int channel = 0; channel < 4; ++channel)
                ASSERT_NEAR(picture.at(x, y, channel), channel == 3 ? 1 : static_cast<double>(x) / (picture.width - 1), 1e-7); // a float's
}

TEST(PlainPictures, noise_is_within_its_range_in_channels_of_their_own) {
    const Image picture = plainPicture("noise");
    const auto [least, most] = std::ranges::minmax(picture.pixels);
    EXPECT_GE(least, 0);
    EXPECT_LE(most, 1);
    for (int channel = 0; channel < 4; ++channel) {
        double sum = 0, other = 0;
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                sum += picture.at(x, y, channel) - 0.5;
                other += (picture.at(x, y, channel) - 0.5) * (picture.at(x, y, (channel + 1) % 4) - 0.5);
            }
        const double texels = picture.width * picture.height;
        EXPECT_LT(std::abs(sum) / texels, 4 * std::sqrt(1 / 12.0 / texels)) << "four standard deviations of the mean";
        EXPECT_LT(std::abs(other) / texels, 4.0 / 12 / std::sqrt(texels)) << "the same of the product";
    }
}

/// Sine of the elevation of a texel of +X, which looks along its middle; and the sky's colour there.
struct SkyAt {
    double up;
    glm::vec3 colour;
};
SkyAt skyAt(const Image& face, int y) {
    const int x = face.width / 2;
    const double u = (x + 0.5) / face.width * 2 - 1, v = (y + 0.5) / face.height * 2 - 1;
    return {-v / std::sqrt(1 + u * u + v * v), glm::vec3(face.at(x, y, 0), face.at(x, y, 1), face.at(x, y, 2))};
}

/// Air near the horizon is thick: the colour follows the root of the elevation's sine, so that half of the change is done at 1/4.
TEST(PlainPictures, a_sky_changes_fastest_over_its_bright_horizon_and_the_ground_is_dark) {
    const std::vector<Image> faces = plainCube("sky");
    ASSERT_EQ(faces.size(), 6U);
    const int half = faces[0].height / 2;
    const SkyAt low = skyAt(faces[0], half - 1), high = skyAt(faces[0], 0);
    for (int y = 1; y < half - 1; ++y) {
        const SkyAt sky = skyAt(faces[0], y);
        const double share = (std::sqrt(sky.up) - std::sqrt(low.up)) / (std::sqrt(high.up) - std::sqrt(low.up));
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR((sky.colour[channel] - low.colour[channel]) / (high.colour[channel] - low.colour[channel]), share, 1e-4) << y;
    }
    EXPECT_GT(faces[2].at(half, half, 2), faces[2].at(half, half, 0)) << "blue above";
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_GT(low.colour[channel], faces[2].at(half, half, channel)) << "the horizon is the brightest";
        EXPECT_LT(faces[3].at(half, half, channel), 0.3F) << "below it is dark";
    }
}

TEST(PlainPictures, a_cube_of_normals_holds_each_direction) {
    const std::vector<Image> faces = plainCube("normals");
    // The axis of each face, and where its u and v point (Direct3D: the cube is seen from within, v goes down).
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const glm::dvec3 axes[6][3] = {{x, -z, -y}, {-x, z, -y}, {y, x, z}, {-y, x, -z}, {z, x, -y}, {-z, -x, -y}};
    for (std::size_t face = 0; face < 6; ++face)
        for (const int row : {0, 20, 63})
            for (const int column : {0, 41, 63}) {
                const double side = faces[face].width, u = (column + 0.5) / side * 2 - 1, v = (row + 0.5) / side * 2 - 1;
                const glm::dvec3 way = glm::normalize(axes[face][0] + u * axes[face][1] + v * axes[face][2]);
                for (int channel = 0; channel < 3; ++channel)
                    EXPECT_NEAR(faces[face].at(column, row, channel), way[channel] / 2 + 0.5, 1e-6) << face << ' ' << row << ' ' << column;
            }
}

} // namespace
} // namespace tegument::run
