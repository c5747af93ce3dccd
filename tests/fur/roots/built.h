#pragma once
// A mesh with its roots and their texture.

#include "host/support/result.h"
#include "meshprep/fur/roots/root_texture.h"
#include "meshprep/fur/roots/scatter.h"

#include <gtest/gtest.h>

namespace tegument::testing_roots {

struct Built {
    Mesh mesh;
    RootSet set;
    RootTexture texture;

    [[nodiscard]] glm::vec4 coat(const glm::vec3& place) const { return coatAround(texture.image, place); }
};

/// Fails the test and gives no roots when there is an error.
inline RootSet rootsOf(const Mesh& mesh, const RootOptions& options) {
    auto set = makeRoots(mesh, options);
    if (set) return *std::move(set);
    ADD_FAILURE() << format(set.error());
    return {};
}

inline Built build(Mesh mesh, const RootOptions& options) {
    Built built{.mesh = std::move(mesh)};
    built.set = rootsOf(built.mesh, options);
    if (testing::Test::HasFailure()) return built;
    auto texture = buildRootTexture(built.set);
    EXPECT_TRUE(texture) << format(texture.error());
    if (texture) built.texture = *std::move(texture);
    return built;
}

} // namespace tegument::testing_roots
