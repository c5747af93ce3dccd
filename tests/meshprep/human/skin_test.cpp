// Pigments, brows and relief: what colours and roughens the skin.

#include "meshprep/human/bake.h"
#include "meshprep/human/brows.h"
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

TEST(Brows, run_out_towards_the_temple) {
    const Brows brows(kEyes, 1);
    const auto mean = [&](float from, float to) {
        float sum = 0;
        for (int row = 0; row < 90; ++row)
            for (int column = 0; column < 40; ++column)
                sum += brows.coverage(
                    glm::vec3(31 + glm::mix(from, to, static_cast<float>(column) / 40), 12 + 0.15f * static_cast<float>(row), 10), 0.2f);
        return sum / 3600;
    };
    EXPECT_LT(mean(19, 24), 0.55f * mean(0, 5)); // hairs get fewer,
    EXPECT_EQ(mean(30, 40), 0);                  // and there is no tail
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

/// Mean squared slope along x and along y where a face has this region.
glm::dvec2 slopes(const Regions& regions, float texelMm) {
    glm::dvec2 sum(0);
    for (int i = 0; i < 3000; ++i) {
        const auto slope = [&](const glm::vec3& way) {
            const auto at = [&](float off) { return skinRelief(spread(i) + off * way, regions, kEyes[0], texelMm, 1); };
            return static_cast<double>(at(0.05f) - at(-0.05f)) / 0.1;
        };
        const double x = slope(glm::vec3(1, 0, 0));
        const double y = slope(glm::vec3(0, 1, 0));
        sum += glm::dvec2(x * x, y * y) / 3000.0;
    }
    return sum;
}

TEST(Relief, furrows_run_across_the_forehead) {
    const glm::dvec2 forehead = slopes({.forehead = 1}, 0.2f);
    EXPECT_GT(forehead.y, 1.3 * forehead.x);
}

/// The share of points that lie more than 20 micrometres below what skin of no region has there.
double pitted(const Regions& regions) {
    int pits = 0;
    for (int i = 0; i < 5000; ++i)
        pits += skinRelief(spread(i), regions, kEyes[0], 0.2f, 1) < skinRelief(spread(i), {}, kEyes[0], 0.2f, 1) - 0.02f ? 1 : 0;
    return pits / 5000.0;
}

TEST(Relief, pores_are_where_faces_have_them) {
    EXPECT_GT(pitted({.nose = 1}), 0.01);
    EXPECT_GT(pitted({.cheeks = 1}), 0.01);
    EXPECT_EQ(pitted({.neck = 1}), 0); // its lines are 18 deep
}

TEST(Relief, grooves_of_the_lips_are_no_comb) {
    // A comb comes again: its height is like itself one tooth further on. Over lags from half a groove to four of them, none is.
    constexpr int kCount = 600;
    double strongest = -1;
    for (float lag = 1.2f; lag < 8; lag += 0.1f) {
        double product = 0;
        double square = 0;
        double mean = 0;
        const auto at = [](float x, int row) {
            return static_cast<double>(skinRelief(glm::vec3(x, 0.7f * static_cast<float>(row), 3), {.lips = 1}, kEyes[0], 0.2f, 1));
        };
        for (int i = 0; i < kCount; ++i)
            mean += at(-25 + 0.08f * static_cast<float>(i), i % 7) / kCount;
        for (int i = 0; i < kCount; ++i) {
            const float x = -25 + 0.08f * static_cast<float>(i);
            product += (at(x, i % 7) - mean) * (at(x + lag, i % 7) - mean);
            square += (at(x, i % 7) - mean) * (at(x, i % 7) - mean);
        }
        strongest = std::max(strongest, product / square);
    }
    EXPECT_LT(strongest, 0.5);
}

TEST(Shine, eyes_are_left_to_the_effect) {
    const Face face(HeadSurface{.eyes = kEyes}, {});
    const Shine shine = shineAt({.part = BustPart::LeftEye}, face, 1);
    EXPECT_EQ(shine.roughness, 1);
    EXPECT_EQ(shine.intensity, 1);
}

/// A square of 64 mm in the plane z = 0 that fills the middle half of the map in u and v.
HeadSurface square() {
    HeadSurface head;
    head.mesh.positions = {{-32, -32, 0}, {32, -32, 0}, {32, 32, 0}, {-32, 32, 0}};
    head.mesh.normals.assign(4, glm::vec3(0, 0, 1));
    head.mesh.uvs = {{0.25f, 0.75f}, {0.75f, 0.75f}, {0.75f, 0.25f}, {0.25f, 0.25f}};
    head.mesh.indices = {0, 1, 2, 0, 2, 3};
    computeTangents(head.mesh);
    head.sourceUvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    head.parts = {BustPart::Skin, BustPart::Skin};
    return head;
}

TEST(Bake, texels_get_the_point_under_their_centre) {
    const Image image = bakeTexture(square(), 64, 3, [](const SurfacePoint& point) { return glm::vec4(point.position, 1); });
    EXPECT_NEAR(image.at(40, 20, 0), (40.5f / 64 - 0.5f) * 128, 1e-3f); // 128 mm would fill the map; a rounding of single precision
    EXPECT_NEAR(image.at(40, 20, 1), (0.5f - 20.5f / 64) * 128, 1e-3f);
}

TEST(Bake, source_coordinates_follow_the_surface) {
    const Image image = bakeTexture(square(), 64, 2, [](const SurfacePoint& point) { return glm::vec4(point.sourceUv, 0, 1); });
    EXPECT_NEAR(image.at(16, 47, 0), 0.5f / 32, 1e-5f);
    EXPECT_NEAR(image.at(16, 47, 1), 0.5f / 32, 1e-5f);
}

TEST(Bake, the_tangent_points_to_growing_u_and_the_bitangent_to_falling_v) {
    const Image image =
        bakeTexture(square(), 64, 4, [](const SurfacePoint& point) { return glm::vec4(point.tangent.x, point.bitangent.y, 0, 0); });
    EXPECT_NEAR(image.at(32, 32, 0), 1, 1e-6f);
    EXPECT_NEAR(image.at(32, 32, 1), 1, 1e-6f);
}

TEST(Bake, the_size_of_a_texel_is_known_in_millimetres) {
    const Image image = bakeTexture(square(), 64, 1, [](const SurfacePoint& point) { return glm::vec4(point.texelMm); });
    EXPECT_NEAR(image.at(32, 32, 0), 2, 1e-5f); // 64 mm over 32 texels
}

TEST(Bake, gutters_take_the_nearest_covered_value) {
    const Image image =
        bakeTexture(square(), 64, 1, [](const SurfacePoint& point) { return glm::vec4(point.position.x < 0 ? 1.0f : 2.0f); });
    EXPECT_EQ(image.at(0, 32, 0), 1);
    EXPECT_EQ(image.at(63, 32, 0), 2);
    EXPECT_EQ(image.at(2, 2, 0), 1);
}

TEST(Bake, a_mesh_without_area_leaves_the_map_black) {
    HeadSurface head = square();
    head.mesh.uvs.assign(4, glm::vec2(0.5f));
    const Image image = bakeTexture(head, 16, 1, [](const SurfacePoint&) { return glm::vec4(1); });
    for (const float value : image.pixels)
        EXPECT_EQ(value, 0);
}

} // namespace
} // namespace tegument
