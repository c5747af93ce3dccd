// The eyeball's form, and where its lids touch it.

#include "meshprep/human/eye_opening.h"
#include "meshprep/human/skin_color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tegument {
namespace {

const Eyeball kEye = {.centre = glm::vec3(31, 5, -2), .radius = 15};

glm::vec3 direction(float degrees, float around) {
    const float angle = glm::radians(degrees);
    return {std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle)};
}

TEST(Cornea, stands_a_millimetre_before_the_white_and_nowhere_else) {
    EXPECT_NEAR(eyeSurface(kEye, glm::vec3(0, 0, 1)) - kEye.radius, 1.06f, 0.02f); // real ones 1.0 to 1.1
    for (const float degrees : {40.0f, 60.0f, 90.0f, 180.0f})
        EXPECT_NEAR(eyeSurface(kEye, direction(degrees, 1)), kEye.radius, 1e-4f) << degrees;
}

TEST(Cornea, is_as_curved_as_a_real_one_in_its_middle) {
    // Sagitta over 2 mm on either side of the axis: radius of curvature 7 to 9 mm (real ones 7.8).
    const float angle = 2.0f / 16;
    const glm::vec3 side = glm::vec3(std::sin(angle), 0, std::cos(angle)) * eyeSurface(kEye, {std::sin(angle), 0, std::cos(angle)});
    const float sagitta = eyeSurface(kEye, glm::vec3(0, 0, 1)) - side.z;
    const float curvature = (side.x * side.x + sagitta * sagitta) / (2 * sagitta);
    EXPECT_GT(curvature, 7);
    EXPECT_LT(curvature, 9);
}

TEST(Cornea, normals_are_those_of_its_surface) {
    // Beside a central difference of the radius in double steps along the meridian: tan of the tilt is r' / r.
    for (const float degrees : {0.5f, 8.0f, 16.0f, 21.0f, 26.0f, 50.0f, 120.0f}) {
        const float step = 0.2f;
        const double slope =
            static_cast<double>(eyeSurface(kEye, direction(degrees + step, 0.7f)) - eyeSurface(kEye, direction(degrees - step, 0.7f))) /
            (2 * static_cast<double>(glm::radians(step)));
        const double tilt = std::atan2(-slope, static_cast<double>(eyeSurface(kEye, direction(degrees, 0.7f))));
        const glm::vec3 expected = direction(degrees + static_cast<float>(glm::degrees(tilt)), 0.7f);
        EXPECT_LT(glm::distance(eyeNormal(kEye, direction(degrees, 0.7f)), expected), 0.02f) << degrees; // both differ over finite steps
    }
}

/// Lids as a plane before the eye with a round hole: two triangles fans would do, but a grid is what subdivision leaves.
HeadSurface lidsAt(float z) {
    HeadSurface head;
    constexpr int kSide = 60;
    constexpr int kMiddle = kSide / 2;
    const auto at = [&](int x, int y) {
        return kEye.centre + glm::vec3(0.5f * static_cast<float>(x - kMiddle), 0.5f * static_cast<float>(y - kMiddle), z);
    };
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            for (const auto& corners :
                 {std::array{at(x, y), at(x + 1, y), at(x + 1, y + 1)}, std::array{at(x, y), at(x + 1, y + 1), at(x, y + 1)}}) {
                for (const glm::vec3& p : corners) {
                    head.mesh.indices.push_back(static_cast<std::uint32_t>(head.mesh.positions.size()));
                    head.mesh.positions.push_back(p);
                }
                head.parts.push_back(BustPart::Skin);
            }
    return head;
}

TEST(EyeOpening, is_where_skin_and_eyeball_meet) {
    constexpr float kPlane = 11;
    const EyeOpening opening(lidsAt(kPlane), kEye);
    const float expected = kEye.radius * std::acos(kPlane / kEye.radius); // along the eyeball, from the axis
    const LidDistances middle = opening.distances(kEye.centre + glm::vec3(0, 0, 15));
    EXPECT_NEAR(middle.upper, expected, 0.1f); // the grid's chords
    EXPECT_NEAR(middle.lower, expected, 0.1f);
    const LidDistances above = opening.distances(kEye.centre + 15.0f * direction(30, glm::radians(90.0f)));
    EXPECT_NEAR(above.upper, expected - kEye.radius * glm::radians(30.0f), 0.1f);
    EXPECT_GT(above.lower, 10);
}

TEST(EyeOpening, is_darkest_under_the_upper_lid) {
    const EyeOpening opening(lidsAt(11), kEye);
    const auto at = [&](float degrees, float around) {
        return opening.light(kEye.centre + 15.0f * direction(degrees, glm::radians(around)));
    };
    EXPECT_GT(at(0, 0), 0.9f);
    EXPECT_LT(at(42, 90), 0.4f);
    EXPECT_LT(at(42, 90), at(42, 270));
    EXPECT_LT(at(42, 90), at(30, 90));
}

TEST(EyeOpening, tears_stand_at_the_lower_lid) {
    const EyeOpening opening(lidsAt(11), kEye);
    const auto at = [&](float degrees, float around) {
        return opening.tears(kEye.centre + 15.0f * direction(degrees, glm::radians(around)));
    };
    EXPECT_GT(at(42.5f, 270), 0.1f);
    EXPECT_LT(at(38, 270), 0.01f);
    EXPECT_LT(at(42.5f, 90), 0.001f);
}

TEST(EyeOpening, without_lids_nothing_is_shadowed) {
    const EyeOpening opening;
    EXPECT_EQ(opening.light(kEye.centre + glm::vec3(0, 0, 15)), 1);
    EXPECT_EQ(opening.tears(kEye.centre + glm::vec3(0, 0, 15)), 0);
}

} // namespace
} // namespace tegument
