// The one-dimensional study of the printed pipeline, within 15 % or 0.002 of an independent one (its rows are quoted here).

#include "lab/reference/edge_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tegument::reference;

namespace {

constexpr double kFootprint = 0.25; // mm: a head that fills a picture of 1080 lines
constexpr int kPhases = 8;

void expectPublished(const glm::dvec3& value, const glm::dvec3& published, const char* what) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c], published[c], std::max(0.15 * published[c], 0.002)) << what << ", channel " << c;
}

EdgeError errorAtEdge(const EdgePipeline& pipeline) {
    return edgeError([&](double phase) { return edgeOf(pipeline, phase); }, kFootprint, kPhases);
}

} // namespace

TEST(EdgeStudy, light_that_is_not_diffused) {
    const EdgeError error = edgeError([](double) { return sharpEdge(); }, kFootprint, 1);
    expectPublished(error.largest, {.357, .237, .185}, "largest");
    expectPublished(error.rms, {.073, .026, .017}, "rms");
}

TEST(EdgeStudy, row_a_the_pipeline_as_printed) {
    const EdgeError fine = errorAtEdge({.texel = 0.15});
    expectPublished(fine.largest, {.017, .029, .038}, "0.15 mm, largest");
    expectPublished(fine.rms, {.0037, .0027, .0026}, "0.15 mm, rms");
    const EdgeError coarse = errorAtEdge({.texel = 0.30});
    expectPublished(coarse.largest, {.050, .099, .129}, "0.30 mm, largest");
    expectPublished(coarse.rms, {.0063, .0106, .0129}, "0.30 mm, rms");
}

TEST(EdgeStudy, row_b_normalised_and_of_the_right_variance) {
    const EdgeError fine = errorAtEdge({.texel = 0.15, .normalised = true});
    expectPublished(fine.largest, {.016, .033, .042}, "0.15 mm, largest");
    expectPublished(fine.rms, {.0009, .0019, .0024}, "0.15 mm, rms");
    const EdgeError coarse = errorAtEdge({.texel = 0.30, .normalised = true});
    expectPublished(coarse.largest, {.044, .091, .123}, "0.30 mm, largest");
    expectPublished(coarse.rms, {.0041, .0087, .0116}, "0.30 mm, rms");
}

TEST(EdgeStudy, row_c_the_first_gaussian_left_sharp_at_each_pixel) {
    expectPublished(errorAtEdge({.texel = 0.30, .normalised = true, .sharpFirst = true}).largest, {.033, .065, .088}, "largest");
}

TEST(EdgeStudy, row_d_the_two_narrow_gaussians_exact) {
    const EdgeError fine = errorAtEdge({.texel = 0.15, .normalised = true, .exact = 2});
    expectPublished(fine.largest, {.0017, .0017, 0}, "0.15 mm, largest");
    const EdgeError coarse = errorAtEdge({.texel = 0.30, .normalised = true, .exact = 2});
    expectPublished(coarse.largest, {.0021, .0022, 0}, "0.30 mm, largest");
    expectPublished(coarse.rms, {.0004, .0004, 0}, "0.30 mm, rms");
}

TEST(EdgeStudy, six_exact_gaussians_leave_no_error) {
    EXPECT_LT(errorAtEdge({.texel = 0.30, .normalised = true, .exact = 6}).largest.r, 1e-12);
}
