// Pigments, brows and relief: what colours and roughens the skin.

#include "meshprep/human/brows.h"
#include "meshprep/human/pigment.h"
#include "meshprep/human/skin_color.h"
#include "meshprep/human/skin_relief.h"
#include "tests/meshprep/spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tegument {
namespace {

TEST(Pigment, light_skin_reflects_what_was_measured_on_light_skin) {
    // Spectrophotometer readings of light skin at 610, 550 and 460 nm lie in these ranges (docs/design/human.md).
    const glm::vec3 skin = skinReflectance({});
    EXPECT_GT(skin.r, 0.48f);
    EXPECT_LT(skin.r, 0.66f);
    EXPECT_GT(skin.g, 0.28f);
    EXPECT_LT(skin.g, 0.42f);
    EXPECT_GT(skin.b, 0.20f);
    EXPECT_LT(skin.b, 0.34f);
}

TEST(Pigment, melanin_darkens_blue_most) {
    const glm::vec3 ratio = skinReflectance({.melanin = 0.06f}) / skinReflectance({.melanin = 0.02f});
    EXPECT_LT(ratio.b, ratio.g);
    EXPECT_LT(ratio.g, ratio.r);
    EXPECT_LT(ratio.r, 1);
}

TEST(Pigment, blood_reddens) {
    const glm::vec3 ratio = skinReflectance({.blood = 0.02f}) / skinReflectance({.blood = 0.004f});
    EXPECT_LT(ratio.g, ratio.b);
    EXPECT_LT(ratio.b, ratio.r);
}

TEST(Pigment, blood_without_oxygen_is_less_red) {
    const glm::vec3 fresh = skinReflectance({.blood = 0.02f, .oxygenation = 0.95f});
    const glm::vec3 spent = skinReflectance({.blood = 0.02f, .oxygenation = 0.4f});
    EXPECT_LT(spent.r, fresh.r);
}

const std::array<Eyeball, 2> kEyes = {Eyeball{.centre = glm::vec3(31, 0, 0), .radius = 15},
                                      Eyeball{.centre = glm::vec3(-31, 0, 0), .radius = 15}};

TEST(Brows, lie_above_the_eyes_and_nowhere_else) {
    const Brows brows(kEyes, 1);
    float on = 0;
    for (int i = 0; i < 400; ++i)
        on += brows.coverage(glm::vec3(31 - 12 + 0.06f * static_cast<float>(i), 19 + static_cast<float>(i % 5), 10), 0.2f) / 400;
    EXPECT_GT(on, 0.2f);
    EXPECT_EQ(brows.coverage(glm::vec3(31, 50, 10), 0.2f), 0);
    EXPECT_EQ(brows.coverage(glm::vec3(31, -10, 10), 0.2f), 0);
}

TEST(Brows, hairs_do_not_gain_weight_in_coarse_textures) {
    const Brows brows(kEyes, 1);
    const auto mean = [&](float texelMm) {
        double sum = 0;
        for (int row = 0; row < 100; ++row)
            for (int column = 0; column < 100; ++column)
                sum += static_cast<double>(brows.coverage(
                    glm::vec3(31 - 12 + 0.24f * static_cast<float>(column), 15 + 0.08f * static_cast<float>(row), 10), texelMm));
        return sum / 10000;
    };
    EXPECT_NEAR(mean(0.5f) / mean(0.1f), 1, 0.15); // overlapping hairs are multiplied texel by texel: a second order effect
}

TEST(EyeColor, the_pupil_is_black_on_the_axis_of_sight) {
    const glm::vec3 pupil = eyeColor(kEyes[0].centre + glm::vec3(0, 0, 15), kEyes[0], 1);
    EXPECT_LT(std::max({pupil.r, pupil.g, pupil.b}), 0.01f);
}

TEST(EyeColor, the_white_is_lighter_than_the_iris) {
    const auto at = [&](float degrees) {
        const float angle = glm::radians(degrees);
        return eyeColor(kEyes[0].centre + 15.0f * glm::vec3(std::sin(angle), 0, std::cos(angle)), kEyes[0], 1).g;
    };
    EXPECT_GT(at(40), 3 * at(18));
}

/// A point of the cheek whose texel is 0.2 mm wide.
float reliefAt(const glm::vec3& p) {
    return skinRelief(p, {.cheeks = 1}, kEyes[0], 0.2f, 1);
}

TEST(Relief, stays_within_a_tenth_of_a_millimetre_on_the_cheek) {
    for (int i = 0; i < 5000; ++i) {
        EXPECT_LT(reliefAt(spread(i)), 0.03f);
        EXPECT_GT(reliefAt(spread(i)), -0.2f);
    }
}

TEST(Relief, roughness_is_that_of_skin) {
    // Profilometry of facial skin reports an arithmetic mean roughness of 5 to 40 micrometres: less is plastic, more is orange peel.
    constexpr int kCount = 5000;
    double mean = 0;
    for (int i = 0; i < kCount; ++i)
        mean += static_cast<double>(reliefAt(spread(i))) / kCount;
    double roughness = 0;
    for (int i = 0; i < kCount; ++i)
        roughness += std::abs(static_cast<double>(reliefAt(spread(i))) - mean) / kCount;
    EXPECT_GT(roughness, 0.005);
    EXPECT_LT(roughness, 0.04);
}

TEST(Relief, the_normal_does_not_depend_on_the_tangent_frame) {
    const Face face(HeadSurface{.eyes = kEyes}, {});
    SurfacePoint point{.position = glm::vec3(3, 4, 5),
                       .normal = glm::vec3(0, 0, 1),
                       .tangent = glm::vec3(1, 0, 0),
                       .bitangent = glm::vec3(0, 1, 0),
                       .part = BustPart::Skin,
                       .texelMm = 0.2f};
    const auto inSpace = [&] {
        const glm::vec3 n = reliefNormal(point, face, 1);
        return n.x * point.tangent + n.y * point.bitangent + n.z * point.normal;
    };
    const glm::vec3 first = inSpace();
    point.tangent = glm::vec3(0, 1, 0); // as the chart beside it may have it
    point.bitangent = glm::vec3(-1, 0, 0);
    EXPECT_LT(glm::distance(first, inSpace()), 1e-5f);
    EXPECT_GT(glm::distance(first, point.normal), 1e-4f); // and there is something to compare
}

TEST(Relief, details_below_two_texels_are_left_out) {
    double fine = 0;
    double coarse = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto slope = [&](float texelMm) {
            const auto at = [&](float dx) { return skinRelief(spread(i) + glm::vec3(dx, 0, 0), {.cheeks = 1}, kEyes[0], texelMm, 1); };
            return static_cast<double>(at(0.05f) - at(-0.05f)) / 0.1;
        };
        fine += slope(0.1f) * slope(0.1f);
        coarse += slope(2) * slope(2);
    }
    EXPECT_LT(coarse, fine / 10);
}

} // namespace
} // namespace tegument
