#pragma once

#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace tegument::reference {

/// Channel by channel, each within the same tolerance.
inline void expectNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c], expected[c], tolerance) << "channel " << c;
}

} // namespace tegument::reference
