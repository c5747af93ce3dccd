#include "meshprep/base/noise.h"
#include "tests/meshprep/spread.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tegument {
namespace {

TEST(Noise, gradient_noise_is_zero_on_the_lattice) {
    for (int i = 0; i < 100; ++i)
        EXPECT_EQ(gradientNoise(glm::floor(spread(i)), 7), 0);
}

TEST(Noise, gradient_noise_has_no_steps) {
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 p = spread(i);
        const float step = std::abs(gradientNoise(p, 7) - gradientNoise(p + glm::vec3(1e-3f, 0, 0), 7));
        EXPECT_LT(step, 5e-3f); // slopes of gradient noise stay below 5: gradients of length sqrt 2, fade slopes of 1.875
    }
}

TEST(Noise, another_seed_is_another_noise) {
    int same = 0;
    for (int i = 0; i < 200; ++i)
        same += std::abs(gradientNoise(spread(i), 1) - gradientNoise(spread(i), 2)) < 1e-4f ? 1 : 0;
    EXPECT_LT(same, 20); // by chance a few per cent
}

TEST(Noise, random_numbers_are_even) {
    glm::dvec3 sum(0);
    constexpr int kCount = 8000;
    for (int i = 0; i < kCount; ++i)
        sum += glm::dvec3(unitRandom(glm::ivec3(i % 20, i / 20 % 20, i / 400) - 10, 3));
    for (glm::length_t c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c] / kCount, 0.5, 0.0162); // five standard errors: 5 * sqrt(1/12 / 8000)
}

TEST(Noise, the_second_cell_is_not_nearer_than_the_first) {
    for (int i = 0; i < 500; ++i) {
        const CellDistances cells = cellNoise(spread(i), 5);
        EXPECT_GE(cells.second, cells.nearest);
    }
}

} // namespace
} // namespace tegument
