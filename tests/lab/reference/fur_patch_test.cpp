// The fur patch whose picture is known, and what shells lose of it.

#include "lab/reference/fur_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tegument::reference {

namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

std::vector<double> shells(const FurPatch& patch, const FurView& view, int layers) {
    return drawPatch(patch, view, {.kind = FurMethod::Kind::Shells, .layers = layers});
}

TEST(FurPatch, seen_from_above_covers_what_its_cones_cover) {
    // From above a strand is its base disc; discs of 0.38 around roots that stray by 0.3 may overlap, so count by a fine grid of disc
    // tests.
    const FurPatch patch;
    const FurView view{.tilt = 0, .pixel = 0.5, .size = 40, .samples = 8};
    const auto picture = drawPatch(patch, view, {});
    double covered = 0;
    int total = 0;
    for (int j = 0; j < 320; ++j)
        for (int i = 0; i < 320; ++i) {
            covered += exactHit(patch, {.x = (i + 0.5) / 16, .y = (j + 0.5) / 16, .run = 0}) == kNoHit ? 0 : 1;
            ++total;
        }
    // pi 0.38^2 = 0.454 of the area less overlaps of neighbours, a few hundredths.
    EXPECT_GT(covered / total, 0.40);
    EXPECT_LE(covered / total, 0.4537 + 0.01);
    double mean = 0;
    for (const double value : picture)
        mean += value;
    EXPECT_NEAR(
        mean / static_cast<double>(picture.size()),
        [&] {
            double sum = 0;
            for (int j = 0; j < 320; ++j)
                for (int i = 0; i < 320; ++i) {
                    const double h = exactHit(patch, {.x = (i + 0.5) / 16, .y = (j + 0.5) / 16, .run = 0});
                    sum += h == kNoHit ? 0.05 : 0.15 + 0.85 * h;
                }
            return sum / total;
        }(),
        1e-12);
}

TEST(FurPatch, a_hit_lies_on_a_cone_and_nothing_above_it_is_inside_one) {
    const FurPatch patch{.coat = 12};
    for (int i = 0; i < 600; ++i) {
        const FurRay ray{.x = 0.37 * i, .y = 0.611 * i, .run = 0.01 * i};
        const double hit = exactHit(patch, ray);
        // Many thin shells find what lies above a hit; they can only find it lower than it is.
        const double found = shellHit(patch, ray, 2001);
        ASSERT_LE(found, hit + 1e-9) << "ray " << i;
    }
}

TEST(FurPatch, many_shells_come_to_the_exact_picture) {
    for (const double tilt : {0.0, 45.0, 70.0}) {
        const FurPatch patch{.coat = 4};
        const FurView view{.tilt = radians(tilt), .pixel = 0.5, .size = 12, .samples = 3};
        const auto truth = drawPatch(patch, view, {});
        // By the law below 2048 shells leave 0.27 * 4 * tan(70) / 2048 = 1.4e-3.
        EXPECT_LT(furError(shells(patch, view, 2048), truth).rms, 3e-3) << tilt << " degrees";
    }
}

TEST(FurPatch, swept_shells_are_exact_while_a_segment_stays_within_its_cells) {
    const FurPatch patch{.coat = 4};
    for (const double tilt : {0.0, 45.0, 70.0}) {
        const FurView view{.tilt = radians(tilt), .pixel = 0.5, .size = 24};
        const auto truth = drawPatch(patch, view, {});
        // 8 layers: a segment of 4 tan(70) / 8 = 1.4 spacings crosses at most three cells and one on either side.
        const auto picture = drawPatch(patch, view, {.kind = FurMethod::Kind::Swept, .layers = 8, .cells = 5});
        EXPECT_LT(furError(picture, truth).rms, 1e-12) << tilt << " degrees";
    }
}

TEST(FurPatch, error_of_shells_follows_the_law_where_it_gives_a_hundredth_to_a_tenth) {
    // RMSE = 0.27 * coat * tan(tilt) / layers, the gap between two layers in strand spacings: within 30 % for pixels from an eighth to half
    // a spacing.
    double worst = 0;
    int cases = 0;
    for (const double coat : {4.0, 12.0})
        for (const double tilt : {45.0, 70.0})
            for (const double pixel : {0.125, 0.5})
                for (const int layers : {16, 32, 64, 128}) {
                    const double law = 0.27 * coat * std::tan(radians(tilt)) / layers;
                    if (law < 0.012 || law > 0.1) continue;
                    const FurPatch patch{.coat = coat};
                    const FurView view{.tilt = radians(tilt), .pixel = pixel, .size = 32, .samples = 3};
                    const double rms = furError(shells(patch, view, layers), drawPatch(patch, view, {})).rms;
                    worst = std::max(worst, std::abs(rms / law - 1));
                    ++cases;
                    EXPECT_NEAR(rms / law, 1.0, 0.3)
                        << "coat " << coat << ", " << tilt << " degrees, pixel " << pixel << ", " << layers << " layers";
                }
    EXPECT_GE(cases, 8);
    RecordProperty("worst", std::to_string(worst));
}

TEST(FurPatch, shells_lose_strands_and_never_add_any) {
    const FurPatch patch{.coat = 12};
    const FurView view{.tilt = radians(70), .pixel = 2, .size = 24};
    const auto truth = drawPatch(patch, view, {});
    const FurError error = furError(shells(patch, view, 64), truth);
    // Strands thinner than the gap between layers are missed: the error is nearly all bias, towards dark.
    EXPECT_LT(error.bias, -0.8 * error.rms);
}

TEST(FurPatch, what_shells_leave_open_is_what_they_lose_in_brightness) {
    const FurPatch patch{.coat = 12};
    const FurView view{.tilt = radians(70), .pixel = 0.5, .size = 16};
    const FurMethod few{.kind = FurMethod::Kind::Shells, .layers = 16};
    const FurMethod many{.kind = FurMethod::Kind::Shells, .layers = 256};
    EXPECT_GT(coverageGap(patch, view, few), 4 * coverageGap(patch, view, many));
    EXPECT_EQ(coverageGap(patch, view, {.kind = FurMethod::Kind::Swept, .layers = 16, .cells = 9}), 0);
}

TEST(FurPatch, an_outline_loses_half_a_layer_of_an_even_spread) {
    const FurPatch patch{.coat = 8};
    // Tips lie evenly between layers and the first below is half a gap away on average, from 0 to 1.
    EXPECT_NEAR(outlineGap(patch, 40), 0.5 * 8 / 40, 0.02 * 8 / 40);
    // Denser at the tips: the gap there, p h^(1 - 1/p) / n with h about 0.8, is the smaller one.
    EXPECT_LT(outlineGap(patch, 40, 0.5), 0.75 * outlineGap(patch, 40));
}

TEST(FurPatch, swept_shells_are_exact_however_they_are_spread) {
    const FurPatch patch{.coat = 4};
    const FurView view{.tilt = radians(45), .pixel = 0.5, .size = 16};
    const auto truth = drawPatch(patch, view, {});
    for (const double exponent : {0.5, 2.0}) {
        const FurMethod method{.kind = FurMethod::Kind::Swept, .layers = 4, .cells = 9, .exponent = exponent};
        EXPECT_LT(furError(drawPatch(patch, view, method), truth).rms, 1e-12) << exponent;
    }
}

} // namespace

} // namespace tegument::reference
